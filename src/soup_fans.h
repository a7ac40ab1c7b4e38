// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/disjoint_sets.h"
#include "edge_table.h"

namespace mlsmesh {

/// Corners of a soup joined into fans: round a vertex, across edges of two faces. A corner is named by the
/// half-edge that leaves it.
core::DisjointSets joinFans(const EdgeTable& edges);

enum class VertexFault : char { None, BowTie, NonmanifoldEdge };

/// Of every vertex: more than one fan, or an edge of three faces or more.
std::vector<VertexFault> vertexFaults(const EdgeTable& edges, core::DisjointSets& fans);

/// Edges joined into borders: where one fan has two border edges. `is_open[leader]` tells that a border is a
/// chain, because a fan at one of its ends stops at a non-manifold edge. Edges that are no border edges stay
/// alone.
core::DisjointSets joinBorderEdges(const EdgeTable& edges, core::DisjointSets& fans,
                                   std::vector<char>& is_open);

}  // namespace mlsmesh
