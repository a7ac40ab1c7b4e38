// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/half_edge_mesh.h"

namespace mlsmesh::core {

/// A closed polygon of distinct vertices; side i runs from vertex i to the next one, the last back to the
/// first. A triangle that is put into it runs along its sides.
struct FillPolygon {
  std::vector<Index> vertex;
  std::vector<Index> beyond;  ///< of each side: the third vertex of the triangle beyond it, or kNone
};

struct FillRule {
  double worst_bend = 3.15;  ///< radians; a fill that bends more is none
  bool slivers = false;      ///< triangles without area may be used
};

/// The polygon that closes a loop of border half-edges, given in walking order.
FillPolygon polygonOf(const HalfEdgeMesh& mesh, const std::vector<Index>& loop);

/// Triangles that fill the polygon, or none. The fill has the smallest worst dihedral bend, of equals the
/// smallest area; its inner edges are none of the mesh's. O(n^3) time, O(n^2) memory.
std::vector<Triangle> fillPolygon(const HalfEdgeMesh& mesh, const std::vector<Vec3>& points,
                                  const FillPolygon& polygon, const FillRule& rule);

}  // namespace mlsmesh::core
