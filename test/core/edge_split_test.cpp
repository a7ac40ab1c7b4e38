// SPDX-License-Identifier: BSD-3-Clause
#include "edge_split.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "surfaces.h"
#include "test_shapes.h"

namespace mlsmesh::core {
namespace {

using test::Points;

constexpr double kNoFoldGuard = -1;

/// A mesh, its edges, and a rounding that leaves doubles alone.
struct Splitting {
  Points position;
  HalfEdgeMesh mesh;
  std::vector<Index> edge_of;
  std::vector<SplitEdge> edges;
  PointSet rounding;
  Context context;

  Splitting(const Points& vertices, const std::vector<Triangle>& triangles) : position(vertices) {
    rounding.stored_as = StoredAs::Double;
    EXPECT_TRUE(buildMesh(static_cast<Index>(vertices.size()), triangles, mesh));
    edge_of.resize(3 * triangles.size());
    for (Index h = 0; h < 3 * mesh.slotCount(); ++h) {
      const Index g = mesh.twin(h);
      if (g != kNone && g < h) {
        edge_of[h] = edge_of[g];
        continue;
      }
      edge_of[h] = static_cast<Index>(edges.size());
      SplitEdge& edge = edges.emplace_back();
      edge.half_edge = h;
      edge.midpoint = edge.position = 0.5 * (position[mesh.origin(h)] + position[mesh.target(h)]);
    }
  }

  SplitEdge& edge(Index u, Index v) {
    const Index h = mesh.find(u, v);
    return edges[edge_of[h == kNone ? mesh.find(v, u) : h]];
  }

  std::vector<Triangle> byTemplates(double fold_angle = kNoFoldGuard) {
    return splitByTemplates(mesh, position, edge_of, fold_angle, rounding, context, edges);
  }
  std::vector<Triangle> oneByOne(double min_ratio, double fold_angle = kNoFoldGuard) {
    return splitOneByOne(mesh, position, min_ratio, fold_angle, rounding, edges);
  }

  Index markedCount() const {
    return static_cast<Index>(
        std::count_if(edges.begin(), edges.end(), [](const SplitEdge& e) { return e.marked; }));
  }
  /// The old vertices and those of the edges that stayed marked, in their order.
  Points finerPositions() const {
    Points finer = position;
    for (const SplitEdge& e : edges)
      if (e.marked) finer.push_back(e.position);
    return finer;
  }
};

double areaOf(const Points& points, const std::vector<Triangle>& triangles) {
  double area = 0;
  for (const auto& [a, b, c] : triangles)
    area += 0.5 * (points[b] - points[a]).cross(points[c] - points[a]).norm();
  return area;
}

Vec3 normalOf(const Points& points, const Triangle& t) {
  return (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]).normalized();
}

/// A plane grid of `side` x `side` quads.
Splitting plane(Index side) {
  const test::Soup shape = test::grid(side, side);
  return {test::planeLattice(side + 1, side + 1), shape.triangles};
}

Splitting oneTriangle() {
  return {{{0, 0, 0}, {4, 0, 0}, {1, 2, 0}}, {{0, 1, 2}}};
}

TEST(EdgeSplit, DividesOneTriangleByTemplate) {
  for (int pattern = 0; pattern < 8; ++pattern) {
    Splitting split = oneTriangle();
    for (int i = 0; i < 3; ++i) split.edge(i, (i + 1) % 3).marked = (pattern >> i & 1) != 0;
    const Index marked = split.markedCount();
    const std::vector<Triangle> children = split.byTemplates();
    const Points points = split.finerPositions();
    EXPECT_EQ(static_cast<Index>(children.size()), 1 + marked);
    EXPECT_EQ(static_cast<Index>(points.size()), 3 + marked);
    EXPECT_NEAR(areaOf(points, children), 4, 1e-12);
    for (const Triangle& child : children) EXPECT_NEAR(normalOf(points, child).z(), 1, 1e-12);
  }
}

TEST(EdgeSplit, CutsTheQuadAlongItsShorterDiagonal) {
  Splitting split = oneTriangle();
  split.edge(1, 2).marked = split.edge(2, 0).marked = true;
  // Midpoints (2.5, 1) and (0.5, 1): from 0 to the first it is 2.69, from 1 to the second 3.64.
  const std::vector<Triangle> children = split.byTemplates();
  const Points points = split.finerPositions();
  HalfEdgeMesh mesh;
  ASSERT_TRUE(buildMesh(5, children, mesh));
  const Index on_12 = points[3].x() > points[4].x() ? 3 : 4;
  EXPECT_TRUE(mesh.find(0, on_12) != kNone || mesh.find(on_12, 0) != kNone);
}

TEST(EdgeSplit, KeepsTheTopologyForAnyMarks) {
  std::mt19937 random(3);
  const test::Soup ring = test::torus(9, 7), band = test::openCylinder(9, 4);
  for (const test::Soup& soup : {ring, band}) {
    const MeshReport before = reportMesh(soup.vertices, soup.triangles);
    for (int round = 0; round < 20; ++round) {
      Splitting split(soup.vertices, soup.triangles);
      for (SplitEdge& e : split.edges) e.marked = random() % 4 < static_cast<unsigned>(round % 5);
      Index expected = before.triangles;
      for (const SplitEdge& e : split.edges)
        expected += e.marked ? (split.mesh.isBorder(e.half_edge) ? 1 : 2) : 0;
      Splitting sequential = split;
      for (const bool templates : {true, false}) {
        Splitting& work = templates ? split : sequential;
        const std::vector<Triangle> triangles = templates ? work.byTemplates() : work.oneByOne(0);
        const MeshReport report = reportMesh(work.finerPositions(), triangles);
        test::expectSound(report);
        EXPECT_EQ(report.triangles, expected);
        EXPECT_EQ(report.isolated_vertices, 0);
        EXPECT_EQ(report.euler, before.euler);
        EXPECT_EQ(report.border_loops, before.border_loops);
        EXPECT_EQ(report.components, 1);
      }
    }
  }
}

TEST(EdgeSplit, CoversAPlaneOnce) {
  for (const bool templates : {true, false}) {
    Splitting split = plane(6);
    for (std::size_t e = 0; e < split.edges.size(); ++e) split.edges[e].marked = e % 3 != 0;
    const std::vector<Triangle> triangles = templates ? split.byTemplates() : split.oneByOne(0);
    const Points points = split.finerPositions();
    EXPECT_NEAR(areaOf(points, triangles), 36, 1e-12);
    for (const Triangle& t : triangles) EXPECT_GT(normalOf(points, t).z(), 0);
  }
}

TEST(EdgeSplit, PullsInAVertexThatTurnsAChildTooFar) {
  // Triangles on both sides of edge 0-1, each of height 1. A new vertex h above the midpoint turns the four
  // children by atan(h) and more: by 68 degrees for h = 2.5 and 51 for half of it.
  const Points diamond = {{-2, 0, 0}, {2, 0, 0}, {0, 1, 0}, {0, -1, 0}};
  const std::vector<Triangle> two = {{0, 1, 2}, {1, 0, 3}};
  const auto pulled = [&](double height, double fold_angle) {
    Splitting split(diamond, two);
    SplitEdge& edge = split.edge(0, 1);
    edge.marked = true;
    edge.position.z() = height;
    const std::vector<Triangle> triangles = split.byTemplates(fold_angle);
    EXPECT_EQ(triangles.size(), 4u);
    const Points points = split.finerPositions();
    for (const Triangle& t : triangles)
      EXPECT_TRUE(fold_angle < 0 || normalOf(points, t).z() >= std::cos(fold_angle * 0.0174532925199433));
    EXPECT_EQ(edge.kind, edge.position.z() == height ? VertexKind::Projected : VertexKind::FoldGuarded);
    return edge.position.z();
  };
  EXPECT_EQ(pulled(0.5, 60), 0.5);
  EXPECT_EQ(pulled(2.5, kNoFoldGuard), 2.5);
  EXPECT_EQ(pulled(2.5, 60), 1.25);
  EXPECT_EQ(pulled(5, 60), 1.25);
  EXPECT_EQ(pulled(50, 60), 0);
}

TEST(EdgeSplit, PullsInAVertexThatFoldsOver) {
  const Points diamond = {{-2, 0, 0}, {2, 0, 0}, {0, 1, 0}, {0, -1, 0}};
  for (const bool templates : {true, false}) {
    Splitting split(diamond, {{0, 1, 2}, {1, 0, 3}});
    SplitEdge& edge = split.edge(0, 1);
    edge.marked = true;
    edge.position.y() = 1.5;  // beyond vertex 2: two children lie upside down
    const std::vector<Triangle> triangles = templates ? split.byTemplates(60) : split.oneByOne(0, 60);
    EXPECT_EQ(edge.position.y(), 0.75);
    EXPECT_NEAR(areaOf(split.finerPositions(), triangles), 4, 1e-12);
  }
}

TEST(EdgeSplit, NeverMakesADegenerateChild) {
  const Points diamond = {{-2, 0, 0}, {2, 0, 0}, {0, 1, 0}, {0, -1, 0}};
  for (const bool templates : {true, false}) {
    Splitting split(diamond, {{0, 1, 2}, {1, 0, 3}});
    SplitEdge& edge = split.edge(0, 1);
    edge.marked = true;
    edge.position = {1, 0.5, 0};  // on the side from 1 to 2
    const std::vector<Triangle> triangles =
        templates ? split.byTemplates(kNoFoldGuard) : split.oneByOne(0, kNoFoldGuard);
    test::expectSound(reportMesh(split.finerPositions(), triangles));
  }
}

TEST(EdgeSplit, OneByOneLeavesThinTrianglesWhole) {
  const Points needle = {{0, 0, 0}, {10, 0, 0}, {10, 0.5, 0}};  // ratio 0.05
  Splitting split(needle, {{0, 1, 2}});
  for (SplitEdge& e : split.edges) e.marked = true;
  EXPECT_EQ(split.oneByOne(0.1).size(), 1u);
  EXPECT_EQ(split.markedCount(), 0);
  for (SplitEdge& e : split.edges) e.marked = true;
  EXPECT_GT(split.oneByOne(0.01).size(), 1u);
}

}  // namespace
}  // namespace mlsmesh::core
