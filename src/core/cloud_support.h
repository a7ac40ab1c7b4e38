// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/neighbor_search.h"

namespace mlsmesh::core {

/// Tells whether triangles over representatives lie where the cloud behind them has points.
/// Default-constructed (or with reach 0) it supports everything. Const and thread-safe.
class CloudSupport {
 public:
  CloudSupport() = default;
  /// `spacing` is the cloud's local spacing at each of `points`; both and the search must outlive this.
  CloudSupport(const std::vector<Vec3>& points, const std::vector<double>& spacing,
               const NeighborSearch& cloud, double reach)
      : points_(&points), spacing_(&spacing), cloud_(reach > 0 ? &cloud : nullptr), reach_(reach) {}

  /// Makes known the points of the cloud and, of each point, the nearest of them; both must outlive this.
  void knowNearest(const std::vector<Vec3>& cloud_points, const std::vector<Index>& nearest) {
    cloud_points_ = &cloud_points;
    nearest_ = &nearest;
  }

  bool testsAnything() const { return cloud_ != nullptr; }
  /// Whether the centroid and the midpoints of the edges each have a point of the cloud within reach. Short
  /// triangles always do. Four searches for one neighbour at most.
  bool supports(const Triangle& triangle) const { return supports(triangle, reach_); }
  bool supports(const Triangle& triangle, double reach) const;

 private:
  bool isNear(const Vec3& position, const Triangle& triangle, double distance) const;

  const std::vector<Vec3>* points_ = nullptr;
  const std::vector<double>* spacing_ = nullptr;
  const NeighborSearch* cloud_ = nullptr;
  const std::vector<Vec3>* cloud_points_ = nullptr;
  const std::vector<Index>* nearest_ = nullptr;
  double reach_ = 0;
};

}  // namespace mlsmesh::core
