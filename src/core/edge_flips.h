// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/half_edge_mesh.h"
#include "mlsmesh/core/mls_surface.h"
#include "mlsmesh/parameters.h"

namespace mlsmesh::core {

/// The triangles that a flip turned an edge between; they keep their numbers.
using FlippedPair = std::array<Index, 2>;

/// Flips edges by the rule until none qualifies or ten rounds have passed; returns how many, and appends them
/// to `flips`, if not null, in order. Never makes a duplicate edge, a degenerate face or an interior vertex
/// of fewer than three triangles. With `guard` also: the two triangles form a convex quad seen along their
/// mean normal, neither new triangle turns more than 60 degrees from it, and the edge and the four around it
/// are not bent worse than before (or 15 degrees). If kinds are given, a quad with a crease vertex is flipped
/// only where its triangles are bent by less than 15 degrees before and after, and edges do not cross the
/// rims of patches.
Index flipEdges(HalfEdgeMesh& mesh, const std::vector<Vec3>& position, FlipRule rule, bool guard,
                const Context& context, const std::vector<VertexKind>* kinds = nullptr,
                std::vector<FlippedPair>* flips = nullptr);

}  // namespace mlsmesh::core
