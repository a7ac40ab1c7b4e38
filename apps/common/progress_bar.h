// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace mlsmesh::apps {

/// One line on stderr that is drawn over and over, only if stderr is a terminal; wiped when it goes out of
/// scope.
class ProgressBar {
 public:
  explicit ProgressBar(bool wanted);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// `fraction` of the whole, 0 .. 1.
  void draw(const std::string& stage, double fraction);
  /// Wipes the line, so that other text can be printed.
  void wipe();

 private:
  bool visible_;
  std::string line_;
};

}  // namespace mlsmesh::apps
