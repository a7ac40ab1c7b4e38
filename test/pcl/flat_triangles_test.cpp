// SPDX-License-Identifier: BSD-3-Clause
#include "clouds.h"
#include "mlsmesh/mls_multiresolution.h"

#include <gtest/gtest.h>

#include <pcl/point_types.h>

namespace mlsmesh::testing {
namespace {

pcl::PointCloud<pcl::PointXYZRGB>::Ptr colouredSphere(int points) {
  const auto cloud = cloudOf<pcl::PointXYZRGB>(spherePoints(points));
  for (auto& point : *cloud) point.r = static_cast<std::uint8_t>(127 * (1 + point.x));
  return cloud;
}

TEST(FlatTriangles, AreThoseOfThePolygonMesh) {
  MlsMultiresolution<pcl::PointXYZRGB> flat, whole;
  flat.setInputCloud(colouredSphere(4000));
  whole.setInputCloud(colouredSphere(4000));
  pcl::PolygonMesh expected;
  whole.compute(expected);
  flat.compute();
  ASSERT_TRUE(flat.status().ok()) << flat.status().message;
  EXPECT_EQ(flat.reconstruction().mesh.level_triangles, whole.reconstruction().mesh.level_triangles);
  flat.setInputCloud(colouredSphere(100));  // does not change what was computed
  for (int level = flat.getLevelCount() - 1; level >= 0; --level) {
    pcl::PolygonMesh made;
    ASSERT_TRUE(flat.getLevel(level, made));
    ASSERT_TRUE(whole.getLevel(level, expected));
    EXPECT_TRUE(sameMesh(made, expected)) << "colours too, level " << level;
  }
}

TEST(FlatTriangles, AreGoneAfterAFailure) {
  MlsMultiresolution<pcl::PointXYZRGB> step;
  step.setInputCloud(colouredSphere(1000));
  step.compute();
  ASSERT_GT(step.getLevelCount(), 0);
  step.setInputCloud(colouredSphere(0));
  step.compute();
  EXPECT_EQ(step.status().code, StatusCode::EmptyInput);
  pcl::PolygonMesh level;
  EXPECT_FALSE(step.getLevel(0, level));
  EXPECT_TRUE(isEmpty(level));
}

}  // namespace
}  // namespace mlsmesh::testing
