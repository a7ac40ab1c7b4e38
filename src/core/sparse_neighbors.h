// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/neighbor_search.h"

namespace mlsmesh::core {

/// The k nearest points (itself first) and the local spacing of those points of a set that were asked for.
class SparseNeighbors {
 public:
  /// Holds references; both must outlive this. `k` is at most the number of points.
  SparseNeighbors(const std::vector<Vec3>& points, const NeighborSearch& search, int k);

  /// Looks up the points of the list that are not here yet, in parallel; each gets the next slot, in the
  /// order of the list.
  void add(const std::vector<Index>& points, const Context& context);
  /// The points and all their first `count` neighbours, ascending, each once. All points must be here.
  std::vector<Index> grown(const std::vector<Index>& points, int count) const;

  int k() const { return k_; }
  Index count() const { return static_cast<Index>(point_.size()); }
  Index slot(Index point) const { return slot_[point]; }
  bool has(Index point) const { return slot_[point] != kNone; }
  Index point(Index slot) const { return point_[slot]; }
  const Index* row(Index point) const {
    return neighbor_.data() + static_cast<std::size_t>(slot_[point]) * static_cast<std::size_t>(k_);
  }
  /// Mean distance to the 6 nearest others.
  double spacing(Index point) const { return spacing_[slot_[point]]; }
  const std::vector<Vec3>& positions() const { return points_; }

 private:
  const std::vector<Vec3>& points_;
  const NeighborSearch& search_;
  int k_;
  std::vector<Index> slot_;      // of every point, or kNone
  std::vector<Index> point_;     // of every slot
  std::vector<Index> neighbor_;  // k a slot
  std::vector<double> spacing_;  // a slot
};

}  // namespace mlsmesh::core
