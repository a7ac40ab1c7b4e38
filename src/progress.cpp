// SPDX-License-Identifier: BSD-3-Clause
#include "mlsmesh/progress.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <utility>

namespace mlsmesh {

namespace {

constexpr double kReportStep = 0.01;  // share of a stage between two calls of the callback

}  // namespace

struct Progress::State {
  explicit State(Callback user_callback) : callback(std::move(user_callback)) {}

  void restart() {
    stage.clear();
    stage_begin = stage_end = reported_share = 0;
    fraction = 0;
  }

  void report(double share) {
    reported_share = share;
    if (callback) callback(stage, fraction);
  }

  const Callback callback;
  std::atomic<bool> cancelled{false};
  std::atomic<double> fraction{0.0};  // written under the mutex only

  std::mutex mutex;  // guards all that follows, and the callback
  std::string stage;
  double stage_begin = 0;
  double stage_end = 0;
  double reported_share = 0;
};

Progress::Progress() : Progress(Callback()) {}

Progress::Progress(Callback callback) : state_(std::make_shared<State>(std::move(callback))) {}

void Progress::cancel() {
  state_->cancelled = true;
}

bool Progress::cancelled() const {
  return state_->cancelled;
}

double Progress::fraction() const {
  return state_->fraction;
}

void Progress::reset() {
  const std::lock_guard<std::mutex> lock(state_->mutex);
  state_->cancelled = false;
  state_->restart();
}

void Progress::begin() {
  const std::lock_guard<std::mutex> lock(state_->mutex);
  state_->restart();
}

void Progress::enterStage(const std::string& stage, double end) {
  State& state = *state_;
  const std::lock_guard<std::mutex> lock(state.mutex);
  state.stage = stage;
  state.stage_begin = state.stage_end;
  state.stage_end = std::clamp(end, state.stage_begin, 1.0);
  state.fraction = state.stage_begin;
  state.report(0);
}

void Progress::advance(double share_of_stage) {
  State& state = *state_;
  const std::lock_guard<std::mutex> lock(state.mutex);
  const double share = share_of_stage > 0 ? std::min(share_of_stage, 1.0) : 0.0;
  const double reached =
      std::min(state.stage_end, state.stage_begin + share * (state.stage_end - state.stage_begin));
  state.fraction = std::max(state.fraction.load(), reached);
  const bool finished = share >= 1 && state.reported_share < 1;
  if (finished || share >= state.reported_share + kReportStep) state.report(share);
}

}  // namespace mlsmesh
