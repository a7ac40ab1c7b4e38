// SPDX-License-Identifier: BSD-3-Clause
#include "border_fill.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "cloud_support.h"
#include "surfaces.h"
#include "test_shapes.h"

namespace mlsmesh::core {
namespace {

using test::Points;

constexpr int kSide = 12;  // points of a sheet's side

HalfEdgeMesh meshOf(Index vertices, const std::vector<Triangle>& triangles) {
  HalfEdgeMesh mesh;
  EXPECT_TRUE(buildMesh(vertices, triangles, mesh));
  return mesh;
}

/// A flat square of unit quads, cut along one diagonal each.
HalfEdgeMesh sheet() {
  std::vector<Triangle> triangles;
  for (Index x = 0; x + 1 < kSide; ++x) {
    for (Index y = 0; y + 1 < kSide; ++y) {
      const Index a = x * kSide + y, b = a + kSide;
      triangles.push_back({a, b, b + 1});
      triangles.push_back({a, b + 1, a + 1});
    }
  }
  return meshOf(kSide * kSide, triangles);
}

Points sheetPoints() {
  return test::planeLattice(kSide, kSide);
}

Index at(Index x, Index y) {
  return x * kSide + y;
}

void removeStar(HalfEdgeMesh& mesh, Index vertex) {
  while (mesh.isUsed(vertex)) mesh.removeTriangle(HalfEdgeMesh::triangleOf(mesh.firstOutgoing(vertex)));
}

void removeFace(HalfEdgeMesh& mesh, Index u, Index v) {
  mesh.removeTriangle(HalfEdgeMesh::triangleOf(mesh.find(u, v)));
}

double areaOf(const HalfEdgeMesh& mesh, const Points& points) {
  double area = 0;
  for (const auto& [a, b, c] : mesh.triangles())
    area += 0.5 * (points[b] - points[a]).cross(points[c] - points[a]).norm();
  return area;
}

FillLimits limits(int max_edges, double max_perimeter) {
  return {max_edges, max_perimeter};
}

TEST(BorderFill, ClosesAHoleInAPlaneFlat) {
  HalfEdgeMesh mesh = sheet();
  removeStar(mesh, at(5, 5));
  const FillCount count = fillLoops(mesh, sheetPoints(), limits(6, 100));
  EXPECT_EQ(count.loops, 1);
  EXPECT_EQ(count.triangles, 4);  // a hexagon
  EXPECT_EQ(mesh.validate(), "");
  EXPECT_EQ(mesh.borderLoops().size(), 1u);
  // Without overlap: the area is that of the square, and every triangle looks up.
  EXPECT_NEAR(areaOf(mesh, sheetPoints()), (kSide - 1) * (kSide - 1), 1e-12);
  const Points points = sheetPoints();
  for (const auto& [a, b, c] : mesh.triangles())
    EXPECT_GT((points[b] - points[a]).cross(points[c] - points[a]).z(), 0);
}

TEST(BorderFill, ClosesAHoleInARoundSurface) {
  const test::Soup ball = test::octahedron();
  for (std::size_t missing = 0; missing < ball.triangles.size(); ++missing) {
    std::vector<Triangle> triangles = ball.triangles;
    triangles.erase(triangles.begin() + static_cast<std::ptrdiff_t>(missing));
    HalfEdgeMesh mesh = meshOf(6, triangles);
    EXPECT_EQ(fillLoops(mesh, ball.vertices, limits(6, 100)).triangles, 1);
    EXPECT_EQ(mesh.validate(), "");
    EXPECT_TRUE(mesh.borderLoops().empty());
  }
}

TEST(BorderFill, LeavesLoopsBeyondTheLimits) {
  const auto fills = [](int max_edges, double max_perimeter) {
    HalfEdgeMesh mesh = sheet();
    removeStar(mesh, at(5, 5));
    return fillLoops(mesh, sheetPoints(), limits(max_edges, max_perimeter)).loops;
  };
  const double perimeter =
      4 + 2 * std::sqrt(2.0);  // of the hexagon: four sides of the lattice, two diagonals
  EXPECT_EQ(fills(6, perimeter + 0.01), 1);
  EXPECT_EQ(fills(6, perimeter - 0.01), 0);
  EXPECT_EQ(fills(5, 100), 0);
}

TEST(BorderFill, LimitsGrowWhereTheCloudIsSparser) {
  const double perimeter = 4 + 2 * std::sqrt(2.0);
  const auto fills = [&](double local_spacing) {
    HalfEdgeMesh mesh = sheet();
    removeStar(mesh, at(5, 5));
    const std::vector<double> spacing(sheetPoints().size(), local_spacing);
    return fillLoops(mesh, sheetPoints(), {6, 10 * perimeter, 0.05, &spacing}).loops;
  };
  EXPECT_EQ(fills(0.19), 0);
  EXPECT_EQ(fills(0.21), 1);
  HalfEdgeMesh mesh = sheet();
  removeStar(mesh, at(5, 5));
  const std::vector<double> dense(sheetPoints().size(), 0.001);
  EXPECT_EQ(fillLoops(mesh, sheetPoints(), {6, 10 * perimeter, 0.11, &dense}).loops, 1);
}

TEST(BorderFill, ClosesHolesThatMeetAtAVertex) {
  HalfEdgeMesh mesh = sheet();
  const Points points = sheetPoints();
  // Opposite triangles at one vertex: the holes share it, and the walk along the border passes it twice.
  removeFace(mesh, at(5, 5), at(6, 5));
  removeFace(mesh, at(5, 5), at(4, 5));
  ASSERT_EQ(mesh.fanCount(at(5, 5)), 2);
  for (const std::vector<Index>& walk : mesh.borderLoopEdges()) {
    std::multiset<Index> edges(walk.begin(), walk.end());
    for (const std::vector<Index>& part : simpleLoops(mesh, walk)) {
      std::set<Index> vertices;
      for (std::size_t i = 0; i < part.size(); ++i) {
        EXPECT_TRUE(vertices.insert(mesh.origin(part[i])).second);
        EXPECT_EQ(mesh.target(part[i]), mesh.origin(part[(i + 1) % part.size()]));
        edges.erase(edges.find(part[i]));
      }
    }
    EXPECT_TRUE(edges.empty());
  }
  const FillCount count = fillLoops(mesh, points, limits(6, 100));
  EXPECT_EQ(count.loops, 2);
  EXPECT_EQ(count.triangles, 2);
  EXPECT_EQ(mesh.validate(), "");
  EXPECT_EQ(mesh.triangleCount(), sheet().triangleCount());
}

TEST(BorderFill, MakesNoSecondSideOfALoneTriangle) {
  HalfEdgeMesh mesh = meshOf(3, {{0, 1, 2}});
  const Points points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_EQ(fillLoops(mesh, points, limits(6, 100)).loops, 0);
  EXPECT_EQ(mesh.triangleCount(), 1);
}

TEST(BorderFill, UsesNoEdgeTwice) {
  // A tetrahedron without two faces: one diagonal of its loop is the edge of the two others.
  const test::Soup solid = test::tetrahedron();
  HalfEdgeMesh mesh = meshOf(4, {solid.triangles[0], solid.triangles[1]});
  EXPECT_EQ(fillLoops(mesh, solid.vertices, limits(6, 100)).triangles, 2);
  EXPECT_EQ(mesh.validate(), "");
  EXPECT_TRUE(mesh.borderLoops().empty());
  test::expectSound(reportMesh(solid.vertices, mesh.triangles()));
}

TEST(BorderFill, KeepsOffEdgesThatStandOverTheHole) {
  // A square hole with two opposite corners lifted: the smoothest fill cuts it from one of the others to the
  // other, unless a fin stands there already.
  Points points = sheetPoints();
  points[at(5, 5)].z() = points[at(6, 6)].z() = 0.1;
  points.emplace_back(5.5, 5.5, 5);
  const Index fin = kSide * kSide;
  for (const bool has_fin : {false, true}) {
    HalfEdgeMesh mesh = sheet();
    removeFace(mesh, at(5, 5), at(6, 5));
    removeFace(mesh, at(6, 6), at(5, 6));
    mesh.addVertex();
    if (has_fin) mesh.addTriangle(at(6, 5), at(5, 6), fin);
    const Index before = mesh.triangleCount();
    EXPECT_EQ(fillLoops(mesh, points, limits(4, 100)).triangles, 2);
    EXPECT_EQ(mesh.triangleCount(), before + 2);
    EXPECT_EQ(mesh.find(at(5, 5), at(6, 6)) != kNone, has_fin);
  }
}

TEST(BorderFill, MakesNoDegenerateTriangle) {
  HalfEdgeMesh mesh = sheet();
  for (Index y = 4; y < 7; ++y) removeStar(mesh, at(5, y));  // a hole with straight sides of four edges
  const Points points = sheetPoints();
  ASSERT_EQ(fillLoops(mesh, points, limits(12, 100)).loops, 1);
  test::expectSound(reportMesh(points, mesh.triangles()));
  EXPECT_NEAR(areaOf(mesh, points), (kSide - 1) * (kSide - 1), 1e-12);
}

TEST(CloudSupport, AsksForPointsNearLongTriangles) {
  const Points corners = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0.4, 0, 0}, {0, 0.4, 0}};
  const std::vector<double> spacing(corners.size(), 0.25);
  Points cloud;
  for (double x = 0; x <= 4; x += 0.25)
    for (double y = 0; x + y <= 4; y += 0.25) cloud.emplace_back(x, y, 0);
  const auto everywhere = makeKdTree(cloud);
  EXPECT_TRUE(CloudSupport(corners, spacing, *everywhere, 2).supports({0, 1, 2}));
  for (const Vec3& needed : {Vec3(2, 2, 0), Vec3(2, 0, 0), Vec3(0, 2, 0), Vec3(4. / 3, 4. / 3, 0)}) {
    Points holed;
    for (const Vec3& p : cloud)
      if ((p - needed).norm() > 0.51) holed.push_back(p);
    const auto search = makeKdTree(holed);
    EXPECT_FALSE(CloudSupport(corners, spacing, *search, 2).supports({0, 1, 2}));
    EXPECT_TRUE(CloudSupport(corners, spacing, *search, 0).supports({0, 1, 2}));
  }
  // A triangle no longer than the reach lies where its corners lie.
  const auto far_away = makeKdTree({{100, 0, 0}});
  EXPECT_TRUE(CloudSupport(corners, spacing, *far_away, 2.3).supports({0, 3, 4}));
  EXPECT_FALSE(CloudSupport(corners, spacing, *far_away, 2.2).supports({0, 3, 4}));
  EXPECT_TRUE(CloudSupport().supports({0, 1, 2}));
  // Points that are known to be nearest answer as the search does.
  const Points sparse = {{0.1, 0, 0}, {2, 0.2, 0}, {0.2, 2.1, 0}, {1.9, 2, 0}, {1.3, 1.4, 0.1}};
  const auto search = makeKdTree(sparse);
  const std::vector<Index> nearest = {0, 1, 2, 0, 0};
  for (const double reach : {0.5, 1.0, 2.0, 3.0, 6.0, 9.0}) {
    const CloudSupport plain(corners, spacing, *search, reach);
    CloudSupport knowing = plain;
    knowing.knowNearest(sparse, nearest);
    for (const Triangle& t : {Triangle{0, 1, 2}, Triangle{0, 3, 4}, Triangle{1, 3, 4}, Triangle{2, 3, 1}})
      EXPECT_EQ(plain.supports(t), knowing.supports(t)) << reach;
  }
}

}  // namespace
}  // namespace mlsmesh::core
