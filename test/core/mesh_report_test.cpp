// SPDX-License-Identifier: BSD-3-Clause
#include "mlsmesh/mesh_report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "test_shapes.h"

namespace mlsmesh {
namespace {

using core::Index;
using core::Triangle;
using core::Vec3;
using test::Soup;

MeshReport report(const Soup& soup) {
  return reportMesh(soup.vertices, soup.triangles);
}

/// A soup whose corners are in general position, for figures that do not depend on where they are.
Soup abstractSoup(Index vertices, std::vector<Triangle> triangles) {
  return {test::randomCloud(vertices, 1), std::move(triangles)};
}

TEST(MeshReport, OfNothingIsNothing) {
  const MeshReport empty = reportMesh({}, {});
  EXPECT_EQ(empty.vertices + empty.triangles + empty.components + empty.euler + empty.border_loops, 0);
  EXPECT_FALSE(empty.genus.has_value());
}

TEST(MeshReport, OfASphere) {
  const MeshReport r = report(test::octahedron());
  EXPECT_TRUE(r.isSound());
  EXPECT_EQ(r.components, 1);
  EXPECT_EQ(r.border_loops, 0);
  EXPECT_EQ(r.border_edges, 0);
  EXPECT_EQ(r.euler, 2);
  EXPECT_EQ(r.genus, 0);
}

TEST(MeshReport, OfATorus) {
  const MeshReport r = report(test::torus(7, 5));
  EXPECT_TRUE(r.isSound());
  EXPECT_EQ(r.euler, 0);
  EXPECT_EQ(r.genus, 1);
}

TEST(MeshReport, OfAnOpenCylinder) {
  const MeshReport r = report(test::openCylinder(8, 3));
  EXPECT_TRUE(r.isSound());
  EXPECT_EQ(r.border_loops, 2);
  EXPECT_EQ(r.border_edges, 16);
  EXPECT_EQ(r.euler, 0);
  EXPECT_EQ(r.genus, 0);
}

TEST(MeshReport, OfADisc) {
  const MeshReport r = report(test::grid(4, 6));
  EXPECT_TRUE(r.isSound());
  EXPECT_EQ(r.border_loops, 1);
  EXPECT_EQ(r.border_edges, 20);
  EXPECT_EQ(r.euler, 1);
  EXPECT_EQ(r.genus, 0);
}

TEST(MeshReport, OfATriangle) {
  const MeshReport r = report(abstractSoup(3, {{0, 1, 2}}));
  EXPECT_TRUE(r.isSound());
  EXPECT_EQ(r.border_loops, 1);
  EXPECT_EQ(r.euler, 1);
}

TEST(MeshReport, SumsComponents) {
  const MeshReport r =
      report(together(test::torus(6, 6), together(test::octahedron(), test::openCylinder(5, 2))));
  EXPECT_TRUE(r.isSound());
  EXPECT_EQ(r.components, 3);
  EXPECT_EQ(r.border_loops, 2);
  EXPECT_EQ(r.euler, 0 + 2 + 0);
  EXPECT_EQ(r.genus, 1);
}

TEST(MeshReport, OfAMoebiusBandHasNoGenusButOneBorder) {
  const MeshReport r = report(test::moebiusBand(9));
  EXPECT_TRUE(r.isManifold());
  EXPECT_EQ(r.orientation_conflicts, 1) << "only the seam is run in the same direction from both sides";
  EXPECT_EQ(r.border_loops, 1);
  EXPECT_EQ(r.border_edges, 18);
  EXPECT_EQ(r.euler, 0);
  EXPECT_FALSE(r.genus.has_value());
  EXPECT_FALSE(r.isSound());
}

TEST(MeshReport, OfABowTieCutsItsBorderApart) {
  const MeshReport r = report(abstractSoup(5, {{0, 1, 2}, {0, 3, 4}}));
  EXPECT_EQ(r.nonmanifold_vertices, 1);
  EXPECT_EQ(r.nonmanifold_edges, 0);
  EXPECT_EQ(r.components, 2) << "a shared vertex does not connect";
  EXPECT_EQ(r.border_loops, 2);
  EXPECT_FALSE(r.genus.has_value());
}

TEST(MeshReport, OfTwoSpheresThatTouch) {
  Soup soup = together(test::tetrahedron(), test::tetrahedron());
  for (Triangle& t : soup.triangles) std::replace(t.begin(), t.end(), 7, 0);
  const MeshReport r = report(soup);
  EXPECT_EQ(r.nonmanifold_vertices, 1) << "two closed fans are a pinch, too";
  EXPECT_EQ(r.isolated_vertices, 1);
  EXPECT_EQ(r.border_loops, 0);
  EXPECT_EQ(r.euler, 3);
}

TEST(MeshReport, OfTwoTetrahedraWithACommonEdge) {
  Soup soup = together(test::tetrahedron(), test::tetrahedron());
  for (Triangle& t : soup.triangles) {
    std::replace(t.begin(), t.end(), 4, 0);
    std::replace(t.begin(), t.end(), 5, 1);
  }
  const MeshReport r = report(soup);
  EXPECT_EQ(r.nonmanifold_edges, 1);
  EXPECT_EQ(r.nonmanifold_vertices, 2) << "both ends of the edge";
  EXPECT_EQ(r.components, 1);
  EXPECT_EQ(r.border_edges, 0);
  EXPECT_EQ(r.euler, 6 - 11 + 8);
  EXPECT_FALSE(r.genus.has_value());
}

TEST(MeshReport, OfThreePagesOfABookHasNoBorderLoop) {
  const MeshReport r = report(abstractSoup(5, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}));
  EXPECT_EQ(r.nonmanifold_edges, 1);
  EXPECT_EQ(r.border_edges, 6);
  EXPECT_EQ(r.border_loops, 0) << "each page's border is a chain from spine to spine";
}

TEST(MeshReport, OfAFlippedFaceCountsItsEdges) {
  Soup soup = test::octahedron();
  std::swap(soup.triangles[3][0], soup.triangles[3][1]);
  const MeshReport r = report(soup);
  EXPECT_EQ(r.orientation_conflicts, 3);
  EXPECT_TRUE(r.isManifold());
  EXPECT_FALSE(r.genus.has_value());
}

TEST(MeshReport, OfADuplicateFaceInAnyOrder) {
  for (const Triangle& again : {Triangle{0, 2, 4}, Triangle{4, 0, 2}, Triangle{2, 0, 4}}) {
    Soup soup = test::octahedron();
    soup.triangles.push_back(again);
    const MeshReport r = report(soup);
    EXPECT_EQ(r.duplicate_faces, 1);
    EXPECT_EQ(r.nonmanifold_edges, 3);
    EXPECT_EQ(r.nonmanifold_vertices, 3);
  }
  EXPECT_EQ(report(abstractSoup(3, {{0, 1, 2}, {1, 2, 0}, {2, 1, 0}, {0, 2, 1}})).duplicate_faces, 3);
}

TEST(MeshReport, LeavesOutFacesWithoutThreeCorners) {
  for (const Triangle& bad : {Triangle{1, 1, 2}, Triangle{3, 0, 3}, Triangle{0, 1, 6}, Triangle{-1, 0, 1}}) {
    Soup soup = test::octahedron();
    soup.triangles.push_back(bad);
    const MeshReport r = report(soup);
    EXPECT_EQ(r.degenerate_faces, 1);
    EXPECT_EQ(r.triangles, 9);
    EXPECT_EQ(r.euler, 2);
    EXPECT_TRUE(r.isManifold());
    EXPECT_FALSE(r.isSound());
  }
}

TEST(MeshReport, DoesNotCountIsolatedVertices) {
  Soup soup = test::octahedron();
  soup.vertices.insert(soup.vertices.begin() + 3, Vec3(9, 9, 9));
  soup.vertices.emplace_back(8, 8, 8);
  for (Triangle& t : soup.triangles)
    for (Index& corner : t) corner += corner >= 3;
  const MeshReport r = report(soup);
  EXPECT_EQ(r.vertices, 8);
  EXPECT_EQ(r.isolated_vertices, 2);
  EXPECT_EQ(r.euler, 2);
  EXPECT_EQ(r.genus, 0);
}

Index degenerateFaces(const Vec3& a, const Vec3& b, const Vec3& c) {
  return reportMesh({a, b, c}, {{0, 1, 2}}).degenerate_faces;
}

TEST(MeshReportDegenerate, IsExactCollinearity) {
  const double ulp = std::numeric_limits<double>::epsilon();
  EXPECT_EQ(degenerateFaces({0, 0, 0}, {1, 1, 1}, {3, 3, 3}), 1);
  EXPECT_EQ(degenerateFaces({0, 0, 0}, {0, 0, 0}, {1, 2, 3}), 1) << "two corners at one place";
  EXPECT_EQ(degenerateFaces({0, 0, 0}, {0, 0, 0}, {0, 0, 0}), 1);
  EXPECT_EQ(degenerateFaces({1, 1, 0}, {2, 2, 0}, {3, 3 + 2 * ulp, 0}), 0)
      << "one unit in the last place off the line";
  EXPECT_EQ(degenerateFaces({1, 1, 0}, {2, 2, 0}, {3, 3, 1e-300}), 0);
  EXPECT_EQ(degenerateFaces({0.1, 0.1, 5}, {0.3, 0.3, 5}, {0.7, 0.7, 5}), 1)
      << "x = y whatever the doubles are";
  const double third = 1.0 / 3;
  EXPECT_EQ(degenerateFaces({0, 0, 0}, {third, 2 * third, 4 * third}, {8 * third, 16 * third, 32 * third}),
            1);
}

TEST(MeshReportDegenerate, HoldsAtAnyScale) {
  for (const double scale : {1e-300, 1e-160, 1e-30, 1.0, 1e30, 1e160, 1e300}) {
    EXPECT_EQ(degenerateFaces(scale * Vec3(1, 2, 4), scale * Vec3(2, 4, 8), scale * Vec3(4, 8, 16)), 1)
        << scale;
    EXPECT_EQ(degenerateFaces(scale * Vec3(1, 2, 4), scale * Vec3(2, 4, 8), scale * Vec3(4, 8, 15)), 0)
        << scale;
  }
}

TEST(MeshReportDegenerate, IsAFaceThatIsNotFinite) {
  EXPECT_EQ(degenerateFaces({0, 0, 0}, {1, 0, 0}, {0, std::numeric_limits<double>::quiet_NaN(), 0}), 1);
  EXPECT_EQ(degenerateFaces({0, 0, 0}, {1, 0, 0}, {0, std::numeric_limits<double>::infinity(), 0}), 1);
}

TEST(MeshReportDegenerate, DoesNotTouchTopology) {
  const Soup flat = {{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  const MeshReport r = report(flat);
  EXPECT_EQ(r.degenerate_faces, 1);
  EXPECT_EQ(r.euler, 1);
  EXPECT_EQ(r.border_loops, 1);
}

bool operator==(const MeshReport& a, const MeshReport& b) {
  const auto figures = [](const MeshReport& r) {
    return std::array<Index, 12>{
        r.vertices,     r.triangles,       r.isolated_vertices,     r.components,
        r.border_loops, r.border_edges,    r.nonmanifold_edges,     r.nonmanifold_vertices,
        r.euler,        r.duplicate_faces, r.orientation_conflicts, r.degenerate_faces};
  };
  return figures(a) == figures(b) && a.genus == b.genus;
}

TEST(MeshReport, DoesNotDependOnNamesOrOrder) {
  std::mt19937 random(17);
  for (int round = 0; round < 200; ++round) {
    const Index vertices = 5 + round % 6;
    std::vector<Triangle> triangles(3 + round % 12);
    std::uniform_int_distribution<Index> corner(0, vertices - 1);
    for (Triangle& t : triangles) t = {corner(random), corner(random), corner(random)};
    const Soup soup = abstractSoup(vertices, triangles);

    std::vector<Index> name(vertices);
    for (Index v = 0; v < vertices; ++v) name[v] = v;
    std::shuffle(name.begin(), name.end(), random);
    Soup other = soup;
    for (Index v = 0; v < vertices; ++v) other.vertices[name[v]] = soup.vertices[v];
    for (Triangle& t : other.triangles) t = {name[t[1]], name[t[2]], name[t[0]]};
    std::shuffle(other.triangles.begin(), other.triangles.end(), random);
    ASSERT_TRUE(report(soup) == report(other)) << "round " << round;
  }
}

}  // namespace
}  // namespace mlsmesh
