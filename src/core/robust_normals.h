// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sparse_neighbors.h"

namespace mlsmesh::core {

/// Normals that stay those of one side up to a sharp edge, for those points of a set that were asked for.
struct RobustNormals {
  std::vector<Vec3> normal;  ///< unit, sign arbitrary; zero where unknown; one a point of the set, or none

  bool knows(Index point) const { return !normal.empty() && normal[point].squaredNorm() > 0; }
};

/// Adds the normals of `wanted` points that are not known yet. `neighbors` gets what it needs for that: rows
/// of the points and of their nearest 16. O(points) eigenvalue problems, in parallel.
void addRobustNormals(const std::vector<Index>& wanted, SparseNeighbors& neighbors, const Context& context,
                      RobustNormals& normals);

}  // namespace mlsmesh::core
