// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace mlsmesh::apps {

/// A part of a method's work, in seconds of wall-clock time.
struct StageSeconds {
  std::string name;
  double seconds = 0;
};

/// Takes the time of a method, stage by stage.
class StageClock {
 public:
  /// Ends the present stage, if any, and begins another one.
  void begin(const std::string& name);
  /// Ends the present stage, if any.
  void end();
  /// Appends a stage that was measured elsewhere.
  void add(StageSeconds stage) { stages_.push_back(std::move(stage)); }
  /// Of the present stage; 0 if none runs.
  double secondsSoFar() const;

  const std::vector<StageSeconds>& stages() const { return stages_; }

 private:
  std::vector<StageSeconds> stages_;
  std::string present_;
  double began_ = 0;
  bool runs_ = false;
};

/// Seconds since some moment in the past; never goes back.
double wallSeconds();

}  // namespace mlsmesh::apps
