// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "view/job.h"
#include "view/keys.h"
#include "view/scene.h"
#include "view/script.h"

#include <chrono>
#include <memory>
#include <string>
#include <vector>

namespace mlsmesh::apps {

/// A scene that answers keys and time: reconstructs clouds, and finds defects and distances, where that is
/// needed, and installs the results.
class Viewer {
 public:
  /// Begins to reconstruct what the options' mode needs. Subjects and window outlive the viewer.
  Viewer(std::vector<Subject>& subjects, const ViewOptions& options, vtkRenderWindow& window);

  /// Does what the key is for, if anything. Throws AppError if a picture cannot be written.
  void press(const std::string& key, const std::string& argument = {});
  /// To be called some times a second: takes over what was done since, and does the next steps of the script.
  void tick();
  /// True once after the window has to be drawn again.
  bool takeChange();

  /// Something runs, or is about to, that will change what is shown.
  bool isBusy() const { return job_ != nullptr || wants_meshes_ || !scene_.openFindings().empty(); }
  /// Of what runs.
  double fraction() const { return job_ ? job_->fraction() : 1.0; }
  std::string stage() const { return job_ ? job_->stage() : ""; }
  bool isScriptDone() const { return next_step_ == script_.size(); }
  bool isEnded() const { return is_ended_; }
  /// The first reconstruction or finding that failed, "FILE: why; remedy"; empty if none has.
  const std::string& failure() const { return failure_; }

 private:
  void act(Action action, const std::string& argument);
  void actOnScene(Action action);
  void actOnLook(Action action);
  void show(Mode mode);
  void stepFile(int steps);
  void reconstruct();
  void findWhatIsOpen();
  void followJob();
  void showProgress();
  void install(Job::Result& result);
  /// Both return why there is no result, for its pane; empty if there is one.
  std::string installReconstruction(Job::Result& result);
  std::string installFinding(Job::Result& result);
  void noteFailure(const Job::Result& result);
  void runScript();

  std::vector<Subject>& subjects_;
  ViewOptions options_;
  Scene scene_;
  std::unique_ptr<Job> job_;
  bool wants_meshes_ = false;  ///< when the job is over
  std::vector<ScriptStep> script_;
  std::size_t next_step_ = 0;
  std::string failure_;
  std::chrono::steady_clock::time_point next_progress_;
  bool is_changed_ = true;
  bool is_ended_ = false;
};

}  // namespace mlsmesh::apps
