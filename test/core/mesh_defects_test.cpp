// SPDX-License-Identifier: BSD-3-Clause
#include "mlsmesh/mesh_defects.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "mlsmesh/mesh_distance.h"
#include "mlsmesh/mesh_topology.h"
#include "test_shapes.h"

namespace mlsmesh {
namespace {

using core::Index;
using core::Triangle;
using core::Vec3;
using test::Soup;

MeshDefects defectsOf(const Soup& soup) {
  return findDefects(soup.vertices, soup.triangles, core::Context());
}

TEST(MeshDefects, ASoundMeshHasNone) {
  EXPECT_TRUE(defectsOf(test::tetrahedron()).empty());
  EXPECT_TRUE(defectsOf({}).empty());
}

TEST(MeshDefects, NamesEachKind) {
  Soup soup{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {2, 0, 0}}, {}};
  soup.triangles = {{0, 1, 2}, {1, 0, 3}, {1, 0, 4}, {2, 1, 0}, {0, 0, 1}, {0, 1, 5}, {0, 1, 9}};
  const MeshDefects defects = defectsOf(soup);
  EXPECT_EQ(defects.degenerate_faces, (std::vector<Index>{4, 5, 6}));
  EXPECT_EQ(defects.duplicate_faces, (std::vector<Index>{3}));
  EXPECT_EQ(defects.nonmanifold_edges, (std::vector<MeshEdge>{{0, 1}}));
  EXPECT_EQ(defects.nonmanifold_vertices.size(), 2U);
}

TEST(MeshDefects, NamesTrianglesThatCross) {
  const Soup soup{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 1}, {2, 1, 1}, {9, 9, 9}, {9, 8, 9}},
                  {{5, 6, 7}, {0, 1, 2}, {3, 4, 5}}};
  const MeshDefects defects = defectsOf(soup);
  EXPECT_EQ(defects.crossing_faces, (std::vector<Index>{1, 2}));
  EXPECT_EQ(defects.self_intersections, 1);
}

TEST(MeshDefects, TurnedTrianglesConflict) {
  Soup soup = test::tetrahedron();
  std::swap(soup.triangles[0][0], soup.triangles[0][1]);
  EXPECT_EQ(defectsOf(soup).orientation_conflicts.size(), 3U);
}

TEST(MeshBorders, ComeApartAtPinchesAndTheLongestFirst) {
  // A square of side 2 without its last triangle, and one that touches it at a corner alone.
  const Soup soup{{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {3, 2, 0}, {2, 3, 0}}, {{0, 1, 2}, {2, 3, 4}}};
  const std::vector<BorderEdges> borders = findBorders(soup.vertices, soup.triangles);
  ASSERT_EQ(borders.size(), 2U);
  EXPECT_NEAR(borders[0].length, 4 + std::sqrt(8.0), 1e-12);
  EXPECT_EQ(borders[0].edges, (std::vector<MeshEdge>{{0, 1}, {2, 0}, {1, 2}}));
  EXPECT_TRUE(borders[0].is_loop);
}

/// Triangles over few vertices: every defect, many times.
Soup randomSoup(unsigned seed) {
  std::mt19937 random(seed);
  Soup soup;
  for (int v = 0; v < 12; ++v) soup.vertices.emplace_back(random() % 4, random() % 4, random() % 4);
  for (int t = 0; t < 30; ++t) {
    const auto corner = [&] { return static_cast<Index>(random() % 12); };
    soup.triangles.push_back({corner(), corner(), corner()});
  }
  return soup;
}

TEST(MeshDefects, AreAsManyAsAreCounted) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    const Soup soup = randomSoup(seed);
    const MeshDefects defects = defectsOf(soup);
    const MeshTopology counted = meshTopology(soup.vertices, soup.triangles);
    const auto size = [](const auto& list) { return static_cast<Index>(list.size()); };
    EXPECT_EQ(size(defects.nonmanifold_edges), counted.nonmanifold_edges);
    EXPECT_EQ(size(defects.nonmanifold_vertices), counted.nonmanifold_vertices);
    EXPECT_EQ(size(defects.orientation_conflicts), counted.orientation_conflicts);
    EXPECT_EQ(size(defects.degenerate_faces), counted.degenerate_faces);
    EXPECT_EQ(size(defects.duplicate_faces), counted.duplicate_faces);
    EXPECT_EQ(defects.self_intersections,
              countSelfIntersections(soup.vertices, soup.triangles, core::Context()));
    const std::vector<BorderEdges> borders = findBorders(soup.vertices, soup.triangles);
    ASSERT_EQ(borders.size(), counted.borders.size());
    for (std::size_t i = 0; i < borders.size(); ++i) {
      EXPECT_EQ(borders[i].is_loop, counted.borders[i].is_loop);
      EXPECT_EQ(size(borders[i].edges), counted.borders[i].edges);
    }
  }
}

TEST(MeshDistance, OfPointsOneByOne) {
  const Soup soup = test::tetrahedron();
  const std::vector<double> distances =
      distancesFromMesh({{0.2, 0.2, -1}, {0.2, 0.2, 0}}, {soup.vertices, soup.triangles}, core::Context());
  EXPECT_EQ(distances, (std::vector<double>{1, 0}));
}

}  // namespace
}  // namespace mlsmesh
