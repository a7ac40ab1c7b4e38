// SPDX-License-Identifier: BSD-3-Clause
#include "overlap_tests.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "surfaces.h"

namespace mlsmesh::core {
namespace {

using test::Points;

/// Vertex 0 at the origin and twelve around it, 30 degrees apart; some triangles between the spokes.
struct Wheel {
  Points points{Vec3::Zero()};
  HalfEdgeMesh mesh{13};

  Wheel() {
    for (int i = 0; i < 12; ++i)
      points.emplace_back(std::cos(0.523598775598299 * i), std::sin(0.523598775598299 * i), 0);
  }
  void add(int from, int to) { mesh.addTriangle(0, 1 + from, 1 + to); }
  NewTriangle triangle(Index a, Index b, Index c) const {
    const double longest = std::max(
        {(points[a] - points[b]).norm(), (points[b] - points[c]).norm(), (points[c] - points[a]).norm()});
    return {{a, b, c}, unitNormal(points[a], points[b], points[c]), longest};
  }
  bool overlapsAtHub(int from, int to) const {
    return overlapsSector(mesh, points, triangle(0, 1 + from, 1 + to), 0);
  }
};

TEST(OverlapTests, SeeSectorsThatOverlap) {
  Wheel wheel;
  EXPECT_FALSE(wheel.overlapsAtHub(0, 3));  // nothing is there yet
  wheel.add(0, 3);
  EXPECT_FALSE(wheel.overlapsAtHub(3, 6));
  EXPECT_FALSE(wheel.overlapsAtHub(9, 0));
  EXPECT_FALSE(wheel.overlapsAtHub(5, 8));
  EXPECT_TRUE(wheel.overlapsAtHub(1, 2));   // within
  EXPECT_TRUE(wheel.overlapsAtHub(11, 4));  // around
  EXPECT_TRUE(wheel.overlapsAtHub(2, 5));   // across one side
  EXPECT_TRUE(wheel.overlapsAtHub(11, 1));  // across the other
  EXPECT_TRUE(wheel.overlapsAtHub(0, 2));   // with a common side
  EXPECT_TRUE(wheel.overlapsAtHub(1, 3));
}

TEST(OverlapTests, SeeSectorsThatAreTurnedOver) {
  Wheel wheel;
  wheel.add(0, 3);
  wheel.add(3, 5);
  wheel.add(5, 7);
  EXPECT_TRUE(wheel.overlapsAtHub(10, 8));  // clockwise among counter-clockwise ones
}

TEST(OverlapTests, SeePointsInTheWay) {
  const Points points = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 0}, {3, 3, 0}, {1, 1, 2.9}, {1, 1, 2.7}};
  const HalfEdgeMesh mesh(7);
  const NewTriangle triangle{{0, 1, 2}, Vec3::UnitZ(), std::sqrt(32)};
  EXPECT_TRUE(containsPoint(mesh, points, triangle, 3));
  EXPECT_FALSE(containsPoint(mesh, points, triangle, 4));  // beside it
  EXPECT_FALSE(containsPoint(mesh, points, triangle, 5));  // higher than half the longest edge, 2.83
  EXPECT_TRUE(containsPoint(mesh, points, triangle, 6));
  EXPECT_FALSE(containsPoint(mesh, points, triangle, 0));  // its own corner
}

TEST(OverlapTests, IgnorePointsOfAnotherSheet) {
  const Points points = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 0.5}, {2, 1, 0.5}, {1, 2, 0.5}};
  const NewTriangle triangle{{0, 1, 2}, Vec3::UnitZ(), std::sqrt(32)};
  HalfEdgeMesh same(6), opposite(6);
  same.addTriangle(3, 4, 5);
  opposite.addTriangle(3, 5, 4);
  EXPECT_TRUE(containsPoint(same, points, triangle, 3));
  EXPECT_FALSE(containsPoint(opposite, points, triangle, 3));
}

TEST(OverlapTests, SeeBorderEdgesInTheWay) {
  // A new triangle over edge 0-1 with apex 2; a triangle beyond its side 1-2, or with a corner inside.
  const NewTriangle triangle{{0, 1, 2}, Vec3::UnitZ(), 4};
  const auto crosses = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    const Points points = {{0, 0, 0}, {4, 0, 0}, {2, 3, 0}, a, b, c};
    HalfEdgeMesh mesh(6);
    mesh.addTriangle(3, 4, 5);
    return BorderCrossings(mesh, points, triangle).at(3);
  };
  EXPECT_FALSE(crosses({4, 2, 0}, {6, 2, 0}, {5, 4, 0}));
  EXPECT_TRUE(crosses({2.5, 1, 0}, {6, 1, 0}, {5, 4, 0}));
  EXPECT_TRUE(crosses({2.5, 1, 1.9}, {6, 1, 1.9}, {5, 4, 1.9}));   // less than half the longest edge above
  EXPECT_FALSE(crosses({2.5, 1, 2.1}, {6, 1, 2.1}, {5, 4, 2.1}));  // more
  EXPECT_FALSE(crosses({2.5, 1, 0.5}, {5, 4, 0.5}, {6, 1, 0.5}));  // faces the other way: another sheet
}

}  // namespace
}  // namespace mlsmesh::core
