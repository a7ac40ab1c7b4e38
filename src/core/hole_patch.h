// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/point_set.h"
#include "patch_refiner.h"

namespace mlsmesh::core {

enum class PatchStyle {
  Smooth,  ///< goes on as its surroundings bend
  Plain,   ///< lies on the triangles that span the hole with least bend and area
  Shell,   ///< is the back of the sheet that the loop is the border of
};

/// Triangles over a hole, and the surfaces that its own vertices may lie on.
struct HolePatch {
  std::vector<Index> rim;                      ///< vertices of the hole's border
  Index first_triangle = 0, end_triangle = 0;  ///< slots; some are dead
  Index first_vertex = 0, end_vertex = 0;      ///< its own
  std::vector<Index> source;                   ///< vertex of the rim nearest to each of them along edges
  /// Positions of its own vertices, as stored: the one that is best where it fits first, the one that is
  /// likeliest to fit last.
  std::vector<std::vector<Vec3>> shapes;
};

/// Adds a patch over the loop of these border half-edges to the mesh; `position` (one a vertex) grows alike.
HolePatch makePatch(const PointSet& points, const std::vector<Index>& loop, PatchStyle style,
                    HalfEdgeMesh& mesh, std::vector<Vec3>& position);

}  // namespace mlsmesh::core
