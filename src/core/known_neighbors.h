// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/neighbor_search.h"

namespace mlsmesh::core {

/// The nearest others of points, kept for as long as these stay where they are. Several steps ask for those
/// of the representatives, which mostly do not change in between.
class KnownNeighbors {
 public:
  /// The table with the `k` nearest others of each point (fewer if there are not so many); asks, with a k-d
  /// tree of its own, unless that was the last question. Valid until the next one.
  const NeighborTable& of(const std::vector<Vec3>& points, int k, const Context& context) {
    if (k != asked_ || points != points_) {
      table_ = nearestOfAll(points, *makeKdTreeOver(points, context), k, context);
      asked_ = k;
      points_ = points;
    }
    return table_;
  }

 private:
  int asked_ = 0;
  std::vector<Vec3> points_;
  NeighborTable table_;
};

}  // namespace mlsmesh::core
