// SPDX-License-Identifier: BSD-3-Clause
#include "known_neighbors.h"

#include <gtest/gtest.h>

#include <random>

namespace mlsmesh::core {
namespace {

std::vector<Vec3> randomPoints(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  std::vector<Vec3> points(count);
  for (Vec3& p : points) p = {coordinate(random), coordinate(random), coordinate(random)};
  return points;
}

TEST(KnownNeighbors, FollowThePoints) {
  KnownNeighbors known;
  std::vector<Vec3> points = randomPoints(500, 1);
  const auto expectRight = [&](int k) {
    const NeighborTable& table = known.of(points, k, {});
    const NeighborTable expected = nearestOfAll(points, *makeKdTree(points), k, {});
    EXPECT_EQ(table.k, expected.k);
    EXPECT_EQ(table.indices, expected.indices);
  };
  expectRight(12);
  expectRight(12);
  expectRight(5);
  points[250] *= 1.5;  // one moved
  expectRight(5);
  points.pop_back();
  expectRight(5);
  points = randomPoints(4, 2);
  expectRight(5);
  points.clear();
  expectRight(5);
}

TEST(KnownNeighbors, AreNotAskedForTwice) {
  KnownNeighbors known;
  const std::vector<Vec3> points = randomPoints(100, 3), same = points;
  const Index* const first = known.of(points, 8, {}).row(0);
  EXPECT_EQ(known.of(same, 8, {}).row(0), first);
}

TEST(KdTreeOver, FindsWhatTheCopyingTreeFinds) {
  const std::vector<Vec3> points = randomPoints(2000, 4);
  const auto copying = makeKdTree(points), looking = makeKdTreeOver(points);
  EXPECT_EQ(nearestOfAll(points, *looking, 20, {}).indices, nearestOfAll(points, *copying, 20, {}).indices);
}

}  // namespace
}  // namespace mlsmesh::core
