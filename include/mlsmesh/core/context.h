// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "mlsmesh/progress.h"

namespace mlsmesh::core {

/// What every step is given beside its data: how many threads it may use, the handle that can stop it, and
/// where it leaves its warnings. Results never depend on the number of threads.
struct Context {
  int threads = 0;  ///< 0 = all that the machine has
  Progress progress;
  std::vector<std::string> warnings;

  /// Throws Failure(Cancelled) when the handle says so.
  void checkCancelled() const;
};

}  // namespace mlsmesh::core
