// SPDX-License-Identifier: BSD-3-Clause
#include "compare/peer_input.h"
#include "compare/reconstructors.h"

#include <pcl/search/kdtree.h>
#include <pcl/surface/poisson.h>

#include <omp.h>

namespace mlsmesh::apps {

pcl::PolygonMesh reconstructPoisson(const MethodInput& input, int depth, StageClock& clock) {
  const OrientedCloud::ConstPtr points = withOrientedNormals(input, clock);
  clock.begin("reconstruction");
  pcl::Poisson<pcl::PointNormal> poisson;
  poisson.setDepth(depth);
  poisson.setThreads(input.threads > 0 ? input.threads : omp_get_max_threads());
  poisson.setInputCloud(points);
  poisson.setSearchMethod(pcl::make_shared<pcl::search::KdTree<pcl::PointNormal>>());
  pcl::PolygonMesh mesh;
  poisson.reconstruct(mesh);
  clock.end();
  return mesh;
}

}  // namespace mlsmesh::apps
