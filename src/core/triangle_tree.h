// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/types.h"

#include <unsupported/Eigen/BVH>

namespace mlsmesh::core {

/// Squared distance of a point from a triangle, which may be degenerate; all finite.
double squaredDistance(const Vec3& point, const Vec3& a, const Vec3& b, const Vec3& c);

/// Finds the triangle nearest to a point: about 200 bytes a triangle. Refers to vertices and triangles, which
/// must outlive it.
class TriangleTree {
 public:
  struct Nearest {
    Index triangle = kNone;
    double squared_distance = 0;
  };

  /// Corners must be vertices, and finite; triangles may be degenerate. O(n log n).
  TriangleTree(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles);

  bool empty() const { return triangles_.empty(); }
  /// Of several at the same distance, any one, always the same for the same hint: a triangle that may be
  /// near, which makes the search faster. `point` must be finite, the tree not empty. May be called from
  /// several threads at once.
  Nearest nearest(const Vec3& point, Index hint = kNone) const;

 private:
  struct Item {
    Vec3 a, b, c;
    Index triangle;
  };
  struct Search;

  const std::vector<Vec3>& vertices_;
  const std::vector<Triangle>& triangles_;
  Eigen::KdBVH<double, 3, Item> boxes_;
};

}  // namespace mlsmesh::core
