// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "clouds.h"

namespace mlsmesh::bench {

/// What PCL offers for the same work, with the parameters a user would pick, on one thread. Each call builds
/// its own k-d trees; the cloud must be finite.

/// Mean distance to the nearest other point, from which a user of PCL picks a radius.
double meanSpacing(const Cloud::ConstPtr& cloud);

/// The radius within which a point has `count` points on average, itself included, to 0.1 %: over at most
/// 5,000 points spread evenly over the cloud's order.
double radiusHolding(double count, const Cloud::ConstPtr& cloud);

/// Normals from 20 neighbours, then pcl::GreedyProjectionTriangulation: radius of 5 spacings, mu 2.5, 100
/// neighbours, the tutorial's angles. Returns the number of triangles.
std::size_t normalsAndGreedyProjection(const Cloud::ConstPtr& cloud, double spacing);

/// The same normals, unoriented as PCL leaves them, then pcl::Poisson. Returns the number of triangles.
std::size_t normalsAndPoisson(const Cloud::ConstPtr& cloud, int depth);

/// pcl::MovingLeastSquares of degree 2 at every point. Returns the number of points projected.
std::size_t movingLeastSquares(const Cloud::ConstPtr& cloud, double radius);

}  // namespace mlsmesh::bench
