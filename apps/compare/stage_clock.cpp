// SPDX-License-Identifier: BSD-3-Clause
#include "compare/stage_clock.h"

#include <chrono>

namespace mlsmesh::apps {

double wallSeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void StageClock::begin(const std::string& name) {
  end();
  present_ = name;
  runs_ = true;
  began_ = wallSeconds();
}

void StageClock::end() {
  if (runs_) stages_.push_back({present_, secondsSoFar()});
  runs_ = false;
}

double StageClock::secondsSoFar() const {
  return runs_ ? wallSeconds() - began_ : 0;
}

}  // namespace mlsmesh::apps
