// SPDX-License-Identifier: BSD-3-Clause
#include "clouds.h"
#include "mlsmesh/mls_multiresolution.h"

#include <gtest/gtest.h>

#include <pcl/point_types.h>

namespace mlsmesh::testing {
namespace {

/// A sphere of radius 1000 whose points are floats about (1e6, 1e6, 1e6), at steps of 1/16 there.
std::vector<core::Vec3> roundedSphere() {
  std::vector<core::Vec3> points = spherePoints(4000);
  for (core::Vec3& point : points)
    point = (1000 * point + core::Vec3::Constant(1e6)).cast<float>().cast<double>();
  return points;
}

pcl::PolygonMesh meshOf(const std::vector<core::Vec3>& points) {
  MlsMultiresolution<pcl::PointXYZ> multiresolution;
  multiresolution.setInputCloud(cloudOf<pcl::PointXYZ>(points));
  pcl::PolygonMesh mesh;
  multiresolution.reconstruct(mesh);
  EXPECT_TRUE(multiresolution.status().ok()) << multiresolution.status().message;
  return mesh;
}

double worstRadius(const std::vector<core::Vec3>& positions, const core::Vec3& center) {
  double worst = 0;
  for (const core::Vec3& position : positions)
    worst = std::max(worst, std::abs((position - center).norm() - 1000));
  return worst;
}

/// Not triangle by triangle: vertices are rounded to floats, which are coarser there, before edges are
/// judged.
TEST(FarFromOrigin, FloatsGiveTheSurfaceOfTheOrigin) {
  const core::Vec3 offset = core::Vec3::Constant(1e6);
  std::vector<core::Vec3> points = roundedSphere();
  const pcl::PolygonMesh far = meshOf(points);
  for (core::Vec3& point : points) point -= offset;  // exact: both are floats
  const pcl::PolygonMesh near = meshOf(points);
  for (const pcl::PolygonMesh* mesh : {&far, &near}) {
    const MeshReport report = reportOf(*mesh);
    EXPECT_EQ(report.components, 1);
    EXPECT_EQ(report.border_loops, 0);
    EXPECT_EQ(report.genus, 0);
  }
  const double rounding =
      0.5 * 0.0625 * std::sqrt(3.0);  // half a step of floats about 1e6, in all three axes
  EXPECT_LE(worstRadius(positionsOf(far), offset),
            worstRadius(positionsOf(near), core::Vec3::Zero()) + 2 * rounding);
}

}  // namespace
}  // namespace mlsmesh::testing
