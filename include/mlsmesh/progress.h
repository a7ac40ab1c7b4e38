// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>

namespace mlsmesh {

/// A handle on a running computation. Copies share one state; every member is thread-safe.
/// A cancelled verb returns within a tenth of a second at a million points, by StatusCode::Cancelled and with
/// empty outputs; what a user's own pcl::search::Search does in one call of its own is waited for.
class Progress {
 public:
  /// Called with the stage's name and the overall fraction, at most about a hundred times a stage, from the thread that
  /// called the verb and never from two threads at once. It must not throw, and may call cancel(), cancelled() and
  /// fraction() of the handle, but nothing else.
  using Callback = std::function<void(const std::string& stage, double fraction)>;

  Progress();
  explicit Progress(Callback callback);

  /// Asks every computation that uses this handle to stop; stays asked until reset().
  void cancel();
  bool cancelled() const;
  /// Share of the work done, 0 .. 1; never falls during one run.
  double fraction() const;
  /// Forgets cancel() and goes back to 0, for another run with the same handle.
  void reset();

  /// For the steps: begins a run at 0.
  void begin();
  /// For the steps: ends the present stage and enters `stage`, whose work spans from there to the fraction `end`.
  void enterStage(const std::string& stage, double end);
  /// For the steps: share of the present stage that is done, 0 .. 1.
  void advance(double share_of_stage);

 private:
  struct State;
  std::shared_ptr<State> state_;
};

}  // namespace mlsmesh
