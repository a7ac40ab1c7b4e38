// SPDX-License-Identifier: BSD-3-Clause
#include "clouds.h"
#include "mlsmesh/advancing_front_triangulation.h"
#include "mlsmesh/bsp_clustering.h"
#include "mlsmesh/mls_reduction.h"
#include "mlsmesh/mls_surface.h"

#include <gtest/gtest.h>

#include <pcl/point_types.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>
#include <set>
#include <vector>

namespace mlsmesh::testing {
namespace {

using Point = pcl::PointXYZ;

const float kNan = std::numeric_limits<float>::quiet_NaN();

// A permutation of 0 .. count - 1 that is the same on every platform.
std::vector<int> shuffled(int count) {
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  std::mt19937 engine(3);
  for (int i = count - 1; i > 0; --i) std::swap(order[i], order[engine() % static_cast<unsigned>(i + 1)]);
  return order;
}

std::vector<pcl::PointIndices> clustersOf(const pcl::PointCloud<Point>::ConstPtr& cloud, int max_size = 11) {
  BspClustering<Point> step;
  step.setInputCloud(cloud);
  step.parameters().max_size = max_size;
  std::vector<pcl::PointIndices> clusters;
  step.compute(clusters);
  EXPECT_TRUE(step.status().ok()) << step.status().message;
  return clusters;
}

TEST(BspClustering, EveryFinitePointIsInExactlyOneCluster) {
  const auto cloud = cloudOf<Point>(spherePoints(1000));
  cloud->push_back((*cloud)[17]);
  cloud->push_back(Point(kNan, 0, 0));
  cloud->push_back((*cloud)[17]);
  cloud->is_dense = false;
  std::vector<int> cluster_of(cloud->size(), -1);
  const auto clusters = clustersOf(cloud);
  for (std::size_t c = 0; c < clusters.size(); ++c) {
    EXPECT_TRUE(std::is_sorted(clusters[c].indices.begin(), clusters[c].indices.end()));
    EXPECT_EQ(clusters[c].header.frame_id, "scanner");
    for (const auto index : clusters[c].indices) {
      EXPECT_EQ(cluster_of[index], -1) << index;
      cluster_of[index] = static_cast<int>(c);
    }
  }
  for (int i = 0; i < 1001; ++i) EXPECT_GE(cluster_of[i], 0) << i;
  EXPECT_EQ(cluster_of[1000], cluster_of[17]);
  EXPECT_EQ(cluster_of[1001], -1) << "a point that is not finite is in no cluster";
  EXPECT_EQ(cluster_of[1002], cluster_of[17]);
}

TEST(BspClustering, TheLargestClusterIsLimited) {
  const auto cloud = cloudOf<Point>(spherePoints(1000));
  for (const int limit : {1, 5, 11, 40}) {
    for (const auto& cluster : clustersOf(cloud, limit)) {
      EXPECT_LE(cluster.indices.size(), static_cast<std::size_t>(std::max(limit, 5)))
          << "2 * min_leaf - 1 = 5 at least";
    }
  }
}

TEST(BspClustering, TheOrderOfTheInputDoesNotMatter) {
  const auto positions = spherePoints(800);
  const auto order = shuffled(800);
  std::vector<core::Vec3> moved;
  for (const int i : order) moved.push_back(positions[i]);
  const auto expected = clustersOf(cloudOf<Point>(positions));
  const auto actual = clustersOf(cloudOf<Point>(moved));
  ASSERT_EQ(expected.size(), actual.size());
  for (std::size_t c = 0; c < expected.size(); ++c) {
    std::set<int> members;
    for (const auto index : actual[c].indices) members.insert(order[index]);
    EXPECT_EQ(members, std::set<int>(expected[c].indices.begin(), expected[c].indices.end()));
  }
}

TEST(BspClustering, IndicesChooseThePoints) {
  BspClustering<Point> step;
  step.setInputCloud(cloudOf<Point>(spherePoints(500)));
  const pcl::IndicesPtr indices(new pcl::Indices);
  for (int i = 100; i < 400; ++i) indices->push_back(i);
  step.setIndices(indices);
  std::vector<pcl::PointIndices> clusters;
  step.extract(clusters);
  std::set<int> found;
  for (const auto& cluster : clusters) found.insert(cluster.indices.begin(), cluster.indices.end());
  EXPECT_EQ(found, std::set<int>(indices->begin(), indices->end()));
}

TEST(BspClustering, ParametersOutOfRangeAreNamed) {
  BspClustering<Point> step;
  step.setInputCloud(cloudOf<Point>(spherePoints(100)));
  step.parameters().max_size = 0;
  std::vector<pcl::PointIndices> clusters(2);
  step.extract(clusters);
  EXPECT_EQ(step.status().code, StatusCode::InvalidParameter);
  EXPECT_NE(step.status().message.find("max_size"), std::string::npos) << step.status().message;
  EXPECT_TRUE(clusters.empty());
  step.parameters().max_size = 11;
  step.setNumberOfThreads(-1);
  step.extract(clusters);
  EXPECT_EQ(step.status().code, StatusCode::InvalidParameter);
}

TEST(MlsReduction, RepresentativesLieOnTheSphere) {
  const auto cloud = cloudOf<Point>(spherePoints(4000, {5, 6, 7}));
  MlsReduction<Point, pcl::PointNormal> step;
  step.setInputCloud(cloud);
  step.setClusters(clustersOf(cloud));
  pcl::PointCloud<pcl::PointNormal> output;
  step.process(output);
  ASSERT_TRUE(step.status().ok()) << step.status().message;
  EXPECT_EQ(output.header.frame_id, "scanner");
  EXPECT_EQ(output.width, output.size());
  EXPECT_EQ(output.height, 1u);
  EXPECT_LT(output.size(), 1000u);
  for (const auto& point : output) {
    const core::Vec3 radius = positionOf(point) - core::Vec3(5, 6, 7);
    EXPECT_NEAR(radius.norm(), 1, 1e-3);
    const core::Vec3 normal(point.normal_x, point.normal_y, point.normal_z);
    EXPECT_NEAR(std::abs(normal.dot(radius)), 1, 1e-2);
    EXPECT_GE(point.curvature, 0);
    EXPECT_LT(point.curvature, 0.05);
  }
  const auto& sizes = step.clusterSizes();
  ASSERT_EQ(sizes.size(), output.size());
  EXPECT_EQ(std::accumulate(sizes.begin(), sizes.end(), 0), 4000);
}

TEST(MlsReduction, WithoutClustersEveryPointIsProjectedInPlace) {
  const auto cloud = cloudOf<Point>(spherePoints(1000));
  cloud->insert(cloud->begin() + 5, Point(kNan, kNan, kNan));
  cloud->push_back((*cloud)[0]);
  cloud->is_dense = false;
  MlsReduction<Point, pcl::PointNormal> step;
  step.setInputCloud(cloud);
  pcl::PointCloud<pcl::PointNormal> output;
  step.compute(output);
  ASSERT_EQ(output.size(), 1000u) << step.status().message;
  for (int i = 0; i < 1000; ++i) {
    const Point& input = (*cloud)[i < 5 ? i : i + 1];
    EXPECT_LT((positionOf(output[i]) - positionOf(input)).norm(), 1e-3) << i;
  }
  EXPECT_EQ(step.clusterSizes(), std::vector<core::Index>(1000, 1));
}

TEST(MlsReduction, ColourIsAveragedAndLabelsComeFromTheNearestPoint) {
  const auto positions = spherePoints(600);
  const auto plain = cloudOf<Point>(positions);
  const auto cloud = cloudOf<pcl::PointXYZRGBL>(positions);
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    (*cloud)[i].r = static_cast<std::uint8_t>(i % 256);
    (*cloud)[i].g = static_cast<std::uint8_t>((7 * i) % 256);
    (*cloud)[i].b = 200;
    (*cloud)[i].label = static_cast<std::uint32_t>(1000 + i);
  }
  const auto clusters = clustersOf(plain);
  MlsReduction<pcl::PointXYZRGBL, pcl::PointXYZRGBL> step;
  step.setInputCloud(cloud);
  step.setClusters(clusters);
  pcl::PointCloud<pcl::PointXYZRGBL> output;
  step.process(output);
  ASSERT_EQ(output.size(), clusters.size()) << step.status().message;
  for (std::size_t c = 0; c < clusters.size(); ++c) {
    int red = 0, green = 0;
    for (const auto index : clusters[c].indices) {
      red += (*cloud)[index].r;
      green += (*cloud)[index].g;
    }
    const int count = static_cast<int>(clusters[c].indices.size());
    EXPECT_EQ(output[c].r, (2 * red + count) / (2 * count));
    EXPECT_EQ(output[c].g, (2 * green + count) / (2 * count));
    EXPECT_EQ(output[c].b, 200);
    int nearest = 0;
    const auto distance = [&](int i) { return (positionOf((*cloud)[i]) - positionOf(output[c])).norm(); };
    for (int i = 1; i < 600; ++i) nearest = distance(i) < distance(nearest) ? i : nearest;
    EXPECT_EQ(output[c].label, 1000u + static_cast<unsigned>(nearest));
  }
}

TEST(MlsReduction, ClustersOfAnotherCloudAreRefused) {
  MlsReduction<Point, pcl::PointNormal> step;
  step.setInputCloud(cloudOf<Point>(spherePoints(100)));
  std::vector<pcl::PointIndices> clusters(2);
  clusters[0].indices = {0, 1, 2};
  clusters[1].indices = {3, 100};
  step.setClusters(clusters);
  pcl::PointCloud<pcl::PointNormal> output;
  output.resize(3);
  step.process(output);
  EXPECT_EQ(step.status().code, StatusCode::InvalidIndices);
  EXPECT_NE(step.status().message.find("100"), std::string::npos) << step.status().message;
  EXPECT_TRUE(isEmpty(output));
  clusters[1].indices = {3, -1};
  step.setClusters(clusters);
  step.process(output);
  EXPECT_EQ(step.status().code, StatusCode::InvalidIndices);
}

TEST(MlsReduction, UnusableMembersDoNotCount) {
  const auto cloud = cloudOf<Point>(spherePoints(100));
  cloud->push_back(Point(kNan, 0, 0));
  cloud->is_dense = false;
  std::vector<pcl::PointIndices> clusters(3);
  clusters[0].indices = {100};
  clusters[1].indices = {4, 100, 4, 9};
  MlsReduction<Point, pcl::PointNormal> step;
  step.setInputCloud(cloud);
  step.setClusters(clusters);
  pcl::PointCloud<pcl::PointNormal> output;
  step.process(output);
  ASSERT_EQ(output.size(), 1u) << step.status().message;
  EXPECT_EQ(step.clusterSizes(), std::vector<core::Index>{2});
  clusters.resize(1);
  step.setClusters(clusters);
  step.process(output);
  EXPECT_EQ(step.status().code, StatusCode::EmptyInput);
  EXPECT_TRUE(isEmpty(output));
}

TEST(AdvancingFrontTriangulation, ASphereIsClosedAndFacesOutward) {
  const auto cloud = cloudOf<Point>(spherePoints(1500));
  AdvancingFrontTriangulation<Point> step;
  step.setInputCloud(cloud);
  pcl::PolygonMesh output = usedMesh();
  step.reconstruct(output);
  ASSERT_TRUE(step.status().ok()) << step.status().message;
  EXPECT_EQ(output.header.frame_id, "scanner");
  EXPECT_EQ(output.polygons.size(), 2996u);
  const MeshReport report = reportOf(output);
  EXPECT_TRUE(report.isSound());
  EXPECT_EQ(report.border_edges, 0);
  EXPECT_EQ(report.isolated_vertices, 0);
  EXPECT_NEAR(volume(output), 4 * kPi / 3, 0.02);
  pcl::PointCloud<Point> vertices;
  pcl::fromPCLPointCloud2(output.cloud, vertices);
  for (std::size_t i = 0; i < cloud->size(); ++i) EXPECT_EQ(positionOf(vertices[i]), positionOf((*cloud)[i]));
}

TEST(AdvancingFrontTriangulation, AnOpenCylinderKeepsItsTwoBorders) {
  AdvancingFrontTriangulation<Point> step;
  step.setInputCloud(cloudOf<Point>(cylinderPoints(40, 20)));
  pcl::PolygonMesh output;
  step.compute(output);
  const MeshReport report = reportOf(output);
  EXPECT_TRUE(report.isSound());
  EXPECT_EQ(report.border_loops, 2);
  EXPECT_EQ(report.components, 1);
  EXPECT_EQ(report.genus, 0);
}

TEST(AdvancingFrontTriangulation, UnusablePointsStayUnused) {
  auto cloud = cloudOf<Point>(spherePoints(300));
  cloud->push_back((*cloud)[3]);
  cloud->insert(cloud->begin(), Point(kNan, 0, 0));
  cloud->is_dense = false;
  AdvancingFrontTriangulation<Point> step;
  step.setInputCloud(cloud);
  std::vector<pcl::Vertices> polygons;
  step.reconstruct(polygons);
  ASSERT_EQ(polygons.size(), 596u) << step.status().message;
  for (const auto& triangle : trianglesOf(polygons)) {
    for (const auto corner : triangle) {
      EXPECT_NE(corner, 0) << "not finite";
      EXPECT_NE(corner, 301) << "a duplicate of an earlier point";
    }
  }
}

TEST(AdvancingFrontTriangulation, AnOrganisedCloudStaysOrganised) {
  const auto cloud = cloudOf<Point>(latticePoints(20));
  cloud->width = cloud->height = 20;
  (*cloud)[57] = Point(kNan, kNan, kNan);
  cloud->is_dense = false;
  AdvancingFrontTriangulation<Point> step;
  step.setInputCloud(cloud);
  pcl::PolygonMesh output;
  step.reconstruct(output);
  ASSERT_TRUE(step.status().ok()) << step.status().message;
  EXPECT_EQ(output.cloud.width, 20u);
  EXPECT_EQ(output.cloud.height, 20u);
  EXPECT_TRUE(reportOf(output).isSound());
}

TEST(AdvancingFrontTriangulation, FieldsOfTheInputAreKept) {
  const auto cloud = cloudOf<pcl::PointXYZRGBNormal>(spherePoints(200));
  for (std::size_t i = 0; i < cloud->size(); ++i) (*cloud)[i].rgba = static_cast<std::uint32_t>(i * 77);
  AdvancingFrontTriangulation<pcl::PointXYZRGBNormal> step;
  step.setInputCloud(cloud);
  pcl::PolygonMesh output;
  step.reconstruct(output);
  pcl::PointCloud<pcl::PointXYZRGBNormal> vertices;
  pcl::fromPCLPointCloud2(output.cloud, vertices);
  ASSERT_EQ(vertices.size(), 200u);
  for (std::size_t i = 0; i < cloud->size(); ++i) EXPECT_EQ(vertices[i].rgba, (*cloud)[i].rgba);
}

TEST(MlsSurface, ProjectsOnTheSphereInTheCloudsCoordinates) {
  const core::Vec3 centre(500, -300, 200);
  const auto positions = spherePoints(4000, centre);
  MlsSurface<Point> surface;
  surface.setInputCloud(cloudOf<Point>(positions));
  ASSERT_TRUE(surface.compute()) << surface.status().message;
  EXPECT_NEAR(surface.spacing(), 0.045, 0.02);
  for (int i = 0; i < 50; ++i) {
    const core::Vec3 direction = (positions[i * 79] - centre).normalized();
    const core::Projection projection = surface.project(centre + 1.01 * direction);
    EXPECT_NEAR((projection.position - centre).norm(), 1, 1e-3);
    EXPECT_NEAR(std::abs(projection.normal.dot(direction)), 1, 1e-3);
    EXPECT_LT((positions[projection.nearest] - projection.position).norm(), 0.06);
    EXPECT_NEAR(surface.residual(centre + 1.01 * direction), 0.01, 1e-3);
    EXPECT_LT(surface.residual(projection.position), 1e-3);
  }
}

TEST(MlsSurface, GivesNoAnswerUntilItIsReady) {
  MlsSurface<Point> surface;
  EXPECT_FALSE(surface.ready());
  EXPECT_TRUE(std::isnan(surface.residual({0, 0, 0})));
  EXPECT_FALSE(surface.compute());
  surface.setInputCloud(cloudOf<Point>(spherePoints(100)));
  EXPECT_TRUE(surface.compute());
  EXPECT_TRUE(surface.ready());
  const core::Projection nowhere = surface.project({0, static_cast<double>(kNan), 0});
  EXPECT_TRUE(nowhere.position.hasNaN());
  EXPECT_EQ(nowhere.nearest, core::kNone);
  surface.setInputCloud(cloudOf<Point>({{0, 0, 0}}));
  EXPECT_FALSE(surface.compute());
  EXPECT_TRUE(std::isnan(surface.residual({0, 0, 0}))) << "a failed run leaves no old answers behind";
}

}  // namespace
}  // namespace mlsmesh::testing
