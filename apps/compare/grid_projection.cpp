// SPDX-License-Identifier: BSD-3-Clause
#include "compare/corner_merging.h"
#include "compare/peer_input.h"
#include "compare/reconstructors.h"

#include <pcl/search/kdtree.h>
#include <pcl/surface/grid_projection.h>

namespace mlsmesh::apps {

pcl::PolygonMesh projectGrid(const MethodInput& input, StageClock& clock) {
  const double spacing = meanSpacing(input, clock);
  const OrientedCloud::ConstPtr points = withOrientedNormals(input, clock);
  clock.begin("reconstruction");
  pcl::GridProjection<pcl::PointNormal> grid;
  grid.setResolution(2 * spacing);
  grid.setPaddingSize(3);
  grid.setNearestNeighborNum(100);
  grid.setMaxBinarySearchLevel(10);
  grid.setInputCloud(points);
  grid.setSearchMethod(pcl::make_shared<pcl::search::KdTree<pcl::PointNormal>>());
  pcl::PolygonMesh mesh;
  grid.reconstruct(mesh);
  clock.begin("merging");
  mergeCorners(spacing, mesh);
  clock.end();
  return mesh;
}

}  // namespace mlsmesh::apps
