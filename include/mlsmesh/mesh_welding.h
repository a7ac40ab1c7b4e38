// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "mlsmesh/core/types.h"

namespace mlsmesh {

/// For every position the lowest index with exactly that position (0 and -0 are the same; one that is not
/// finite is alone). O(n log n).
std::vector<core::Index> firstAtSamePosition(const std::vector<core::Vec3>& positions);

/// Merges vertices at exactly the same position; the first of each stays, and their order. Corners must be
/// vertices. Returns how many went.
core::Index weldVertices(std::vector<core::Vec3>& vertices, std::vector<core::Triangle>& triangles);

}  // namespace mlsmesh
