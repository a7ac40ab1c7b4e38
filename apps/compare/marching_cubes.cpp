// SPDX-License-Identifier: BSD-3-Clause
#include "compare/corner_merging.h"
#include "compare/peer_input.h"
#include "compare/reconstructors.h"

#include <pcl/common/common.h>
#include <pcl/search/kdtree.h>
#include <pcl/surface/marching_cubes_hoppe.h>
#include <pcl/surface/marching_cubes_rbf.h>

#include <algorithm>
#include <string>

namespace mlsmesh::apps {
namespace {

constexpr double kCell = 1.5;         // spacings
constexpr double kMargin = 0.1;       // of the cloud's extent, on either side
constexpr double kFewestCells = 20;   // along an axis
constexpr double kMostCells = 200;    // the grid is dense
constexpr double kMostRbfCells = 60;  // every cell sums over all points

/// Cells of kCell along each axis, as many as are allowed.
Eigen::Vector3i gridSize(const OrientedCloud& points, double spacing, double most) {
  pcl::PointNormal low, high;
  pcl::getMinMax3D(points, low, high);
  const Eigen::Vector3d extent = (high.getVector3fMap() - low.getVector3fMap()).cast<double>();
  const Eigen::Array3d cells = (1 + 2 * kMargin) * extent.array() / (kCell * spacing);
  return cells.max(kFewestCells).min(most).matrix().cast<int>();
}

pcl::PolygonMesh march(pcl::MarchingCubes<pcl::PointNormal>& cubes, const OrientedCloud::ConstPtr& points,
                       const Eigen::Vector3i& size, double spacing, StageClock& clock) {
  clock.begin("reconstruction");
  cubes.setGridResolution(size[0], size[1], size[2]);
  cubes.setIsoLevel(0);
  cubes.setPercentageExtendGrid(static_cast<float>(kMargin));
  cubes.setInputCloud(points);
  cubes.setSearchMethod(pcl::make_shared<pcl::search::KdTree<pcl::PointNormal>>());
  pcl::PolygonMesh mesh;
  cubes.reconstruct(mesh);
  clock.begin("merging");
  mergeCorners(spacing, mesh);
  clock.end();
  return mesh;
}

}  // namespace

pcl::PolygonMesh marchHoppe(const MethodInput& input, StageClock& clock) {
  const double spacing = meanSpacing(input, clock);
  const OrientedCloud::ConstPtr points = withOrientedNormals(input, clock);
  pcl::MarchingCubesHoppe<pcl::PointNormal> cubes;
  return march(cubes, points, gridSize(*points, spacing, kMostCells), spacing, clock);
}

pcl::PolygonMesh marchRbf(const MethodInput& input, StageClock& clock) {
  if (input.finite->size() > kMostRbfPoints) {
    throw Refusal("more than " + std::to_string(kMostRbfPoints) +
                  " points: its dense equations take memory by the square of their number, and time by the "
                  "cube");
  }
  const double spacing = meanSpacing(input, clock);
  const OrientedCloud::ConstPtr points = withOrientedNormals(input, clock);
  pcl::MarchingCubesRBF<pcl::PointNormal> cubes;
  cubes.setOffSurfaceDisplacement(static_cast<float>(spacing));
  return march(cubes, points, gridSize(*points, spacing, kMostRbfCells), spacing, clock);
}

}  // namespace mlsmesh::apps
