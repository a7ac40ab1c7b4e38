// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/half_edge_mesh.h"

namespace mlsmesh::core {

/// Closes the loop of these border half-edges by the back of the sheet that it is the border of: a turned
/// copy of the sheet's triangles, with vertices of its own in the same places (appended to `points`) but on
/// the loop, and on the middles of edges between two vertices of the loop. False, and nothing changed, unless
/// the component has no other border and no handle. O(n) of the component.
bool addShell(HalfEdgeMesh& mesh, std::vector<Vec3>& points, const std::vector<Index>& loop);

}  // namespace mlsmesh::core
