// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/context.h"
#include "mlsmesh/core/types.h"
#include "mlsmesh/statistics.h"

namespace mlsmesh {

/// Sizes of a triangle soup, and how well its triangles are shaped. Angles are in degrees.
struct MeshShape {
  double diagonal = 0;  ///< of the box around the vertices in use
  double area = 0;
  Statistics quality;         ///< 2 * inradius / circumradius of a triangle: 1 equilateral, 0 degenerate
  Statistics smallest_angle;  ///< of each triangle
  Statistics largest_angle;   ///< of each triangle
  Statistics edge_length;     ///< of each edge
  /// Smallest angle between the two triangles of an edge, neither of them degenerate; 180 where they are
  /// flat, kUnknown if there is no such edge.
  double smallest_dihedral = kUnknown;
  core::Index folded_edges = 0;   ///< with an angle between their two triangles below 30
  core::Index flipped_edges = 0;  ///< below 5
};

/// Faces with a repeated index, or one out of [0, vertices), are left out; positions in use must be finite.
/// O(n log n). Throws core::Failure: IndexOverflow, Cancelled.
MeshShape meshShape(const std::vector<core::Vec3>& vertices, const std::vector<core::Triangle>& triangles,
                    const core::Context& context);

/// Diagonal of the box around the vertices of the triangles, whose corners must be vertices; 0 without any.
double diagonalOf(const std::vector<core::Vec3>& vertices, const std::vector<core::Triangle>& triangles);

}  // namespace mlsmesh
