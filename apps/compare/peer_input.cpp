// SPDX-License-Identifier: BSD-3-Clause
#include "compare/peer_input.h"

#include "compare/normal_orientation.h"

#include <pcl/common/point_tests.h>
#include <pcl/features/normal_3d_omp.h>
#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/search/kdtree.h>

#include <cmath>

namespace mlsmesh::apps {
namespace {

constexpr int kNormalNeighbors = 20;
constexpr int kOrientationNeighbors = 10;

void keepFiniteNormals(OrientedCloud& points) {
  OrientedCloud kept;
  for (const pcl::PointNormal& point : points)
    if (pcl::isNormalFinite(point)) kept.push_back(point);
  points.swap(kept);
}

}  // namespace

double meanSpacing(const MethodInput& input, StageClock& clock) {
  clock.begin("spacing");
  pcl::KdTreeFLANN<pcl::PointXYZ> tree;
  tree.setInputCloud(input.finite);
  pcl::Indices indices(2);
  std::vector<float> squared(2);
  double sum = 0;
  std::size_t count = 0;
  for (const pcl::PointXYZ& point : *input.finite) {
    if (tree.nearestKSearch(point, 2, indices, squared) < 2 || squared[1] == 0) continue;
    sum += std::sqrt(squared[1]);
    ++count;
  }
  clock.end();
  if (count == 0) throw Refusal("the cloud has no two points at different places, so no spacing");
  return sum / static_cast<double>(count);
}

OrientedCloud::Ptr withNormals(const MethodInput& input, StageClock& clock) {
  clock.begin("normals");
  pcl::NormalEstimationOMP<pcl::PointXYZ, pcl::PointNormal> estimation;
  estimation.setNumberOfThreads(static_cast<unsigned int>(input.threads));
  estimation.setInputCloud(input.finite);
  estimation.setSearchMethod(pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>>());
  estimation.setKSearch(kNormalNeighbors);
  OrientedCloud::Ptr points(new OrientedCloud);
  estimation.compute(*points);
  for (std::size_t i = 0; i < points->size(); ++i)
    (*points)[i].getVector3fMap() = (*input.finite)[i].getVector3fMap();
  keepFiniteNormals(*points);
  clock.end();
  return points;
}

OrientedCloud::Ptr withOrientedNormals(const MethodInput& input, StageClock& clock) {
  OrientedCloud::Ptr points = withNormals(input, clock);
  clock.begin("orientation");
  orientNormals(kOrientationNeighbors, *points);
  clock.end();
  return points;
}

}  // namespace mlsmesh::apps
