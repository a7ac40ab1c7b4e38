// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <unordered_map>

#include "mlsmesh/core/half_edge_mesh.h"

namespace mlsmesh::core {

/// The patch that was last added to a mesh: its triangles are all of those slots from first_triangle on that
/// live, its own vertices all from first_vertex on; the others are its rim.
struct PatchRange {
  Index first_triangle = 0;
  Index first_vertex = 0;
};

/// Brings a patch to the edge lengths of its surroundings. Its border stays as it is. Neither a duplicate
/// edge nor, once splitChords() was called, an edge across the patch between two vertices of its rim comes
/// into being. Holds references.
class PatchRefiner {
 public:
  /// `rim` are the vertices of the patch's border; the lengths asked for there are the means of the edges
  /// outside the patch.
  PatchRefiner(HalfEdgeMesh& mesh, std::vector<Vec3>& points, PatchRange range,
               const std::vector<Index>& rim);

  /// Puts a vertex on the middle of every edge across the patch between two vertices of its rim.
  void splitChords();
  /// Puts vertices into the middles of triangles, and flips edges, until all triangles are as small as the
  /// edge lengths interpolated from the rim ask for, or the patch has 50,000 vertices, or 500 and the square
  /// of those on its rim: a ball on a rim of even edges has less than half as many. True if there are new
  /// ones.
  bool divide();
  /// Flips edges until the angles opposite to each sum up to half a turn at most, or 20 rounds have passed.
  void flipToDelaunay();

 private:
  bool isOwn(Index vertex) const { return vertex >= range_.first_vertex; }
  double sizeAt(Index vertex) const;
  bool divideOnce();
  bool isTooLarge(const Triangle& corners, double size, const Vec3& middle) const;
  bool mayFlip(Index half_edge) const;
  bool isDelaunay(Index half_edge) const;
  Index addVertex(const Vec3& point, double size);

  HalfEdgeMesh& mesh_;
  std::vector<Vec3>& points_;
  const PatchRange range_;
  const Index most_vertices_;
  std::unordered_map<Index, double> rim_size_;  // edge length asked for at the vertices of the rim
  std::vector<double> own_size_;                // and at the patch's own
};

}  // namespace mlsmesh::core
