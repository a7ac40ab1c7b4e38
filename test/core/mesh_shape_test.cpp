// SPDX-License-Identifier: BSD-3-Clause
#include "mlsmesh/mesh_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "mlsmesh/mesh_welding.h"
#include "test_shapes.h"

namespace mlsmesh {
namespace {

using core::Triangle;
using core::Vec3;

MeshShape shapeOf(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles) {
  return meshShape(vertices, triangles, core::Context());
}

TEST(MeshShape, OfNothingIsUnknown) {
  const MeshShape shape = shapeOf({{1, 2, 3}}, {});
  EXPECT_EQ(shape.diagonal, 0);
  EXPECT_EQ(shape.area, 0);
  EXPECT_TRUE(std::isnan(shape.quality.mean));
  EXPECT_TRUE(std::isnan(shape.edge_length.min));
  EXPECT_TRUE(std::isnan(shape.smallest_dihedral));
}

TEST(MeshShape, OfAnEquilateralTriangle) {
  const MeshShape shape = shapeOf({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2}});
  EXPECT_NEAR(shape.quality.min, 1, 1e-15);
  EXPECT_NEAR(shape.smallest_angle.min, 60, 1e-12);
  EXPECT_NEAR(shape.largest_angle.max, 60, 1e-12);
  EXPECT_NEAR(shape.edge_length.max, std::sqrt(2.0), 1e-15);
  EXPECT_NEAR(shape.area, std::sqrt(3.0) / 2, 1e-15);
  EXPECT_NEAR(shape.diagonal, std::sqrt(3.0), 1e-15);
}

TEST(MeshShape, OfARightTriangle) {
  const MeshShape shape = shapeOf({{0, 0, 0}, {3, 0, 0}, {0, 4, 0}, {99, 99, 99}}, {{0, 1, 2}});
  EXPECT_NEAR(shape.quality.mean, 2 * 1 / 2.5, 1e-15) << "inradius 1, circumradius 2.5";
  EXPECT_NEAR(shape.largest_angle.max, 90, 1e-12);
  EXPECT_NEAR(shape.smallest_angle.min, std::atan2(3, 4) * 180 / std::acos(-1), 1e-12);
  EXPECT_EQ(shape.edge_length.mean, 4);
  EXPECT_EQ(shape.diagonal, 5) << "of vertices in use";
}

TEST(MeshShape, OfDegenerateTriangles) {
  const MeshShape shape =
      shapeOf({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, 0}, {0, 0, 0}}, {{0, 1, 2}, {0, 3, 4}, {1, 1, 2}});
  EXPECT_EQ(shape.quality.max, 0);
  EXPECT_EQ(shape.smallest_angle.max, 0) << "also where all three corners are at one place";
  EXPECT_EQ(shape.area, 0);
}

TEST(MeshShape, TellsFoldsFromFlatEdges) {
  // Hinged at the x axis, the second wing is turned up from flat by 180 - the dihedral angle.
  const auto hinge = [](double dihedral) {
    const double angle = dihedral * std::acos(-1) / 180;
    return shapeOf({{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, std::cos(angle), std::sin(angle)}},
                   {{0, 1, 2}, {1, 0, 3}});
  };
  EXPECT_NEAR(hinge(180).smallest_dihedral, 180, 1e-9);
  EXPECT_NEAR(hinge(90).smallest_dihedral, 90, 1e-9);
  EXPECT_EQ(hinge(31).folded_edges, 0);
  EXPECT_EQ(hinge(29).folded_edges, 1);
  EXPECT_EQ(hinge(6).flipped_edges, 0);
  EXPECT_EQ(hinge(4).flipped_edges, 1);
}

TEST(MeshShape, LeavesDegenerateTrianglesOutOfAnglesAcrossEdges) {
  const MeshShape shape =
      shapeOf({{0.1, 0.1, 0.1}, {0.3, 0.3, 0.3}, {0.2, 0.7, 0.1}, {0.7, 0.7, 0.7}}, {{0, 1, 2}, {1, 0, 3}});
  EXPECT_TRUE(std::isnan(shape.smallest_dihedral));
  EXPECT_EQ(shape.folded_edges, 0);
}

TEST(Statistics, TakePercentilesByRank) {
  std::vector<double> values;
  for (int i = 100; i-- > 0;) values.push_back(i);
  const Statistics s = statisticsOf(values);
  EXPECT_EQ(s.min, 0);
  EXPECT_EQ(s.p5, 5);
  EXPECT_EQ(s.p95, 95);
  EXPECT_EQ(s.p99, 99);
  EXPECT_EQ(s.max, 99);
  EXPECT_EQ(s.mean, 49.5);
  EXPECT_NEAR(s.rms, std::sqrt(99.0 * 199 / 6), 1e-12);
  EXPECT_EQ(shareAbove(values, 89), 0.1);
  EXPECT_TRUE(std::isnan(statisticsOf({}).mean));
  EXPECT_TRUE(std::isnan(shareAbove({}, 1)));
}

TEST(MeshWelding, KeepsTheFirstOfEachPlace) {
  std::vector<Vec3> vertices = {{1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {-0.0, 0, 0}, {0, 1, 0}};
  std::vector<Triangle> triangles = {{0, 1, 4}, {2, 4, 3}};
  EXPECT_EQ(weldVertices(vertices, triangles), 2);
  ASSERT_EQ(vertices.size(), 3u);
  EXPECT_EQ(vertices[0], Vec3(1, 0, 0));
  EXPECT_EQ(vertices[2], Vec3(0, 1, 0));
  EXPECT_EQ(triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 1}}));
}

TEST(MeshWelding, LeavesWhatIsNotFinite) {
  std::vector<Vec3> vertices(2, Vec3(kUnknown, 0, 0));
  std::vector<Triangle> none;
  EXPECT_EQ(weldVertices(vertices, none), 0);
}

TEST(MeshWelding, PutsAnUnweldedSoupTogether) {
  const test::Soup torus = test::torus(8, 9);
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  for (const Triangle& t : torus.triangles) {
    const auto first = static_cast<core::Index>(vertices.size());
    triangles.push_back({first, first + 1, first + 2});
    for (const core::Index corner : t) vertices.push_back(torus.vertices[corner]);
  }
  EXPECT_EQ(weldVertices(vertices, triangles), 6 * 72 - 72);
}

}  // namespace
}  // namespace mlsmesh
