// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/half_edge_mesh.h"

namespace mlsmesh::core {

/// Where the patch's own vertices, first_vertex .. vertexCount() - 1 of the mesh, lie on a membrane over its
/// rim: every one in the middle of its neighbours. The border of the patch must be closed. Any positions of
/// theirs will do. About O(n^1.5). Here as below, not numbers where edges are too different for doubles.
std::vector<Vec3> membrane(const HalfEdgeMesh& mesh, const std::vector<Vec3>& points, Index first_vertex);

/// Where they lie on a surface that goes on as the mesh around the patch bends: the squared curvature, summed
/// over the patch and its rim, is least. Its weights come from the lengths of the edges as they are. About
/// O(n^1.5).
std::vector<Vec3> fairSurface(const HalfEdgeMesh& mesh, const std::vector<Vec3>& points, Index first_vertex,
                              const std::vector<Index>& rim);

/// Heights of a cushion on the membrane, 0 on the rim and 1 at the vertices next to it, on average: in the
/// plane, and on a round patch, half an ellipsoid. About O(n^1.5).
std::vector<double> cushion(const HalfEdgeMesh& mesh, const std::vector<Vec3>& points, Index first_vertex);

}  // namespace mlsmesh::core
