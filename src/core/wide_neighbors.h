// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/neighbor_search.h"

namespace mlsmesh::core {

/// Points whose neighbours are on one line with them, along scan lines or the narrow rings of a graduated
/// sphere, have no surface around them. Where `on_line` is not 0, the row of the table becomes the neighbours
/// in all directions, of the nearest 96, still in order of distance; the spacing becomes the mean distance to
/// the nearest in each direction, and the normal that of the plane along which these lie. O(log n) for each.
void widenLines(const std::vector<Vec3>& points, const std::vector<char>& on_line,
                const NeighborSearch& search, const Context& context, NeighborTable& neighbors,
                std::vector<double>& spacing, std::vector<Vec3>& normals);

}  // namespace mlsmesh::core
