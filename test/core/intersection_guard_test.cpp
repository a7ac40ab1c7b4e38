// SPDX-License-Identifier: BSD-3-Clause
#include "intersection_guard.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "mlsmesh/core/self_intersections.h"
#include "mlsmesh/mesh_report.h"
#include "test_shapes.h"

namespace mlsmesh::core {
namespace {

using test::Soup;

// A flat sheet of unit squares, cut in halves.
Soup sheet(Index squares, double height) {
  Soup soup;
  for (Index x = 0; x <= squares; ++x) {
    for (Index y = 0; y <= squares; ++y) soup.vertices.emplace_back(x, y, height);
  }
  for (Index x = 0; x < squares; ++x) {
    for (Index y = 0; y < squares; ++y) {
      const Index a = x * (squares + 1) + y, b = a + squares + 1;
      soup.triangles.push_back({a, b, b + 1});
      soup.triangles.push_back({a, b + 1, a + 1});
    }
  }
  return soup;
}

// A mesh of two levels, the finer of which is not guarded yet.
struct Refined {
  PointSet points;
  RefinedMesh mesh;
  NewLevel level;
  std::vector<Triangle> triangles;

  explicit Refined(const Soup& parent) {
    points.stored_as = StoredAs::Double;
    mesh.position = parent.vertices;
    level.first_vertex = parent.vertexCount();
    std::map<std::pair<Index, Index>, Index> middles;
    const auto middle = [&](Index u, Index v) {
      const auto [found, is_new] =
          middles.insert({std::minmax(u, v), level.first_vertex + static_cast<Index>(level.midpoint.size())});
      if (is_new) level.midpoint.push_back(0.5 * (parent.vertices[u] + parent.vertices[v]));
      return found->second;
    };
    for (const auto& [a, b, c] : parent.triangles) {
      const Index ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      for (const Triangle& child : {Triangle{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}})
        level.unflipped.push_back(child);
    }
    mesh.position.insert(mesh.position.end(), level.midpoint.begin(), level.midpoint.end());
    mesh.kind.assign(mesh.position.size(), VertexKind::Projected);
    EXPECT_TRUE(buildMesh(static_cast<Index>(mesh.position.size()), level.unflipped, level.flipped));
    triangles = level.unflipped;
  }

  void displace(double most, unsigned seed) {
    const std::vector<Vec3> shifts = test::randomCloud(level.midpoint.size(), seed);
    for (std::size_t i = 0; i < shifts.size(); ++i)
      mesh.position[level.first_vertex + static_cast<Index>(i)] += most * shifts[i];
  }

  void flipAtRandom(Index tries, unsigned seed) {
    std::mt19937 random(seed);
    for (Index i = 0; i < tries; ++i) {
      const Index h = static_cast<Index>(random() % (3 * level.unflipped.size())), g = level.flipped.twin(h);
      if (level.flipped.degree(level.flipped.origin(h)) < 4 ||
          level.flipped.degree(level.flipped.target(h)) < 4)
        continue;
      if (level.flipped.flip(h))
        level.flips.push_back({HalfEdgeMesh::triangleOf(h), HalfEdgeMesh::triangleOf(g)});
    }
    triangles = level.flipped.triangles();
  }

  std::int64_t pairs() const { return SelfIntersections(mesh.position, triangles, Context()).count(); }
  std::size_t guard() { return guardIntersections(points, level, Context(), mesh, triangles).size(); }
};

void expectSound(const Refined& refined) {
  const MeshReport report = reportMesh(refined.mesh.position, refined.triangles, Context());
  EXPECT_TRUE(report.isSound());
  EXPECT_EQ(report.isolated_vertices, 0);
  EXPECT_EQ(report.triangles, static_cast<Index>(refined.level.unflipped.size()));
}

TEST(IntersectionGuard, LeavesASoundLevelAlone) {
  Refined refined(test::together(sheet(6, 0), sheet(6, 1)));
  refined.displace(0.2, 1);
  const RefinedMesh before = refined.mesh;
  EXPECT_EQ(refined.guard(), 0u);
  EXPECT_EQ(refined.mesh.position, before.position);
  EXPECT_EQ(refined.mesh.kind, before.kind);
  EXPECT_EQ(refined.triangles, refined.level.unflipped);
}

TEST(IntersectionGuard, PullsSheetsApart) {
  for (unsigned seed = 1; seed < 6; ++seed) {
    Refined refined(test::together(sheet(8, 0), sheet(8, 0.125)));
    refined.displace(0.2, seed);
    const RefinedMesh before = refined.mesh;
    ASSERT_GT(refined.pairs(), 0);
    EXPECT_EQ(refined.guard(), 0u);
    EXPECT_EQ(refined.pairs(), 0);
    expectSound(refined);
    Index pulled = 0;
    for (std::size_t v = 0; v < before.position.size(); ++v) {
      const bool is_new = static_cast<Index>(v) >= refined.level.first_vertex;
      const bool moved = refined.mesh.position[v] != before.position[v];
      EXPECT_EQ(refined.mesh.kind[v] == VertexKind::FoldGuarded, moved);
      if (!moved) continue;
      ++pulled;
      ASSERT_TRUE(is_new);
      const Vec3 middle = refined.level.midpoint[v - static_cast<std::size_t>(refined.level.first_vertex)];
      const double left = (refined.mesh.position[v] - middle).norm() / (before.position[v] - middle).norm();
      EXPECT_TRUE(left == 0 || std::abs(left - 0.5) < 1e-12 || std::abs(left - 0.25) < 1e-12) << left;
    }
    EXPECT_GT(pulled, 0);
    EXPECT_LT(pulled, static_cast<Index>(refined.level.midpoint.size())) << "not all of them are to blame";
  }
}

TEST(IntersectionGuard, TakesBackFlips) {
  for (unsigned seed = 1; seed < 6; ++seed) {
    Refined refined(test::together(sheet(8, 0), sheet(8, 0.125)));
    refined.displace(0.05, seed);
    refined.flipAtRandom(400, seed);
    const std::vector<Triangle> flipped = refined.triangles;
    ASSERT_GT(refined.pairs(), 0);
    EXPECT_EQ(refined.guard(), 0u);
    EXPECT_EQ(refined.pairs(), 0);
    expectSound(refined);
    EXPECT_NE(refined.triangles, flipped);
  }
}

TEST(IntersectionGuard, TakesBackFlipsThatWouldDoubleAnEdge) {
  for (unsigned seed = 1; seed < 200; ++seed) {
    Refined refined(test::tetrahedron());
    refined.displace(0.1, seed);
    refined.flipAtRandom(12, seed);
    EXPECT_EQ(refined.guard(), 0u) << seed;
    expectSound(refined);
  }
}

TEST(IntersectionGuard, EndsWhereTheParentCrossesItself) {
  Soup upright = sheet(4, 0);
  for (Vec3& p : upright.vertices) p = Vec3(p.z() + 1.7, p.y() + 0.3, p.x() - 1.6);
  Refined refined(test::together(sheet(4, 0), upright));
  refined.displace(0.05, 2);
  refined.flipAtRandom(50, 2);
  const std::int64_t left = refined.guard();
  EXPECT_GT(left, 0);
  EXPECT_EQ(left, refined.pairs());
  expectSound(refined);
}

}  // namespace
}  // namespace mlsmesh::core
