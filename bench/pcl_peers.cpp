// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_peers.h"

#include <pcl/PolygonMesh.h>
#include <pcl/features/normal_3d.h>
#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/search/kdtree.h>
#include <pcl/surface/gp3.h>
#include <pcl/surface/mls.h>
#include <pcl/surface/poisson.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace mlsmesh::bench {
namespace {

using CloudWithNormals = pcl::PointCloud<pcl::PointNormal>;

CloudWithNormals::Ptr withNormals(const Cloud::ConstPtr& cloud) {
  pcl::NormalEstimation<pcl::PointXYZ, pcl::PointNormal> estimation;
  estimation.setInputCloud(cloud);
  estimation.setSearchMethod(pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>>());
  estimation.setKSearch(20);
  CloudWithNormals::Ptr points(new CloudWithNormals);
  estimation.compute(*points);
  for (std::size_t i = 0; i < points->size(); ++i) {
    (*points)[i].getVector3fMap() = (*cloud)[i].getVector3fMap();
  }
  return points;
}

double meanCount(const pcl::KdTreeFLANN<pcl::PointXYZ>& tree, const Cloud& cloud, double radius) {
  constexpr std::size_t kSamples = 5000;
  const std::size_t step = std::max<std::size_t>(1, cloud.size() / kSamples);
  pcl::Indices indices;
  std::vector<float> squared;
  double found = 0;
  std::size_t asked = 0;
  for (std::size_t i = 0; i < cloud.size(); i += step, ++asked) {
    found += tree.radiusSearch(cloud[i], radius, indices, squared);
  }
  return found / static_cast<double>(asked);
}

}  // namespace

double meanSpacing(const Cloud::ConstPtr& cloud) {
  pcl::KdTreeFLANN<pcl::PointXYZ> tree;
  tree.setInputCloud(cloud);
  pcl::Indices indices(2);
  std::vector<float> squared(2);
  double sum = 0;
  for (const auto& point : *cloud) {
    tree.nearestKSearch(point, 2, indices, squared);
    sum += std::sqrt(squared[1]);
  }
  return sum / static_cast<double>(cloud->size());
}

double radiusHolding(double count, const Cloud::ConstPtr& cloud) {
  pcl::KdTreeFLANN<pcl::PointXYZ> tree;
  tree.setInputCloud(cloud);
  double low = 0;
  double high = meanSpacing(cloud);
  while (meanCount(tree, *cloud, high) < count && static_cast<double>(cloud->size()) > count) high *= 2;
  while (high - low > 1e-3 * high) {
    const double middle = (low + high) / 2;
    (meanCount(tree, *cloud, middle) < count ? low : high) = middle;
  }
  return high;
}

std::size_t normalsAndGreedyProjection(const Cloud::ConstPtr& cloud, double spacing) {
  pcl::GreedyProjectionTriangulation<pcl::PointNormal> greedy;
  greedy.setSearchRadius(5 * spacing);
  greedy.setMu(2.5);
  greedy.setMaximumNearestNeighbors(100);
  greedy.setMaximumSurfaceAngle(M_PI / 4);
  greedy.setMinimumAngle(M_PI / 18);
  greedy.setMaximumAngle(2 * M_PI / 3);
  greedy.setInputCloud(withNormals(cloud));
  greedy.setSearchMethod(pcl::make_shared<pcl::search::KdTree<pcl::PointNormal>>());
  pcl::PolygonMesh mesh;
  greedy.reconstruct(mesh);
  return mesh.polygons.size();
}

std::size_t normalsAndPoisson(const Cloud::ConstPtr& cloud, int depth) {
  pcl::Poisson<pcl::PointNormal> poisson;
  poisson.setDepth(depth);
  poisson.setThreads(1);
  poisson.setInputCloud(withNormals(cloud));
  poisson.setSearchMethod(pcl::make_shared<pcl::search::KdTree<pcl::PointNormal>>());
  pcl::PolygonMesh mesh;
  poisson.reconstruct(mesh);
  return mesh.polygons.size();
}

std::size_t movingLeastSquares(const Cloud::ConstPtr& cloud, double radius) {
  pcl::MovingLeastSquares<pcl::PointXYZ, pcl::PointXYZ> mls;
  mls.setInputCloud(cloud);
  mls.setSearchMethod(pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>>());
  mls.setPolynomialOrder(2);
  mls.setSearchRadius(radius);
  mls.setNumberOfThreads(1);
  Cloud projected;
  mls.process(projected);
  return projected.size();
}

}  // namespace mlsmesh::bench
