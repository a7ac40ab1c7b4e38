// SPDX-License-Identifier: BSD-3-Clause
#include "compare/peer_input.h"
#include "compare/reconstructors.h"

#include <pcl/common/point_tests.h>
#include <pcl/search/kdtree.h>
#include <pcl/surface/gp3.h>
#include <pcl/surface/mls.h>

#include <cmath>

namespace mlsmesh::apps {
namespace {

constexpr double kRadius = 5;  // spacings, of both methods

/// With the angles of PCL's tutorial.
pcl::PolygonMesh project(const OrientedCloud::ConstPtr& points, double spacing, bool oriented,
                         StageClock& clock) {
  clock.begin("reconstruction");
  pcl::GreedyProjectionTriangulation<pcl::PointNormal> greedy;
  greedy.setSearchRadius(kRadius * spacing);
  greedy.setMu(2.5);
  greedy.setMaximumNearestNeighbors(100);
  greedy.setMaximumSurfaceAngle(M_PI / 4);
  greedy.setMinimumAngle(M_PI / 18);
  greedy.setMaximumAngle(2 * M_PI / 3);
  greedy.setNormalConsistency(oriented);
  greedy.setConsistentVertexOrdering(oriented);
  greedy.setInputCloud(points);
  greedy.setSearchMethod(pcl::make_shared<pcl::search::KdTree<pcl::PointNormal>>());
  pcl::PolygonMesh mesh;
  greedy.reconstruct(mesh);
  clock.end();
  return mesh;
}

OrientedCloud::Ptr smoothed(const MethodInput& input, double spacing, StageClock& clock) {
  clock.begin("smoothing");
  pcl::MovingLeastSquares<pcl::PointXYZ, pcl::PointNormal> mls;
  mls.setInputCloud(input.finite);
  mls.setSearchMethod(pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>>());
  mls.setPolynomialOrder(2);
  mls.setSearchRadius(kRadius * spacing);
  mls.setComputeNormals(true);
  mls.setNumberOfThreads(static_cast<unsigned int>(input.threads));
  OrientedCloud all;
  mls.process(all);
  OrientedCloud::Ptr points(new OrientedCloud);
  for (const pcl::PointNormal& point : all)
    if (pcl::isFinite(point) && pcl::isNormalFinite(point)) points->push_back(point);
  clock.end();
  return points;
}

}  // namespace

pcl::PolygonMesh projectGreedily(const MethodInput& input, StageClock& clock) {
  const double spacing = meanSpacing(input, clock);
  return project(withNormals(input, clock), spacing, false, clock);
}

pcl::PolygonMesh projectGreedilyOriented(const MethodInput& input, StageClock& clock) {
  const double spacing = meanSpacing(input, clock);
  return project(withOrientedNormals(input, clock), spacing, true, clock);
}

pcl::PolygonMesh projectGreedilySmoothed(const MethodInput& input, StageClock& clock) {
  const double spacing = meanSpacing(input, clock);
  return project(smoothed(input, spacing, clock), spacing, false, clock);
}

}  // namespace mlsmesh::apps
