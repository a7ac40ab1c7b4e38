// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/context.h"
#include "mlsmesh/core/half_edge_mesh.h"

namespace mlsmesh::core {

/// Two triangles by number, the lower first.
using TrianglePair = std::array<Index, 2>;

/// Finds the pairs of triangles that meet anywhere outside of the corner or edge that they share. Exact for
/// the positions as they are; touching counts. Corners at equal positions are shared; triangles that share
/// all three corners are no pair, and degenerate ones (collinear or not finite) are in none. Holds
/// references: positions and triangles must outlive it, and whoever changes them calls update(). Memory:
/// about 50 bytes a triangle.
class SelfIntersections {
 public:
  /// Corners must be vertices. `mesh`, if not null, is the mesh of these triangles, numbered alike; where it
  /// has none alive, the triangle must be degenerate. It is only read here, makes searches faster, and tells
  /// edges from others at the same place: two triangles with such meet too. O(n log n). Throws
  /// Failure(Cancelled), as do the searches.
  SelfIntersections(const std::vector<Vec3>& position, const std::vector<Triangle>& triangles,
                    const Context& context, const HalfEdgeMesh* mesh = nullptr);

  /// All pairs, ascending. O(n log n) where triangles do not pile up in one place.
  std::vector<TrianglePair> all() const;
  /// The number of all pairs, without keeping them.
  std::int64_t count() const;
  /// All pairs in which one of `triangles` takes part, ascending; repeats are ignored. O(log n) for each.
  std::vector<TrianglePair> involving(const std::vector<Index>& triangles) const;
  /// To be told of every triangle whose corners, or their positions, changed, before the next search.
  void update(const std::vector<Index>& triangles);

 private:
  static constexpr std::size_t kRun = 8;  // boxes that lie side by side, under one of the next level

  // Rounded outwards, finite; an empty one is not, and overlaps nothing.
  struct Box {
    std::array<float, 3> low, high;
  };
  struct Run {
    std::array<std::array<float, kRun>, 3> low, high;
  };

  // A triangle seen along the three axes: from which side, 0 where not clear, and along which one it is
  // widest.
  struct View {
    std::array<std::int8_t, 3> side;
    std::uint8_t widest;

    bool isOnEdge() const { return side[0] == 0 && side[1] == 0 && side[2] == 0; }
  };

  static std::size_t runsOf(std::size_t count) { return (count + kRun - 1) / kRun; }
  static Box emptyBox();
  static Box everything();
  static Run emptyRun();
  static unsigned overlaps(const Run& run, const Box& box);
  static Box boxIn(const Run& run, std::size_t lane);
  static void put(const Box& box, std::size_t lane, Run& run);
  static View viewOf(const Vec3& a, const Vec3& b, const Vec3& c);
  Box boxOf(Index triangle) const;
  void orderByPlace();
  void measure(std::size_t rank);
  void sumUp(std::size_t level, std::size_t run);
  void findSpread(const HalfEdgeMesh& mesh);
  bool meet(Index a, Index b) const;
  template <typename Visit>
  void visitRuns(const Box& box, std::size_t first_run, const Visit& visit) const;
  template <typename Found>
  void searchRun(std::size_t run, const Found& found) const;

  const std::vector<Vec3>& position_;
  const std::vector<Triangle>& triangles_;
  const Context& context_;
  std::vector<Index> order_;          // triangles by place
  std::vector<Index> rank_;           // where a triangle is in the order
  std::vector<View> view_;            // of every triangle
  bool knows_edges_;                  // as those of a mesh
  std::vector<std::uint8_t> spread_;  // vertices that keep their triangles apart, as far as known
  std::vector<std::vector<Run>>
      levels_;  // of the triangles in their order, of those runs, of their runs, ...
};

}  // namespace mlsmesh::core
