// SPDX-License-Identifier: BSD-3-Clause
#include "mlsmesh/mesh_topology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "mlsmesh/mesh_report.h"
#include "test_shapes.h"

namespace mlsmesh {
namespace {

using core::Index;
using core::Triangle;
using core::Vec3;
using test::Soup;

MeshTopology topologyOf(const Soup& soup) {
  return meshTopology(soup.vertices, soup.triangles);
}

/// A unit square in the plane z = 0, of two triangles.
Soup square() {
  return {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
}

TEST(MeshTopology, OfNothingIsNothing) {
  const MeshTopology t = meshTopology({}, {});
  EXPECT_EQ(t.vertices + t.triangles + t.edges + t.edge_components, 0);
  EXPECT_TRUE(t.components.empty());
  EXPECT_FALSE(t.isClosed());
  EXPECT_FALSE(t.isManifold());
  EXPECT_FALSE(t.genus.has_value());
}

TEST(MeshTopology, OfAClosedComponent) {
  const MeshTopology t = topologyOf(test::tetrahedron());
  ASSERT_EQ(t.components.size(), 1u);
  EXPECT_TRUE(t.isClosed());
  EXPECT_TRUE(t.isManifold());
  EXPECT_EQ(t.closed_components, 1);
  EXPECT_EQ(t.inward_components, 0);
  EXPECT_EQ(t.euler, 2);
  EXPECT_EQ(t.genus, 0);
  EXPECT_NEAR(t.components[0].volume, 1.0 / 6, 1e-15);
  EXPECT_NEAR(t.components[0].area, 1.5 + std::sqrt(3.0) / 2, 1e-15);
}

TEST(MeshTopology, OfAComponentThatIsInsideOut) {
  Soup soup = test::tetrahedron();
  for (Triangle& t : soup.triangles) std::swap(t[0], t[1]);
  const MeshTopology t = topologyOf(soup);
  EXPECT_EQ(t.inward_components, 1);
  EXPECT_EQ(t.orientation_conflicts, 0);
}

TEST(MeshTopology, GivesTheGenusOfEachComponentMostTrianglesFirst) {
  const MeshTopology t = topologyOf(together(test::openCylinder(5, 2), test::torus(6, 7)));
  ASSERT_EQ(t.components.size(), 2u);
  EXPECT_EQ(t.components[0].triangles, 84);
  EXPECT_EQ(t.components[0].genus(), 1);
  EXPECT_TRUE(t.components[0].isClosed());
  EXPECT_EQ(t.components[1].triangles, 20);
  EXPECT_EQ(t.components[1].genus(), 0);
  EXPECT_EQ(t.components[1].border_loops, 2);
  EXPECT_EQ(t.components[1].euler(), 0);
  EXPECT_EQ(t.genus, 1);
  ASSERT_EQ(t.borders.size(), 2u);
  EXPECT_EQ(t.borders[0].component, 1);
  EXPECT_EQ(t.borders[0].edges, 5);
  EXPECT_GE(t.borders[0].length, t.borders[1].length);
}

TEST(MeshTopology, MeasuresBorders) {
  const MeshTopology t = topologyOf(square());
  ASSERT_EQ(t.borders.size(), 1u);
  EXPECT_TRUE(t.borders[0].is_loop);
  EXPECT_EQ(t.borders[0].edges, 4);
  EXPECT_EQ(t.borders[0].length, 4);
}

TEST(MeshTopology, HoldsTogetherAtVerticesNotEdges) {
  const Soup bow_tie = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}}, {{0, 1, 2}, {0, 3, 4}}};
  const MeshTopology t = topologyOf(bow_tie);
  EXPECT_EQ(t.components.size(), 1u);
  EXPECT_EQ(t.edge_components, 2);
  EXPECT_EQ(t.bow_tie_vertices, 1);
  EXPECT_EQ(t.nonmanifold_vertices, 1);
  EXPECT_EQ(t.border_loops, 2) << "cut open at the pinch";
  EXPECT_FALSE(t.genus.has_value());
}

TEST(MeshTopology, OfThreePagesOfABook) {
  const Soup book = {{{0, 0, 0}, {0, 0, 2}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}},
                     {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}};
  const MeshTopology t = topologyOf(book);
  EXPECT_EQ(t.nonmanifold_edges, 1);
  EXPECT_EQ(t.nonmanifold_vertices, 2);
  EXPECT_EQ(t.bow_tie_vertices, 0);
  EXPECT_EQ(t.border_loops, 0);
  EXPECT_EQ(t.border_chains, 3);
  ASSERT_EQ(t.borders.size(), 3u);
  EXPECT_FALSE(t.borders[0].is_loop);
  EXPECT_NEAR(t.borders[0].length, 1 + std::sqrt(5.0), 1e-15);
}

TEST(MeshTopology, AFlippedFaceIsAConflictButLeavesTheGenus) {
  Soup soup = test::torus(5, 6);
  std::swap(soup.triangles[7][0], soup.triangles[7][1]);
  const MeshTopology t = topologyOf(soup);
  EXPECT_EQ(t.orientation_conflicts, 3);
  EXPECT_TRUE(t.orientable);
  EXPECT_EQ(t.genus, 1);
  EXPECT_EQ(t.inward_components, 0);
}

TEST(MeshTopology, AMoebiusBandIsNotOrientable) {
  const MeshTopology t = topologyOf(together(test::moebiusBand(9), test::octahedron()));
  EXPECT_FALSE(t.orientable);
  ASSERT_EQ(t.components.size(), 2u);
  EXPECT_FALSE(t.components[0].orientable);
  EXPECT_TRUE(t.components[1].orientable);
  EXPECT_FALSE(t.genus.has_value());
  EXPECT_EQ(t.components[1].genus(), 0);
}

TEST(MeshTopology, CountsVerticesAtOnePlace) {
  const MeshTopology t = topologyOf(together(square(), square()));
  EXPECT_EQ(t.coincident_vertices, 4);
  EXPECT_EQ(t.components.size(), 2u);
}

TEST(MeshTopology, CountsFacesWithoutAnArea) {
  const Soup soup = {{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {0, 0, 0}},
                     {{0, 1, 3}, {0, 1, 2}, {1, 1, 3}, {0, 4, 3}, {0, 1, 9}}};
  const MeshTopology t = topologyOf(soup);
  EXPECT_EQ(t.degenerate_faces, 4);
  EXPECT_EQ(t.triangles, 5);
}

/// What both count.
std::array<Index, 13> figuresOf(const MeshTopology& t) {
  return {t.vertices,
          t.triangles,
          t.isolated_vertices,
          t.edge_components,
          t.border_loops,
          t.border_edges,
          t.nonmanifold_edges,
          t.nonmanifold_vertices,
          t.euler,
          t.duplicate_faces,
          t.degenerate_faces,
          t.orientation_conflicts,
          t.genus.has_value()};
}
std::array<Index, 13> figuresOf(const MeshReport& r, const MeshTopology& t) {
  const bool has_genus = r.isManifold() && !t.components.empty() && t.orientable;
  return {r.vertices,     r.triangles,       r.isolated_vertices, r.components,
          r.border_loops, r.border_edges,    r.nonmanifold_edges, r.nonmanifold_vertices,
          r.euler,        r.duplicate_faces, r.degenerate_faces,  r.orientation_conflicts,
          has_genus};
}

TEST(MeshTopology, AgreesWithTheReportOnRandomSoups) {
  std::mt19937 random(5);
  for (int round = 0; round < 500; ++round) {
    const Index vertices = 4 + round % 7;
    Soup soup{test::randomCloud(static_cast<std::size_t>(vertices), 1), {}};
    std::uniform_int_distribution<Index> corner(0, vertices - 1);
    for (int i = 0; i < 2 + round % 9; ++i)
      soup.triangles.push_back({corner(random), corner(random), corner(random)});
    const MeshTopology t = topologyOf(soup);
    const MeshReport r = reportMesh(soup.vertices, soup.triangles);
    ASSERT_EQ(figuresOf(t), figuresOf(r, t)) << "round " << round;
    if (r.genus) {
      ASSERT_EQ(t.genus, r.genus) << "round " << round;
    }
    Index component_edges = 0;
    for (const ComponentTopology& component : t.components) component_edges += component.edges;
    ASSERT_EQ(component_edges, t.edges);
  }
}

/// Whether turning some triangles over leaves no conflict, found by trying all ways.
bool canBeOriented(const Soup& soup) {
  for (unsigned turned = 0; turned < 1U << soup.triangles.size(); ++turned) {
    Soup other = soup;
    for (std::size_t i = 0; i < soup.triangles.size(); ++i)
      if ((turned >> i & 1) != 0) std::swap(other.triangles[i][0], other.triangles[i][1]);
    if (topologyOf(other).orientation_conflicts == 0) return true;
  }
  return false;
}

TEST(MeshTopology, IsOrientableWhereSomeTurningOverHelps) {
  std::mt19937 random(6);
  int one_sided = 0;
  for (int round = 0; round < 150; ++round) {
    Soup soup = round % 2 == 0 ? test::moebiusBand(4) : test::openCylinder(4, 1);
    std::shuffle(soup.triangles.begin(), soup.triangles.end(), random);
    if (round % 3 == 0) soup.triangles.pop_back();
    for (Triangle& t : soup.triangles)
      if (random() % 2 == 0) std::swap(t[0], t[1]);
    const bool orientable = topologyOf(soup).orientable;
    ASSERT_EQ(orientable, canBeOriented(soup)) << "round " << round;
    one_sided += !orientable;
  }
  EXPECT_EQ(one_sided, 50) << "whole Moebius bands; one without a triangle is cut open";
}

std::int64_t intersectionsOf(const Soup& soup, int threads = 1) {
  core::Context context;
  context.threads = threads;
  return countSelfIntersections(soup.vertices, soup.triangles, context);
}

TEST(CountSelfIntersections, TakesAnySoup) {
  EXPECT_EQ(intersectionsOf({{}, {}}), 0);
  Soup crossing = together(square(), {{{0.5, 0.5, -1}, {0.5, 0.5, 1}, {0.9, 0.5, 0}}, {{0, 1, 2}}});
  EXPECT_EQ(intersectionsOf(crossing), 2) << "its edge goes through the diagonal of the square";
  crossing.triangles.push_back({0, 0, 1});
  crossing.triangles.push_back({0, 1, 77});
  crossing.triangles.push_back(crossing.triangles[0]);
  EXPECT_EQ(intersectionsOf(crossing), 3) << "the copy crosses, too; copies and degenerate faces are no pair";
}

TEST(CountSelfIntersections, IsTheSameFarFromTheOrigin) {
  Soup soup = test::torus(60, 60);
  for (std::size_t i = 0; i < soup.vertices.size(); i += 7) soup.vertices[i] += Vec3(0.25, 0.5, -0.25);
  for (Vec3& v : soup.vertices)
    for (int axis = 0; axis < 3; ++axis) v[axis] = std::round(v[axis] * 1024) / 1024;
  const std::int64_t near = intersectionsOf(soup);
  EXPECT_GT(near, 0);
  for (Vec3& v : soup.vertices) v += Vec3(500000, -5000000, 300);
  EXPECT_EQ(intersectionsOf(soup, 2), near);
}

}  // namespace
}  // namespace mlsmesh
