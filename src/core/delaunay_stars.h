// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/neighbor_search.h"
#include "mlsmesh/core/types.h"

namespace mlsmesh::core {

/// The neighbours around every point in cyclic order, counter-clockwise about its normal: the local Delaunay
/// star in its tangent plane. Two neighbours that follow each other (the last and the first too) span a
/// triangle with the point; kNone stands where the star is open.
using StarRings = IndexLists;

/// Unit normals (sign arbitrary) of the plane through each point and its nearest neighbours. `on_line`, if
/// not null, gets 1 for each point that these lie on a line with, or on an arc, so that the plane means
/// little.
std::vector<Vec3> tangentNormals(const std::vector<Vec3>& points, const NeighborTable& neighbors,
                                 const Context& context, std::vector<char>* on_line = nullptr);

/// Stars of all points, in parallel. No edge is longer than length_factor * the larger local spacing of its
/// ends.
StarRings localStars(const std::vector<Vec3>& points, const std::vector<Vec3>& normals,
                     const NeighborTable& neighbors, const std::vector<double>& spacing, double length_factor,
                     const Context& context);

/// Triangles on which the stars of all three corners agree, edge-connected with consistent orientation:
/// island i is triangles[begin[i] .. begin[i + 1]), largest island first (ties: lowest triangle first).
struct Islands {
  std::vector<Triangle> triangles;
  std::vector<Index> begin{0};

  Index count() const { return static_cast<Index>(begin.size()) - 1; }
};

Islands agreedIslands(const StarRings& stars, const Context& context);

}  // namespace mlsmesh::core
