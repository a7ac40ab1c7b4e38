// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/half_edge_mesh.h"

namespace mlsmesh::core {

/// The normals that the surface has at a vertex: one on a smooth place, two or three on a sharp edge; none
/// where edges are to stay as they are.
struct VertexSides {
  std::array<Vec3, 3> normal;  ///< unit, sign arbitrary
  int count = 0;
};

/// Flips edges so that triangles lie on one side of the sharp edges and not across them: those whose normals
/// then differ less from the normals of their corners, largest gain first. Only edges whose four vertices all
/// have sides. Never makes a duplicate edge, a sliver where there was none, or a fold. Returns how many.
Index flipToSides(HalfEdgeMesh& mesh, const std::vector<Vec3>& position,
                  const std::vector<VertexSides>& sides);

}  // namespace mlsmesh::core
