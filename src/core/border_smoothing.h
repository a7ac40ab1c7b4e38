// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/mls_refinement.h"

namespace mlsmesh::core {

/// Moves the border vertices of level 0, the only level of `mesh`, outwards in the surface to the rim of the
/// cloud, and evens out the loops they make. `clusters` are the members of each vertex. Vertices on sharp
/// edges stay, as do those inside and those whose move would turn a triangle by more than 60 degrees, raise
/// it more than 45 off the surface, make it degenerate or let it meet another. Sets position (rounded as
/// stored), normal, kind (Border) and nearest of the vertices that it moves, and level_intersections[0] where
/// it moved any; returns how many. O(n log n). Throws Failure(Internal, Cancelled).
Index smoothBorders(const PointSet& points, const MlsSurface& surface, const IndexLists& clusters,
                    const Context& context, RefinedMesh& mesh);

/// How far the border lies, at the middle of the edge of border half-edge `half_edge`, from that middle where
/// it runs as a curve through the ends and their neighbours on the loop: the four-point scheme of N. Dyn,
/// D. Levin, J. Gregory (1987), by length where edges differ. Zero where the loop turns by more than 60
/// degrees at an end.
Vec3 borderCurveOffset(const HalfEdgeMesh& mesh, const std::vector<Vec3>& position, Index half_edge);

}  // namespace mlsmesh::core
