// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace mlsmesh::test {

/// Forgets what was allocated so far.
void resetLargestAllocation();
/// Bytes of the largest block that was asked for since, by whatever library of the process.
std::size_t largestAllocation();

}  // namespace mlsmesh::test
