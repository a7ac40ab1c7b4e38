// SPDX-License-Identifier: BSD-3-Clause
#include "triangle_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "test_shapes.h"

namespace mlsmesh::core {
namespace {

const Vec3 kO(0, 0, 0), kX(4, 0, 0), kY(0, 4, 0);

TEST(SquaredDistance, OfEachPartOfATriangle) {
  const auto distance = [](const Vec3& point) { return squaredDistance(point, kO, kX, kY); };
  EXPECT_EQ(distance({1, 1, 3}), 9) << "above the inside";
  EXPECT_EQ(distance({1, 1, 0}), 0) << "in it";
  EXPECT_EQ(distance({-3, -4, 0}), 25) << "beyond a corner";
  EXPECT_EQ(distance({2, -3, 4}), 25) << "beyond a side";
  EXPECT_DOUBLE_EQ(distance({3, 3, 0}), 2) << "beyond the slanted side";
  EXPECT_EQ(distance({7, 0, -4}), 25);
}

TEST(SquaredDistance, OfDegenerateTriangles) {
  EXPECT_EQ(squaredDistance({2, 3, 0}, kO, kX, {1, 0, 0}), 9) << "a segment";
  EXPECT_EQ(squaredDistance({9, 0, 0}, kO, {1, 0, 0}, kX), 25);
  EXPECT_EQ(squaredDistance({0, 3, 4}, kO, kO, kO), 25) << "a point";
}

TEST(TriangleTree, FindsWhatTryingAllFinds) {
  std::mt19937 random(3);
  std::uniform_int_distribution<Index> corner(0, 59);
  for (const std::size_t count : {1u, 2u, 3u, 4u, 5u, 17u, 300u}) {
    const std::vector<Vec3> vertices = test::randomCloud(60, 7);
    std::vector<Triangle> triangles(count);
    for (Triangle& t : triangles) t = {corner(random), corner(random), corner(random)};
    const TriangleTree tree(vertices, triangles);
    for (Vec3 query : test::randomCloud(200, 8)) {
      query *= 2;
      double best = std::numeric_limits<double>::infinity();
      for (const auto& [a, b, c] : triangles)
        best = std::min(best, squaredDistance(query, vertices[a], vertices[b], vertices[c]));
      const TriangleTree::Nearest found = tree.nearest(query);
      EXPECT_EQ(found.squared_distance, best) << count;
      const auto [a, b, c] = triangles.at(static_cast<std::size_t>(found.triangle));
      EXPECT_EQ(squaredDistance(query, vertices[a], vertices[b], vertices[c]), best);
      const auto hint = static_cast<Index>(random() % count);
      EXPECT_EQ(tree.nearest(query, hint).squared_distance, best) << count << ", hint " << hint;
    }
  }
  const std::vector<Vec3> nothing;
  const std::vector<Triangle> none;
  EXPECT_TRUE(TriangleTree(nothing, none).empty());
}

}  // namespace
}  // namespace mlsmesh::core
