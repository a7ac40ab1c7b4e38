// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "edge_flips.h"
#include "mlsmesh/core/mls_refinement.h"
#include "mlsmesh/core/self_intersections.h"

namespace mlsmesh::core {

/// A level that has just been made. Triangles are numbered alike before and after its flips.
struct NewLevel {
  Index first_vertex = 0;           ///< vertices from here on are its own
  std::vector<Vec3> midpoint;       ///< of the edge that each of them was made on, as stored
  std::vector<Triangle> unflipped;  ///< its triangles before flips, none degenerate
  HalfEdgeMesh flipped;             ///< after them
  std::vector<FlippedPair> flips;   ///< all of them
};

/// Takes back what makes the level intersect itself: flips near intersecting triangles, then, where that is
/// not enough, half the displacement of their new vertices, twice, then all of it. At the extreme a region is
/// its parent's again, so that a level has no intersections where the level before has none, but for the
/// rounding of midpoints. Vertices of older levels stay. Changes `refined.position` and, to FoldGuarded,
/// `refined.kind`; `triangles` are those of the level, in place. Returns the pairs that are left.
std::vector<TrianglePair> guardIntersections(const PointSet& points, const NewLevel& level,
                                             const Context& context, RefinedMesh& refined,
                                             std::vector<Triangle>& triangles);

}  // namespace mlsmesh::core
