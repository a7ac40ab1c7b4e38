// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "mlsmesh/core/neighbor_search.h"

namespace mlsmesh::core {

/// A k-d tree over points that do not change, for exact searches. Unlike FLANN's, with which it shares cells
/// and speed, it asks the context while it is built, and throws std::bad_alloc where there is no memory.
class KdTree final : public NeighborSearch {
 public:
  /// Without `copy` the points must stay where they are; with it 24 bytes a point more are taken. Beside that
  /// 4 bytes a point, and 8 for the cells. Throws Failure(Cancelled). O(n log n) for points that are not
  /// bunched up without end.
  KdTree(const std::vector<Vec3>& points, bool copy, const Context& context);

  Index size() const override { return static_cast<Index>(order_.size()); }
  int nearest(const Vec3& query, int k, Index* indices, double* squared_distances) const override;

 private:
  class Builder;
  class Query;

  /// A leaf holds the points order_[first .. last). Else what is in the left child, the next cell, is at most
  /// `low` along the axis, and what is in the right one, cells_[first], at least `high`.
  struct Cell {
    double low = 0, high = 0;
    Index first = 0, last = 0;
    int axis = kNone;
  };
  struct Box {
    Vec3 low, high;
  };

  const std::vector<Vec3>& points_;
  std::vector<Index> order_;
  std::vector<Vec3> copy_;  ///< in the order of order_; may be empty
  std::vector<Cell> cells_;
  Box box_{Vec3::Zero(), Vec3::Zero()};
};

}  // namespace mlsmesh::core
