// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "mlsmesh/core/types.h"

namespace mlsmesh {

/// Whether the three are different vertices of 0 .. vertices - 1.
bool hasThreeCorners(const core::Triangle& face, core::Index vertices);

/// The faces of a soup that have three corners, in order.
std::vector<core::Triangle> facesWithThreeCorners(const std::vector<core::Triangle>& faces,
                                                  core::Index vertices);

/// The edges of a triangle soup, each with all of its half-edges; half-edge 3 * face + corner runs from that
/// corner to the next. Edges are in order of (lower vertex, higher vertex), half-edges of an edge ascending.
class EdgeTable {
 public:
  using Index = core::Index;

  /// Every face has three corners (hasThreeCorners). Throws core::Failure(IndexOverflow) beyond 2^31 - 1
  /// half-edges. O(n log n).
  EdgeTable(Index vertices, std::vector<core::Triangle> faces);

  Index vertexCount() const { return vertices_; }
  Index faceCount() const { return static_cast<Index>(faces_.size()); }
  const core::Triangle& face(Index face) const { return faces_[face]; }
  Index halfEdgeCount() const { return 3 * faceCount(); }
  Index edgeCount() const { return static_cast<Index>(begin_.size()) - 1; }
  /// How many faces an edge has.
  Index facesAt(Index edge) const { return begin_[edge + 1] - begin_[edge]; }
  /// Half-edge of the `nth` face at an edge.
  Index halfEdge(Index edge, Index nth) const { return sorted_[begin_[edge] + nth]; }

  static Index next(Index half_edge) { return half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1; }
  Index origin(Index half_edge) const { return faces_[half_edge / 3][half_edge % 3]; }
  Index target(Index half_edge) const { return origin(next(half_edge)); }
  Index opposite(Index half_edge) const { return origin(next(next(half_edge))); }
  /// The corner of the half-edge's face at `vertex`, one of its ends, named by the half-edge that leaves it.
  Index cornerAt(Index half_edge, Index vertex) const {
    return origin(half_edge) == vertex ? half_edge : next(half_edge);
  }
  /// Whether the two faces of a two-face edge run it in the same direction.
  bool isConflict(Index edge) const { return origin(halfEdge(edge, 0)) == origin(halfEdge(edge, 1)); }

 private:
  Index low(Index half_edge) const;
  Index high(Index half_edge) const;
  void sortHalfEdges();

  Index vertices_;
  std::vector<core::Triangle> faces_;
  std::vector<Index> sorted_;
  std::vector<Index> begin_;
};

}  // namespace mlsmesh
