// SPDX-License-Identifier: BSD-3-Clause
#include "mlsmesh/core/self_intersections.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "mlsmesh/mesh_report.h"
#include "test_shapes.h"

namespace mlsmesh::core {
namespace {

using test::Soup;

std::vector<TrianglePair> pairsOf(const Soup& soup, int threads = 1) {
  Context context;
  context.threads = threads;
  const SelfIntersections search(soup.vertices, soup.triangles, context);
  const std::vector<TrianglePair> pairs = search.all();
  EXPECT_EQ(search.count(), static_cast<std::int64_t>(pairs.size()));
  return pairs;
}

bool meet(const std::vector<Vec3>& vertices, const Triangle& a, const Triangle& b) {
  return !pairsOf({vertices, {a, b}}).empty();
}

Soup apart(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& e, const Vec3& f) {
  return {{a, b, c, d, e, f}, {{0, 1, 2}, {3, 4, 5}}};
}

const Vec3 kO(0, 0, 0), kX(4, 0, 0), kY(0, 4, 0);

TEST(SelfIntersections, TrianglesWithoutACommonCorner) {
  const auto count = [](const Vec3& d, const Vec3& e, const Vec3& f) {
    return pairsOf(apart(kO, kX, kY, d, e, f)).size();
  };
  EXPECT_EQ(count({1, 1, -1}, {1, 1, 1}, {9, 9, 1}), 1u) << "a side pierces the inside";
  EXPECT_EQ(count({1, 1, 0}, {1, 1, 1}, {9, 9, 1}), 1u) << "a corner touches the inside";
  EXPECT_EQ(count({2, -1, 0}, {2, 1, 1}, {2, 1, 2}), 0u) << "beside it";
  EXPECT_EQ(count({2, 0, 0}, {2, -1, 1}, {3, -1, 1}), 1u) << "a corner touches a side";
  EXPECT_EQ(count({2, 0, -1}, {2, 0, 1}, {2, -9, 0}), 1u) << "a side touches a side";
  EXPECT_EQ(count({1, 1, 0}, {2, 1, 0}, {1, 2, 0}), 1u) << "inside it, in its plane";
  EXPECT_EQ(count({-9, -9, 0}, {40, -9, 0}, {-9, 40, 0}), 1u) << "around it, in its plane";
  EXPECT_EQ(count({-1, 1, 0}, {5, 1, 0}, {-1, 2, 0}), 1u) << "across it, in its plane";
  EXPECT_EQ(count({2, 0, 0}, {3, 0, 0}, {2, -2, 0}), 1u) << "along a side, in its plane";
  EXPECT_EQ(count({3, 3, 0}, {4, 3, 0}, {3, 4, 0}), 0u) << "in its plane, boxes overlap, apart";
  EXPECT_EQ(count({0, 0, 1e-300}, {4, 0, 1e-300}, {0, 4, 1e-300}), 0u) << "parallel and close";
}

TEST(SelfIntersections, TrianglesWithACommonCorner) {
  const auto meets = [](const Vec3& d, const Vec3& e) {
    return meet({kO, kX, kY, d, e}, {0, 1, 2}, {0, 3, 4});
  };
  EXPECT_FALSE(meets({-1, 0, 0}, {0, -1, 0})) << "flat, on the other side";
  EXPECT_FALSE(meets({-1, 0, 1}, {0, -1, 1}));
  EXPECT_TRUE(meets({1, 1, 1}, {1, 1, -1})) << "stands through it";
  EXPECT_TRUE(meets({1, 1, 0}, {1, 1, -1})) << "stands on it";
  EXPECT_TRUE(meets({5, 1, 0}, {1, 5, 0})) << "flat, upon it";
  EXPECT_TRUE(meets({2, 0, 0}, {2, -2, 0})) << "flat, along its side";
  EXPECT_TRUE(meets({9, 9, 1}, {9, 9, -1})) << "its far side is beyond, but it cuts";
}

TEST(SelfIntersections, TrianglesWithACommonEdge) {
  const auto meets = [](const Vec3& d) { return meet({kO, kX, kY, d}, {0, 1, 2}, {1, 0, 3}); };
  EXPECT_FALSE(meets({1, -1, 0})) << "flat";
  EXPECT_FALSE(meets({1, 1, 1e-300})) << "folded sharply";
  EXPECT_TRUE(meets({1, 1, 0})) << "folded over";
  EXPECT_TRUE(meets({9, 9, 0}));
}

TEST(SelfIntersections, CornersAtEqualPositionsAreShared) {
  EXPECT_TRUE(pairsOf(apart(kO, kX, kY, kO, {-1, 0, 0}, {0, -1, 0})).empty());
  EXPECT_TRUE(pairsOf(apart(kO, kX, kY, kX, kO, {1, -1, 0})).empty());
  EXPECT_TRUE(pairsOf(apart(kO, kX, kY, kX, kO, kY)).empty()) << "a duplicate is not a crossing";
  EXPECT_EQ(pairsOf(apart(kO, kX, kY, kX, kO, {1, 1, 0})).size(), 1u);
}

TEST(SelfIntersections, DegenerateTrianglesAreInNone) {
  EXPECT_TRUE(pairsOf(apart(kO, kX, kY, {1, 1, -1}, {1, 1, 0}, {1, 1, 1})).empty());
  const double bad = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(pairsOf(apart(kO, kX, kY, {1, 1, -1}, {1, 1, bad}, {9, 9, 1})).empty());
  EXPECT_TRUE(pairsOf({}).empty());
}

// Sign of the volume of four points with small whole coordinates.
int side(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const double volume = (b - a).cross(c - a).dot(d - a);
  return volume > 0 ? 1 : volume < 0 ? -1 : 0;
}

Soup wholeSoup(Index triangles, int side_length, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> coordinate(0, side_length), offset(-3, 3);
  Soup soup;
  for (Index t = 0; t < triangles; ++t) {
    const Vec3 center(coordinate(random), coordinate(random), coordinate(random));
    for (int i = 0; i < 3; ++i)
      soup.vertices.push_back(center + Vec3(offset(random), offset(random), offset(random)));
    soup.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  return soup;
}

bool isFlat(const Soup& soup, Index t) {
  const auto& [a, b, c] = soup.triangles[t];
  return (soup.vertices[b] - soup.vertices[a]).cross(soup.vertices[c] - soup.vertices[a]).isZero(0);
}

// Whether some side of one passes through the inside of the other.
bool crossProperly(const Soup& soup, Index a, Index b) {
  if (isFlat(soup, a) || isFlat(soup, b)) return false;
  const auto at = [&](Index t, int i) { return soup.vertices[soup.triangles[t][i % 3]]; };
  for (const auto& [s, t] : {TrianglePair{a, b}, TrianglePair{b, a}}) {
    for (int i = 0; i < 3; ++i) {
      const Vec3 p = at(s, i), q = at(s, i + 1);
      if (side(at(t, 0), at(t, 1), at(t, 2), p) * side(at(t, 0), at(t, 1), at(t, 2), q) >= 0) continue;
      const int turn = side(p, q, at(t, 0), at(t, 1));
      if (turn != 0 && turn == side(p, q, at(t, 1), at(t, 2)) && turn == side(p, q, at(t, 2), at(t, 0)))
        return true;
    }
  }
  return false;
}

TEST(SelfIntersections, FindsEveryProperCrossing) {
  const Soup soup = wholeSoup(600, 20, 3);
  const std::vector<TrianglePair> pairs = pairsOf(soup);
  EXPECT_TRUE(std::is_sorted(pairs.begin(), pairs.end()));
  Index crossings = 0;
  for (Index a = 0; a < 600; ++a) {
    for (Index b = a + 1; b < 600; ++b) {
      if (!crossProperly(soup, a, b)) continue;
      ++crossings;
      EXPECT_TRUE(std::binary_search(pairs.begin(), pairs.end(), TrianglePair{a, b})) << a << " and " << b;
    }
  }
  EXPECT_GT(crossings, 100);
  EXPECT_GT(static_cast<Index>(pairs.size()), crossings) << "those that only touch";
}

TEST(SelfIntersections, DoNotDependOnHowTheTrianglesAreWritten) {
  const Soup soup = wholeSoup(500, 12, 4);
  const std::size_t expected = pairsOf(soup).size();
  Soup turned = soup;
  for (std::size_t t = 0; t < turned.triangles.size(); ++t) {
    Triangle& corners = turned.triangles[t];
    std::rotate(corners.begin(), corners.begin() + static_cast<int>(t % 3), corners.end());
    if (t % 2 != 0) std::swap(corners[0], corners[1]);
  }
  std::reverse(turned.triangles.begin(), turned.triangles.end());
  EXPECT_EQ(pairsOf(turned).size(), expected);
  Soup moved = soup;
  for (Vec3& p : moved.vertices) p = Vec3(7 - p.z(), p.x() * 1.0, 3 + p.y()) * 0x1p-20;
  EXPECT_EQ(pairsOf(moved), pairsOf(soup));
  EXPECT_EQ(pairsOf(soup, 4), pairsOf(soup, 1));
}

// A closed surface that the noise makes cross itself.
Soup roughTorus(double noise, unsigned seed) {
  Soup soup = test::torus(60, 30);
  const std::vector<Vec3> shifts = test::randomCloud(soup.vertices.size(), seed);
  const double pi = std::acos(-1.0);
  for (Index c = 0; c < 60; ++c) {
    for (Index r = 0; r < 30; ++r) {
      const double u = 2 * pi * c / 60, v = 2 * pi * r / 30, ring = 3 + std::cos(v);
      soup.vertices[c * 30 + r] =
          Vec3(ring * std::cos(u), ring * std::sin(u), std::sin(v)) + noise * shifts[c * 30 + r];
    }
  }
  return soup;
}

TEST(SelfIntersections, TheMeshChangesNothingButTheTime) {
  for (const double noise : {0.0, 0.15, 0.3}) {
    const Soup soup = roughTorus(noise, 5);
    HalfEdgeMesh mesh;
    ASSERT_TRUE(buildMesh(soup.vertexCount(), soup.triangles, mesh));
    const Context context;
    const SelfIntersections search(soup.vertices, soup.triangles, context, &mesh);
    EXPECT_EQ(search.all(), pairsOf(soup));
    EXPECT_EQ(search.all().empty(), noise == 0.0);
  }
}

TEST(SelfIntersections, TheMeshTellsDoubledEdges) {
  // Two sheets of two triangles along one line: as a soup they share its edge, as a mesh each has its own.
  Soup soup{{{0, 0, 0}, {4, 0, 0}, {0, 4, 1}, {0, -4, 1}, {0, 0, 0}, {4, 0, 0}, {0, 4, -1}, {0, -4, -1}},
            {{0, 1, 2}, {1, 0, 3}, {5, 4, 6}, {4, 5, 7}}};
  EXPECT_TRUE(pairsOf(soup).empty());
  HalfEdgeMesh mesh;
  ASSERT_TRUE(buildMesh(soup.vertexCount(), soup.triangles, mesh));
  const auto pairs = SelfIntersections(soup.vertices, soup.triangles, Context(), &mesh).all();
  EXPECT_EQ(pairs, (std::vector<TrianglePair>{{0, 2}, {0, 3}, {1, 2}, {1, 3}}));
  soup.vertices[5] = {5, 0, 0};  // one corner alone is shared
  EXPECT_EQ(SelfIntersections(soup.vertices, soup.triangles, Context(), &mesh).count(), pairsOf(soup).size());
}

TEST(SelfIntersections, KnowsABorderFromAClosedFan) {
  // A spiral staircase around one vertex: every step faces up, but it turns more than once.
  Soup stairs;
  stairs.vertices.emplace_back(0, 0, 0);
  for (int i = 0; i < 12; ++i)
    stairs.vertices.emplace_back(std::cos(0.7 * i), std::sin(0.7 * i), 0.01 * i - 0.05);
  for (Index i = 1; i < 12; ++i) stairs.triangles.push_back({0, i, i + 1});
  HalfEdgeMesh mesh;
  ASSERT_TRUE(buildMesh(stairs.vertexCount(), stairs.triangles, mesh));
  const Context context;
  EXPECT_EQ(SelfIntersections(stairs.vertices, stairs.triangles, context, &mesh).all(), pairsOf(stairs));
}

TEST(SelfIntersections, OfSomeTrianglesAreTheirShareOfAll) {
  const Soup soup = roughTorus(0.2, 6);
  const Context context;
  const SelfIntersections search(soup.vertices, soup.triangles, context);
  const std::vector<TrianglePair> all = search.all();
  std::vector<Index> some;
  for (Index t = 0; t < static_cast<Index>(soup.triangles.size()); t += 7) some.push_back(t);
  std::vector<TrianglePair> expected;
  std::copy_if(all.begin(), all.end(), std::back_inserter(expected),
               [](const TrianglePair& pair) { return pair[0] % 7 == 0 || pair[1] % 7 == 0; });
  EXPECT_FALSE(expected.empty());
  EXPECT_EQ(search.involving(some), expected);
  some.insert(some.end(), some.begin(), some.end());
  EXPECT_EQ(search.involving(some), expected);
  EXPECT_TRUE(search.involving({}).empty());
}

TEST(SelfIntersections, FollowWhatTheyAreTold) {
  Soup soup = roughTorus(0.0, 6);
  HalfEdgeMesh mesh;
  ASSERT_TRUE(buildMesh(soup.vertexCount(), soup.triangles, mesh));
  const Context context;
  SelfIntersections search(soup.vertices, soup.triangles, context, &mesh);
  const Soup rough = roughTorus(0.3, 8);
  for (Index v = 0; v < soup.vertexCount(); v += 50) {
    std::vector<Index> changed;
    for (Index moved = v; moved < std::min(v + 5, soup.vertexCount()); ++moved) {
      soup.vertices[moved] = rough.vertices[moved];
      for (Index h = mesh.firstOutgoing(moved); h != kNone; h = mesh.nextOutgoing(h))
        changed.push_back(HalfEdgeMesh::triangleOf(h));
    }
    search.update(changed);
    if (v % 500 != 0) continue;
    EXPECT_EQ(search.all(), pairsOf(soup)) << v;
  }
  EXPECT_FALSE(search.all().empty());
  EXPECT_EQ(search.all(), pairsOf(soup));
}

TEST(SelfIntersections, AreInTheReportWhenAskedFor) {
  const Soup rough = roughTorus(0.2, 9);
  EXPECT_FALSE(reportMesh(rough.vertices, rough.triangles).self_intersections.has_value());
  const MeshReport report = reportMesh(rough.vertices, rough.triangles, Context());
  EXPECT_EQ(report.self_intersections, static_cast<std::int64_t>(pairsOf(rough).size()));
  Soup broken = rough;
  broken.triangles.push_back({0, 1, broken.vertexCount()});
  EXPECT_EQ(reportMesh(broken.vertices, broken.triangles, Context()).self_intersections,
            report.self_intersections);
}

}  // namespace
}  // namespace mlsmesh::core
