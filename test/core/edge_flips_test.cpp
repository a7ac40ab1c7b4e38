// SPDX-License-Identifier: BSD-3-Clause
#include "edge_flips.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "surfaces.h"
#include "test_shapes.h"

namespace mlsmesh::core {
namespace {

using test::Points;

HalfEdgeMesh meshOf(const Points& points, const std::vector<Triangle>& triangles) {
  HalfEdgeMesh mesh;
  EXPECT_TRUE(buildMesh(static_cast<Index>(points.size()), triangles, mesh));
  return mesh;
}

double smallestAngle(const Points& points, const std::vector<Triangle>& triangles) {
  double least = std::numeric_limits<double>::max();
  for (const Triangle& t : triangles) {
    for (int i = 0; i < 3; ++i) {
      const Vec3 a = points[t[(i + 1) % 3]] - points[t[i]], b = points[t[(i + 2) % 3]] - points[t[i]];
      least = std::min(least, std::atan2(a.cross(b).norm(), a.dot(b)));
    }
  }
  return least;
}

double upwardArea(const Points& points, const std::vector<Triangle>& triangles) {
  double area = 0;
  for (const auto& [a, b, c] : triangles)
    area += std::max(0.0, 0.5 * (points[b] - points[a]).cross(points[c] - points[a]).z());
  return area;
}

/// A square of quads whose inner points are moved about in the plane, cut along arbitrary diagonals.
struct Patch {
  static constexpr Index kSide = 15;
  Points points = test::planeLattice(kSide + 1, kSide + 1);
  HalfEdgeMesh mesh;

  explicit Patch(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> offset(-0.3, 0.3);
    for (Vec3& p : points) {
      const bool inner = p.x() > 0 && p.x() < kSide && p.y() > 0 && p.y() < kSide;
      if (inner) p += Vec3(offset(random), offset(random), 0);
    }
    mesh = meshOf(points, test::grid(kSide, kSide).triangles);
  }
};

/// Two triangles over the quad u, x, v, w, cut from u to v.
std::vector<Triangle> quad() {
  return {{0, 1, 2}, {1, 0, 3}};
}

TEST(EdgeFlips, ImproveTheSmallestAngle) {
  const Points flat = {{-3, 0, 0}, {3, 0, 0}, {0, 1, 0}, {0, -1, 0}};
  HalfEdgeMesh mesh = meshOf(flat, quad());
  EXPECT_EQ(flipEdges(mesh, flat, FlipRule::MinAngle, true, {}), 1);
  EXPECT_TRUE(mesh.find(2, 3) != kNone && mesh.find(3, 2) != kNone);
  EXPECT_EQ(flipEdges(mesh, flat, FlipRule::MinAngle, true, {}), 0);
}

TEST(EdgeFlips, TakeTheShorterDiagonal) {
  // The diagonal from 0 to 1 is longer, but the smallest angle is larger with it.
  const Points kite = {{-1, 0, 0}, {1.2, 0, 0}, {-0.95, 1, 0}, {-0.95, -1, 0}};
  HalfEdgeMesh by_length = meshOf(kite, quad()), by_angle = by_length;
  EXPECT_EQ(flipEdges(by_length, kite, FlipRule::Length, true, {}), 1);
  EXPECT_EQ(flipEdges(by_angle, kite, FlipRule::MinAngle, true, {}), 0);
}

TEST(EdgeFlips, LeaveTheMeshAloneWhenAsked) {
  Patch patch(1);
  const std::vector<Triangle> before = patch.mesh.triangles();
  EXPECT_EQ(flipEdges(patch.mesh, patch.points, FlipRule::NoFlips, true, {}), 0);
  EXPECT_EQ(patch.mesh.triangles(), before);
}

TEST(EdgeFlips, KeepAPlaneCoveredOnce) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    for (const FlipRule rule : {FlipRule::MinAngle, FlipRule::Length}) {
      Patch patch(seed);
      const double before = smallestAngle(patch.points, patch.mesh.triangles());
      const Index flips = flipEdges(patch.mesh, patch.points, rule, true, {});
      const std::vector<Triangle> triangles = patch.mesh.triangles();
      EXPECT_GT(flips, 20);
      EXPECT_EQ(patch.mesh.validate(), "");
      EXPECT_NEAR(upwardArea(patch.points, triangles), Patch::kSide * Patch::kSide, 1e-9);
      const MeshReport report = reportMesh(patch.points, triangles);
      test::expectSound(report);
      EXPECT_EQ(report.border_edges, 4 * Patch::kSide);
      EXPECT_TRUE(rule == FlipRule::Length || smallestAngle(patch.points, triangles) >= before);
    }
  }
}

TEST(EdgeFlips, ReachDelaunayInThePlane) {
  Patch patch(2);
  flipEdges(patch.mesh, patch.points, FlipRule::MinAngle, true, {});
  // Where no flip enlarges the smallest angle, the angles opposite to an edge add up to at most half a turn.
  const auto angleAt = [&](Index apex, Index a, Index b) {
    const Vec3 u = patch.points[a] - patch.points[apex], v = patch.points[b] - patch.points[apex];
    return std::atan2(u.cross(v).norm(), u.dot(v));
  };
  for (Index h = 0; h < 3 * patch.mesh.slotCount(); ++h) {
    const Index g = patch.mesh.twin(h);
    if (g == kNone) continue;
    const Index u = patch.mesh.origin(h), v = patch.mesh.target(h);
    EXPECT_LE(angleAt(patch.mesh.opposite(h), u, v) + angleAt(patch.mesh.opposite(g), u, v),
              3.14159265358979323846 + 1e-6);
  }
}

TEST(EdgeFlips, RefuseWhatTheGuardForbids) {
  // A dart: the other diagonal is shorter but runs outside of it.
  const Points dart = {{0, 0, 0}, {4, 0, 0}, {-1, 1, 0}, {-1, -1, 0}};
  HalfEdgeMesh guarded = meshOf(dart, quad()), unguarded = guarded;
  EXPECT_EQ(flipEdges(guarded, dart, FlipRule::Length, true, {}), 0);
  EXPECT_EQ(flipEdges(unguarded, dart, FlipRule::Length, false, {}), 1);
  // A steep roof: the other diagonal is shorter but would cut through the house.
  const Points roof = {{-1.5, 0, 3}, {1.5, 0, 3}, {0, 1, 0}, {0, -1, 0}};
  HalfEdgeMesh bent = meshOf(roof, quad()), cut = bent;
  EXPECT_EQ(flipEdges(bent, roof, FlipRule::Length, true, {}), 0);
  EXPECT_EQ(flipEdges(cut, roof, FlipRule::Length, false, {}), 1);
}

TEST(EdgeFlips, NeverMakeADegenerateTriangle) {
  const Points corner = {{0, 0, 0}, {4, 0, 0}, {0, 1, 0}, {0, -1, 0}};  // 3, 0, 2 on a line
  HalfEdgeMesh mesh = meshOf(corner, quad());
  EXPECT_EQ(flipEdges(mesh, corner, FlipRule::Length, false, {}), 0);
}

TEST(EdgeFlips, KeepAManifoldEvenUnguarded) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    for (const test::Soup& soup : {test::torus(12, 9), test::openCylinder(12, 6), test::octahedron()}) {
      const Points points = test::noisy(soup.vertices, 0.4, seed);
      for (const FlipRule rule : {FlipRule::Length, FlipRule::MinAngle}) {
        for (const bool guard : {false, true}) {
          HalfEdgeMesh mesh = meshOf(points, soup.triangles);
          const MeshReport before = reportMesh(points, soup.triangles);
          flipEdges(mesh, points, rule, guard, {});
          const MeshReport report = reportMesh(points, mesh.triangles());
          EXPECT_EQ(mesh.validate(), "");
          test::expectSound(report);
          EXPECT_EQ(report.triangles, before.triangles);
          EXPECT_EQ(report.euler, before.euler);
          EXPECT_EQ(report.border_loops, before.border_loops);
          EXPECT_EQ(report.isolated_vertices, 0);
          for (Index v = 0; v < mesh.vertexCount(); ++v)
            EXPECT_GE(mesh.degree(v), mesh.isInterior(v) ? 3 : 1);
        }
      }
    }
  }
}

double sharpestBend(const Points& points, const HalfEdgeMesh& mesh) {
  const auto normal = [&](Index h) {
    const Vec3& u = points[mesh.origin(h)];
    return (points[mesh.target(h)] - u).cross(points[mesh.opposite(h)] - u).normalized();
  };
  double least_cosine = 1;
  for (Index h = 0; h < 3 * mesh.slotCount(); ++h)
    if (!mesh.isBorder(h)) least_cosine = std::min(least_cosine, normal(h).dot(normal(mesh.twin(h))));
  return least_cosine;
}

TEST(EdgeFlips, DoNotSharpenTheSharpestBend) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    for (const FlipRule rule : {FlipRule::MinAngle, FlipRule::Length}) {
      Patch patch(seed);
      const Points bumpy = test::noisy(patch.points, 0.2, seed);
      const double before = sharpestBend(bumpy, patch.mesh);
      EXPECT_GT(flipEdges(patch.mesh, bumpy, rule, true, {}), 10);
      EXPECT_GE(sharpestBend(bumpy, patch.mesh), before - 1e-12);
    }
  }
}

TEST(EdgeFlips, DoNotLowerTheSmallestAngleOfASurface) {
  const test::Soup ring = test::torus(20, 9);
  HalfEdgeMesh mesh = meshOf(ring.vertices, ring.triangles);
  flipEdges(mesh, ring.vertices, FlipRule::MinAngle, true, {});
  EXPECT_GE(smallestAngle(ring.vertices, mesh.triangles()),
            smallestAngle(ring.vertices, ring.triangles) - 1e-9);
}

}  // namespace
}  // namespace mlsmesh::core
