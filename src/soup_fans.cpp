// SPDX-License-Identifier: BSD-3-Clause
#include "soup_fans.h"

#include <array>

namespace mlsmesh {

namespace {

using core::DisjointSets;
using core::Index;
using core::kNone;

std::array<Index, 2> endsOf(const EdgeTable& edges, Index edge) {
  const Index h = edges.halfEdge(edge, 0);
  return {edges.origin(h), edges.target(h)};
}

}  // namespace

DisjointSets joinFans(const EdgeTable& edges) {
  DisjointSets fans(static_cast<std::size_t>(edges.halfEdgeCount()));
  for (Index edge = 0; edge < edges.edgeCount(); ++edge) {
    if (edges.facesAt(edge) != 2) continue;
    for (const Index end : endsOf(edges, edge))
      fans.join(edges.cornerAt(edges.halfEdge(edge, 0), end), edges.cornerAt(edges.halfEdge(edge, 1), end));
  }
  return fans;
}

std::vector<VertexFault> vertexFaults(const EdgeTable& edges, DisjointSets& fans) {
  std::vector<VertexFault> faults(edges.vertexCount(), VertexFault::None);
  std::vector<char> has_fan(edges.vertexCount(), 0);
  for (Index corner = 0; corner < edges.halfEdgeCount(); ++corner) {
    if (fans.leader(corner) != corner) continue;
    char& seen = has_fan[edges.origin(corner)];
    if (seen != 0) faults[edges.origin(corner)] = VertexFault::BowTie;
    seen = 1;
  }
  for (Index edge = 0; edge < edges.edgeCount(); ++edge) {
    if (edges.facesAt(edge) <= 2) continue;
    for (const Index end : endsOf(edges, edge)) faults[end] = VertexFault::NonmanifoldEdge;
  }
  return faults;
}

DisjointSets joinBorderEdges(const EdgeTable& edges, DisjointSets& fans, std::vector<char>& is_open) {
  DisjointSets joined(static_cast<std::size_t>(edges.edgeCount()));
  std::vector<Index> waiting(edges.halfEdgeCount(), kNone);  // border edge of a fan that lacks the other
  for (Index edge = 0; edge < edges.edgeCount(); ++edge) {
    if (edges.facesAt(edge) != 1) continue;
    for (const Index end : endsOf(edges, edge)) {
      Index& other = waiting[fans.leader(edges.cornerAt(edges.halfEdge(edge, 0), end))];
      if (other != kNone) joined.join(other, edge);
      other = other == kNone ? edge : kNone;
    }
  }
  is_open.assign(edges.edgeCount(), 0);
  for (const Index edge : waiting)
    if (edge != kNone) is_open[joined.leader(edge)] = 1;
  return joined;
}

}  // namespace mlsmesh
