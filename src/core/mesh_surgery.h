// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>

#include "mlsmesh/core/half_edge_mesh.h"
#include "mlsmesh/core/self_intersections.h"

namespace mlsmesh::core {

/// A mesh under repair: triangles go and come, and the pairs of them that meet where they should not are
/// known at every moment. Any number of changes can be taken back. Holds references. Not thread-safe.
class MeshSurgery {
 public:
  /// Finds all pairs. `mesh` may have pinches; its vertices are the points. Throws Failure(Cancelled).
  MeshSurgery(HalfEdgeMesh& mesh, const std::vector<Vec3>& points, const Context& context);

  const HalfEdgeMesh& mesh() const { return mesh_; }
  const std::vector<Vec3>& points() const { return points_; }
  const Context& context() const { return context_; }
  const std::set<TrianglePair>& pairs() const { return pairs_; }
  /// The triangles that this one meets where it should not, ascending. O(log pairs) each.
  std::vector<Index> partnersOf(Index triangle) const;
  /// V - E + F of the vertices that triangles use.
  Index euler() const { return used_ - (3 * mesh_.triangleCount() + border_) / 2 + mesh_.triangleCount(); }
  Index borderEdges() const { return border_; }
  Index usedVertices() const { return used_; }

  void remove(const std::vector<Index>& triangles);
  /// Adds all of the triangles, or none and returns false where one does not fit (HalfEdgeMesh::canAdd).
  bool add(const std::vector<Triangle>& triangles);

  /// How much has been done; undo() goes back to it.
  std::size_t mark() const { return log_.size(); }
  void undo(std::size_t mark);
  /// Triangles added since the mark that are still there.
  std::vector<Index> addedSince(std::size_t mark) const;
  /// The border half-edges that removals since the mark opened and nothing has closed.
  std::vector<Index> openedSince(std::size_t mark) const;

 private:
  struct Step {
    Index triangle;
    Triangle corners;
    bool added;
  };

  void renewSearch();
  void takeOut(Index triangle);
  Index putIn(const Triangle& corners, Index slot);
  Index freeSlot();
  void notePair(const TrianglePair& pair);
  void forgetPairs(const std::vector<Index>& triangles);
  void findPairs(const std::vector<Index>& triangles);

  HalfEdgeMesh& mesh_;
  const std::vector<Vec3>& points_;
  const Context& context_;
  std::vector<Triangle> slots_;  // as the search sees them: dead and spare ones are a point
  std::vector<Index> free_;      // dead slots, the next one last
  std::unique_ptr<SelfIntersections> search_;
  std::set<TrianglePair> pairs_;
  std::set<TrianglePair> reversed_;  // the same, the higher first
  std::vector<Step> log_;
  Index border_ = 0;
  Index used_ = 0;
};

}  // namespace mlsmesh::core
