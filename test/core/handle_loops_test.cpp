// SPDX-License-Identifier: BSD-3-Clause
#include "handle_loops.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "test_shapes.h"

namespace mlsmesh::core {
namespace {

using Loop = std::vector<Index>;

HalfEdgeMesh meshOf(const test::Soup& soup) {
  HalfEdgeMesh mesh;
  EXPECT_TRUE(buildMesh(soup.vertexCount(), soup.triangles, mesh));
  return mesh;
}

// Pieces that the mesh falls into when it is cut along the walk.
int piecesAlong(const HalfEdgeMesh& mesh, const Loop& walk) {
  std::set<std::pair<Index, Index>> cut;
  for (std::size_t i = 0; i < walk.size(); ++i) {
    const Index a = walk[i], b = walk[(i + 1) % walk.size()];
    cut.insert({a, b});
    cut.insert({b, a});
  }
  std::vector<char> seen(static_cast<std::size_t>(mesh.slotCount()), 0);
  int pieces = 0;
  for (Index start = 0; start < mesh.slotCount(); ++start) {
    if (seen[start]) continue;
    ++pieces;
    std::vector<Index> open = {start};
    seen[start] = 1;
    while (!open.empty()) {
      const Index t = open.back();
      open.pop_back();
      for (Index h = 3 * t; h < 3 * t + 3; ++h) {
        if (mesh.isBorder(h) || cut.count({mesh.origin(h), mesh.target(h)}) != 0) continue;
        const Index other = HalfEdgeMesh::triangleOf(mesh.twin(h));
        if (!seen[other]) open.push_back(other);
        seen[other] = 1;
      }
    }
  }
  return pieces;
}

void expectWalks(const HalfEdgeMesh& mesh, const std::vector<Loop>& walks, std::size_t most) {
  for (const Loop& walk : walks) {
    ASSERT_GE(walk.size(), 3u);
    EXPECT_LE(walk.size(), most);
    EXPECT_EQ(std::set<Index>(walk.begin(), walk.end()).size(), walk.size());
    for (std::size_t i = 0; i < walk.size(); ++i) {
      const Index a = walk[i], b = walk[(i + 1) % walk.size()];
      EXPECT_TRUE(mesh.find(a, b) != kNone || mesh.find(b, a) != kNone);
    }
    EXPECT_EQ(piecesAlong(mesh, walk), 1);
  }
}

TEST(HandleLoops, GoRoundTheTubeOfATorus) {
  for (const Index rows : {4, 7, 10}) {
    const test::Soup soup = test::torus(24, rows);
    const HalfEdgeMesh mesh = meshOf(soup);
    const auto walks = shortHandleLoops(mesh, soup.vertices, 12);
    ASSERT_FALSE(walks.empty());
    expectWalks(mesh, walks, static_cast<std::size_t>(rows));
    EXPECT_EQ(walks[0].size(), static_cast<std::size_t>(rows));
    EXPECT_TRUE(shortHandleLoops(mesh, soup.vertices, rows - 1).empty());
  }
}

TEST(HandleLoops, AreNoneOnSurfacesWithoutHandles) {
  // The loops of a cylinder are capped: a walk round it divides it.
  for (const test::Soup& soup : {test::octahedron(), test::grid(9, 9), test::openCylinder(5, 9),
                                 test::together(test::tetrahedron(), test::openCylinder(4, 6))}) {
    EXPECT_TRUE(shortHandleLoops(meshOf(soup), soup.vertices, 60).empty());
  }
}

TEST(HandleLoops, SeeEveryHandleOfSeveralComponents) {
  const test::Soup one = test::torus(30, 5), both = test::together(one, test::torus(12, 6));
  const HalfEdgeMesh mesh = meshOf(both);
  const auto walks = shortHandleLoops(mesh, both.vertices, 8);
  bool in_first = false, in_second = false;
  for (const Loop& walk : walks) (walk[0] < one.vertexCount() ? in_first : in_second) = true;
  EXPECT_TRUE(in_first && in_second);
  for (const Loop& walk : walks) EXPECT_EQ(piecesAlong(mesh, walk), 2);  // the components
}

TEST(HandleLoops, AreThoseOfATorusWithAHole) {
  test::Soup soup = test::torus(20, 6);
  soup.triangles.erase(soup.triangles.begin() + 30, soup.triangles.begin() + 34);
  const HalfEdgeMesh mesh = meshOf(soup);
  const auto walks = shortHandleLoops(mesh, soup.vertices, 8);
  ASSERT_FALSE(walks.empty());
  expectWalks(mesh, walks, 8);
}

}  // namespace
}  // namespace mlsmesh::core
