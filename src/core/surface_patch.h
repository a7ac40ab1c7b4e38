// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "mlsmesh/core/types.h"

namespace mlsmesh::core {

/// Through `point`, with unit `normal`.
struct TangentPlane {
  Vec3 point;
  Vec3 normal;
};

/// One smooth side of a surface, fitted to a few of its points: their weighted plane, and a graph of degree 2
/// over it where the points carry one.
class SurfacePatch {
 public:
  /// Fits `count` >= 3 points, weighted exp(-d^2 / support^2) by their distance d to `center`. O(count).
  SurfacePatch(const std::vector<Vec3>& points, const Index* members, int count, const Vec3& center,
               double support);

  /// Tangent plane of the graph under x; of the plane where the graph has climbed half the support, or
  /// leans more than 37 degrees.
  TangentPlane tangentAt(const Vec3& x) const;
  const Vec3& centroid() const { return centroid_; }
  Vec3 normal() const { return axes_.col(0); }
  /// Mean squared distance of the points from the plane, unweighted.
  double planeResidual() const { return plane_residual_; }

 private:
  Vec3 centroid_;
  Eigen::Matrix3d axes_;  // columns: normal, then two tangents
  Eigen::Matrix<double, 6, 1> graph_ = Eigen::Matrix<double, 6, 1>::Zero();  // in units of the support
  double support_ = 1;
  double plane_residual_ = 0;
};

/// Root mean square distance of the points (at most 64) from one graph of degree 2 over their plane, every
/// point of equal weight. O(count).
double quadricResidual(const std::vector<Vec3>& points, const Index* members, int count);

/// How near these points (at most 64) are to one smooth surface, and to two planes that meet.
struct Misfit {
  double smooth = 0;  ///< quadricResidual
  double folded = 0;  ///< root mean square distance from the nearer of two planes
};

/// Both residuals; the second only if the first is more than `enough`, else it is the first. The planes start
/// from either side of the line of least curvature and are settled by turns. O(count).
Misfit misfitOf(const std::vector<Vec3>& points, const Index* members, int count, double enough);

}  // namespace mlsmesh::core
