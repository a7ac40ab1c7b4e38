// SPDX-License-Identifier: BSD-3-Clause
#include "flann_yardstick.h"

#include <flann/algorithms/dist.h>
#include <flann/algorithms/kdtree_single_index.h>

namespace mlsmesh::bench {

double flannTreeAndNearest(const std::vector<core::Vec3>& points, int k) {
  double* const coordinates = const_cast<double*>(points.front().data());
  flann::KDTreeSingleIndex<flann::L2_Simple<double>> tree(flann::KDTreeSingleIndexParams(15, true));
  tree.buildIndex(flann::Matrix<double>(coordinates, points.size(), 3));
  const flann::SearchParams parameters;
  flann::KNNSimpleResultSet<double> nearest(k);
  double sum = 0;
  for (const core::Vec3& point : points) {
    nearest.clear();
    tree.findNeighbors(nearest, point.data(), parameters);
    sum += nearest.worstDist();
  }
  return sum;
}

}  // namespace mlsmesh::bench
