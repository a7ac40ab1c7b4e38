// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "neighborhood.h"

namespace mlsmesh::core {

/// Principal axes of weighted points.
struct Frame {
  Vec3 centroid;
  Eigen::Matrix3d axes;  ///< columns: normal, then two tangents
  double variation = 0;  ///< lambda_1 / (lambda_1 + lambda_2 + lambda_3)
  Vec3 normal() const { return axes.col(0); }
};

struct Height {
  Eigen::Matrix<double, 10, 1> g = Eigen::Matrix<double, 10, 1>::Zero();
  bool valid = false;
};

/// A polynomial height over a frame at `foot`; lengths in units of the support.
struct Fit {
  Frame frame;
  Vec3 foot;
  Height height;
  int degree = 0;
};

/// Of the neighbours as they are weighted; `origin` is any place near them.
Frame principalFrame(const std::vector<Vec3>& points, const Vec3& origin, const Neighborhood& around);

/// Fits the height over fit.frame at fit.foot, with a lower degree where it is not finite. A small ridge on
/// all but the constant keeps ill-posed fits finite without biasing good ones.
void fitWithFallback(const std::vector<Vec3>& points, int degree, double support, const Neighborhood& around,
                     Fit& fit);

/// The same over the principal frame, at x.
void fitInOneStep(const std::vector<Vec3>& points, const Vec3& x, int degree, double support,
                  const Neighborhood& around, Fit& fit);

/// Distance of neighbour i from the fitted polynomial along the normal of the frame, signed.
double miss(const std::vector<Vec3>& points, const Fit& fit, double support, const Neighborhood& around,
            int i);

/// Of the misses: weighted root mean square; median of their sizes.
double rmsResidual(const std::vector<Vec3>& points, const Fit& fit, double support,
                   const Neighborhood& around);
double medianResidual(const std::vector<Vec3>& points, const Fit& fit, double support,
                      const Neighborhood& around);

}  // namespace mlsmesh::core
