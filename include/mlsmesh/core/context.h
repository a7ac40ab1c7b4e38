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

/// For loops on one thread that are long over large clouds: looks at the handle once in so many rounds.
class CancelCheck {
 public:
  explicit CancelCheck(const Context& context) : context_(context) {}

  /// To be called in each round, of less than a few microseconds. Throws as Context::checkCancelled.
  void operator()() {
    constexpr unsigned kRounds = 4096;
    if (++rounds_ % kRounds == 0) context_.checkCancelled();
  }

 private:
  const Context& context_;
  unsigned rounds_ = 0;
};

}  // namespace mlsmesh::core
