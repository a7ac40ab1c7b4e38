// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>

#include "mlsmesh/core/context.h"

namespace mlsmesh::core {

/// Calls `body(first, last)` over blocks that cover [0, count), on the context's threads, in no particular
/// order; the body writes by index only, so the result is the same for any number of threads. Between blocks
/// the progress handle is asked and told. Throws what the first failing block (in block order) threw, or
/// Failure(Cancelled). Where the system has no room for so many threads there are fewer.
void parallelBlocks(const Context& context, std::size_t count, std::size_t block,
                    const std::function<void(std::size_t first, std::size_t last)>& body);

/// The number of threads that a setting stands for; 0 = all that OpenMP would take (every core, unless
/// OMP_NUM_THREADS says otherwise).
int threadCount(int setting);

}  // namespace mlsmesh::core
