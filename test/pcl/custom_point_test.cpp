// SPDX-License-Identifier: BSD-3-Clause
// A point type of the user's own, with double coordinates: all that PCL asks for is its registration and this
// macro.
#define PCL_NO_PRECOMPILE
#include "clouds.h"
#include "mlsmesh/advancing_front_triangulation.h"
#include "mlsmesh/mls_multiresolution.h"
#include "mlsmesh/mls_reduction.h"

#include <gtest/gtest.h>

#include <pcl/register_point_struct.h>

#include <cstdint>
#include <vector>

// A point of a survey: coordinates of a national grid, a return number, a class.
struct SurveyPoint {
  double x = 0, y = 0, z = 0;
  float intensity = 0;
  std::uint16_t returns = 0;
  std::uint32_t cluster_size = 0;
};

POINT_CLOUD_REGISTER_POINT_STRUCT(SurveyPoint,
                                  (double, x, x)(double, y, y)(double, z, z)(float, intensity, intensity)(
                                      std::uint16_t, returns, returns)(std::uint32_t, cluster_size,
                                                                       cluster_size))

namespace mlsmesh::testing {
namespace {

const core::Vec3 kPlace(691875.125, 5334567.25, 500.5);

pcl::PointCloud<SurveyPoint>::Ptr survey() {
  const auto cloud = cloudOf<SurveyPoint>(spherePoints(1200, kPlace));
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    (*cloud)[i].intensity = 2;
    (*cloud)[i].returns = static_cast<std::uint16_t>(i);
  }
  return cloud;
}

TEST(CustomPoint, DoubleCoordinatesPassThroughAllSteps) {
  MlsMultiresolution<SurveyPoint> step;
  step.setInputCloud(survey());
  pcl::PointCloud<SurveyPoint> points;
  std::vector<pcl::Vertices> polygons;
  step.reconstruct(points, polygons);
  ASSERT_TRUE(step.status().ok()) << step.status().message;
  EXPECT_EQ(polygons.size(), 2 * points.size() - 4);
  for (const SurveyPoint& point : points) {
    EXPECT_NEAR((positionOf(point) - kPlace).norm(), 1, 5e-3) << "a float resolves half a metre here";
    EXPECT_EQ(point.intensity, 2);
  }
}

TEST(CustomPoint, FieldsAreFilledByName) {
  const auto cloud = survey();
  MlsReduction<SurveyPoint, SurveyPoint> step;
  step.setInputCloud(cloud);
  pcl::PointCloud<SurveyPoint> output;
  step.process(output);
  ASSERT_EQ(output.size(), 1200u) << step.status().message;
  for (const SurveyPoint& point : output) {
    EXPECT_EQ(point.cluster_size, 1u);
    EXPECT_LT((positionOf(point) - positionOf((*cloud)[point.returns])).norm(), 0.01);
  }
}

TEST(CustomPoint, VerticesAreTheInputPointsToTheLastBit) {
  const auto cloud = survey();
  AdvancingFrontTriangulation<SurveyPoint> step;
  step.setInputCloud(cloud);
  pcl::PolygonMesh output;
  step.reconstruct(output);
  ASSERT_TRUE(step.status().ok()) << step.status().message;
  EXPECT_EQ(output.polygons.size(), 2396u);
  const auto positions = positionsOf(output);
  for (std::size_t i = 0; i < cloud->size(); ++i) EXPECT_EQ(positions[i], positionOf((*cloud)[i]));
}

}  // namespace
}  // namespace mlsmesh::testing
