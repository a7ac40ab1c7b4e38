// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "view/keys.h"
#include "view/reconstruction_job.h"
#include "view/scene.h"
#include "view/script.h"

#include <chrono>
#include <memory>
#include <string>
#include <vector>

namespace mlsmesh::apps {

/// A scene that answers keys and time: reconstructs clouds where that is needed, and installs the results.
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

  bool isReconstructing() const { return job_ != nullptr; }
  /// Of what is being reconstructed.
  double fraction() const { return job_ ? job_->fraction() : 1.0; }
  std::string stage() const { return job_ ? job_->stage() : ""; }
  bool isScriptDone() const { return next_step_ == script_.size(); }
  bool isEnded() const { return is_ended_; }
  /// The first reconstruction that failed, "FILE: why; remedy"; empty if none has.
  const std::string& failure() const { return failure_; }

 private:
  void act(Action action, const std::string& argument);
  void actOnScene(Action action);
  void actOnLook(Action action);
  void show(Mode mode);
  void stepFile(int steps);
  void startJob();
  void followJob();
  void showProgress();
  void install(ReconstructionJob::Result& result);
  void runScript();

  std::vector<Subject>& subjects_;
  ViewOptions options_;
  Scene scene_;
  std::unique_ptr<ReconstructionJob> job_;
  std::vector<ScriptStep> script_;
  std::size_t next_step_ = 0;
  std::string failure_;
  std::chrono::steady_clock::time_point next_progress_;
  bool is_changed_ = true;
  bool is_ended_ = false;
};

}  // namespace mlsmesh::apps
