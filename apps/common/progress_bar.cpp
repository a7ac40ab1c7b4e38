// SPDX-License-Identifier: BSD-3-Clause
#include "common/progress_bar.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace mlsmesh::apps {

ProgressBar::ProgressBar(bool wanted) : visible_(wanted && isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() {
  wipe();
}

void ProgressBar::draw(const std::string& stage, double fraction) {
  if (!visible_) return;
  constexpr int kCells = 30;
  const double share = std::clamp(fraction, 0.0, 1.0);
  const int filled = static_cast<int>(share * kCells);
  char line[80];
  std::snprintf(line, sizeof line, "[%.*s%*s] %3d %% %-20.20s", filled, "##############################",
                kCells - filled, "", static_cast<int>(share * 100), stage.c_str());
  if (line_ == line) return;
  line_ = line;
  std::fprintf(stderr, "\r%s", line);
  std::fflush(stderr);
}

void ProgressBar::wipe() {
  if (line_.empty()) return;
  std::fprintf(stderr, "\r%*s\r", static_cast<int>(line_.size()), "");
  std::fflush(stderr);
  line_.clear();
}

}  // namespace mlsmesh::apps
