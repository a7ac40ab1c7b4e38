// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sparse_neighbors.h"

namespace mlsmesh::core {

/// Normals that stay those of one side up to a sharp edge, for those points of a set that were asked for.
class RobustNormals {
 public:
  /// Holds a reference. No normal is known yet.
  explicit RobustNormals(SparseNeighbors& neighbors)
      : neighbors_(neighbors), normal_(neighbors.positions().size(), Vec3::Zero()) {}

  /// Adds the normals of those `wanted` points that are not known yet. The neighbours get what that needs:
  /// rows of the points and of their nearest 16. An eigenvalue problem for each of those, in parallel.
  void add(const std::vector<Index>& wanted, const Context& context);

  bool knows(Index point) const { return normal_[point].squaredNorm() > 0; }
  /// Of every point: unit, sign arbitrary; zero where unknown.
  const std::vector<Vec3>& all() const { return normal_; }
  const Vec3& operator[](Index point) const { return normal_[point]; }

 private:
  struct Plane {
    Vec3 normal;
    Vec3 centroid;
    double spread = 0;  ///< off the plane, in squared local spacings
  };

  Plane planeAt(Index point) const;
  const Plane& plane(Index point) const { return planes_[neighbors_.slot(point)]; }
  bool isFlat(Index point) const;
  void addPlanes(const Context& context);
  Vec3 shifted(Index point) const;
  Vec3 averaged(Index point) const;

  SparseNeighbors& neighbors_;
  std::vector<Plane> planes_;  // of every slot of the neighbours
  std::vector<Vec3> normal_;
};

}  // namespace mlsmesh::core
