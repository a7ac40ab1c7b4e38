// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/half_edge_mesh.h"

namespace mlsmesh::core {

/// Closes the loop of these border half-edges (in walking order, each vertex once) with a disc of triangles.
/// Its shape is rough, and triangles may be without area. They lie between the vertices of the loop, or,
/// where an edge which that would need is taken, and in loops of three edges, around a new vertex in the
/// middle, which is appended to `points` (one a vertex of the mesh). O(n), with a large constant.
void outlinePatch(HalfEdgeMesh& mesh, std::vector<Vec3>& points, const std::vector<Index>& loop);

}  // namespace mlsmesh::core
