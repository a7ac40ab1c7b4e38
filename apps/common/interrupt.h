// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/progress.h"

namespace mlsmesh::apps {

/// While it lives, the first SIGINT or SIGTERM cancels `progress`; a second one ends the program at once.
/// Writing beyond a file size limit is an error instead of a signal. One at a time.
class InterruptGuard {
 public:
  explicit InterruptGuard(const Progress& progress);
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  /// Throws AppError with the exit code 128 + signal if one has come.
  static void check();

 private:
  Progress progress_;
};

}  // namespace mlsmesh::apps
