// SPDX-License-Identifier: BSD-3-Clause
#include "pinches.h"

#include <gtest/gtest.h>

#include <vector>

#include "test_shapes.h"

namespace mlsmesh::core {
namespace {

/// Open fans of `sizes` triangles that share vertex 0 alone.
HalfEdgeMesh fansAtOneVertex(const std::vector<Index>& sizes) {
  HalfEdgeMesh mesh(1);
  for (const Index size : sizes) {
    Index last = mesh.addVertex();
    for (Index i = 0; i < size; ++i) {
      const Index next = mesh.addVertex();
      mesh.addTriangle(0, last, next);
      last = next;
    }
  }
  return mesh;
}

TEST(Pinches, DropsSmallFansBesideALargerOne) {
  HalfEdgeMesh mesh = fansAtOneVertex({2, 5, 3});
  std::vector<Index> copies;
  const PinchCount count = resolvePinches(mesh, 3, &copies);
  EXPECT_EQ(count.dropped_triangles, 5);
  EXPECT_EQ(count.split_vertices, 0);
  EXPECT_TRUE(copies.empty());
  EXPECT_EQ(mesh.degree(0), 5);
  EXPECT_EQ(mesh.validate(), "");
}

TEST(Pinches, SplitsWhatIsTooLargeToDrop) {
  HalfEdgeMesh mesh = fansAtOneVertex({4, 6, 1});
  const Index vertices = mesh.vertexCount();
  std::vector<Index> copies;
  const PinchCount count = resolvePinches(mesh, 3, &copies);
  EXPECT_EQ(count.dropped_triangles, 1);
  EXPECT_EQ(count.split_vertices, 1);
  EXPECT_EQ(copies, std::vector<Index>{0});
  EXPECT_EQ(mesh.vertexCount(), vertices + 1);
  EXPECT_EQ(mesh.degree(0), 6);  // the largest fan keeps the vertex
  EXPECT_EQ(mesh.degree(vertices), 4);
  EXPECT_EQ(mesh.validate(), "");
}

TEST(Pinches, DropsAllWhereNothingMayBeSplit) {
  HalfEdgeMesh mesh = fansAtOneVertex({4, 6, 5});
  const PinchCount count = resolvePinches(mesh, 3, nullptr);
  EXPECT_EQ(count.dropped_triangles, 9);
  EXPECT_EQ(count.split_vertices, 0);
  EXPECT_EQ(mesh.degree(0), 6);
  EXPECT_EQ(mesh.validate(), "");
}

TEST(Pinches, ResolvesThoseThatDroppingMakes) {
  // The small fan at vertex 0, (0, 8, 9) and (0, 9, 10), holds the fan of vertex 9 together: four triangles
  // beyond edge 9-8, two beyond 9-10.
  HalfEdgeMesh mesh = fansAtOneVertex({6, 2});
  Index last = 8;
  for (int i = 0; i < 4; ++i) {
    const Index next = mesh.addVertex();
    ASSERT_NE(mesh.addTriangle(9, last, next), kNone);
    last = next;
  }
  last = 10;
  for (int i = 0; i < 2; ++i) {
    const Index next = mesh.addVertex();
    ASSERT_NE(mesh.addTriangle(last, 9, next), kNone);
    last = next;
  }
  ASSERT_EQ(mesh.fanCount(9), 1);
  const PinchCount count = resolvePinches(mesh, 3, nullptr);
  EXPECT_EQ(count.dropped_triangles, 4);
  EXPECT_EQ(mesh.degree(9), 4);
  EXPECT_EQ(mesh.validate(), "");
}

TEST(Pinches, LeavesASoundMeshAlone) {
  const test::Soup ring = test::openCylinder(12, 4);
  HalfEdgeMesh mesh;
  ASSERT_TRUE(buildMesh(ring.vertexCount(), ring.triangles, mesh));
  std::vector<Index> copies;
  const PinchCount count = resolvePinches(mesh, 3, &copies);
  EXPECT_EQ(count.dropped_triangles, 0);
  EXPECT_EQ(count.split_vertices, 0);
  EXPECT_EQ(mesh.triangles(), ring.triangles);
}

}  // namespace
}  // namespace mlsmesh::core
