// SPDX-License-Identifier: BSD-3-Clause
#include "mlsmesh/core/neighbor_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "mlsmesh/core/failure.h"
#include "test_shapes.h"

namespace mlsmesh::core {
namespace {

using test::lattice;
using test::randomCloud;
using Points = std::vector<Vec3>;

struct Distribution {
  std::string name;
  Points points;
};

Points changed(Points points, const std::function<Vec3(const Vec3&)>& change) {
  std::transform(points.begin(), points.end(), points.begin(), change);
  return points;
}

Points clusters(std::size_t count) {
  const Points centers = randomCloud(7, 11);
  const Points offsets = randomCloud(count, 12);
  Points points(count);
  for (std::size_t i = 0; i < count; ++i) points[i] = centers[i % 7] + 1e-4 * offsets[i];
  return points;
}

/// Gaps that halve from point to point: the deepest tree a k-d tree by midpoints can get.
Points halvingGaps(int count) {
  Points points;
  for (int i = 0; i < count; ++i) points.emplace_back(std::ldexp(1.0, -i), 0, 0);
  return points;
}

std::vector<Distribution> distributions() {
  const Points random = randomCloud(700, 1);
  return {
      {"random", random},
      {"lattice", lattice(8)},
      {"shifted lattice",
       changed(lattice(7), [](const Vec3& p) -> Vec3 { return 0.1 * p + Vec3(0.3, -0.7, 0.9); })},
      {"clusters", clusters(600)},
      {"line", changed(random, [](const Vec3& p) { return Vec3(p.x(), 2 * p.x(), -p.x()); })},
      {"plane", changed(random, [](const Vec3& p) { return Vec3(p.x(), p.y(), 0); })},
      {"far away", changed(random, [](const Vec3& p) -> Vec3 { return p + Vec3(5e6, -4e5, 1e3); })},
      {"tiny", changed(random, [](const Vec3& p) -> Vec3 { return 1e-30 * p; })},
      {"huge", changed(random, [](const Vec3& p) -> Vec3 { return 1e30 * p; })},
      {"halving gaps", halvingGaps(300)},
      {"all equal", Points(100, Vec3(0.1, 0.2, 0.3))},
      {"three points", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
      {"one point", {{1, 2, 3}}},
  };
}

using Ranked = std::pair<double, Index>;

double squaredDistance(const Vec3& a, const Vec3& b) {
  const double x = a.x() - b.x(), y = a.y() - b.y(), z = a.z() - b.z();
  return x * x + y * y + z * z;
}

std::vector<Ranked> bruteForce(const Points& points, const Vec3& query, int k) {
  std::vector<Ranked> all;
  for (std::size_t i = 0; i < points.size(); ++i)
    all.emplace_back(squaredDistance(query, points[i]), static_cast<Index>(i));
  std::sort(all.begin(), all.end());
  all.resize(std::min<std::size_t>(all.size(), k));
  return all;
}

std::vector<Ranked> searched(const NeighborSearch& search, const Vec3& query, int k) {
  std::vector<Index> indices(k, kNone);
  std::vector<double> distances(k, -1);
  const int found = search.nearest(query, k, indices.data(), distances.data());
  std::vector<Ranked> result;
  for (int i = 0; i < found; ++i) result.emplace_back(distances[i], indices[i]);
  return result;
}

/// The points, midpoints of pairs of them (ties), and places outside the cloud.
Points queriesFor(const Points& points) {
  Points queries = points;
  for (std::size_t i = 0; i + 1 < points.size(); i += 3) queries.push_back(0.5 * (points[i] + points[i + 1]));
  const Vec3 reach = points.back() - points.front();
  for (const double far : {-1.0, 3.0, 1e3}) queries.push_back(points.front() + far * reach);
  return queries;
}

TEST(KdTree, AgreesWithBruteForceTiesIncluded) {
  for (const Distribution& cloud : distributions()) {
    const auto tree = makeKdTree(cloud.points);
    ASSERT_EQ(tree->size(), static_cast<Index>(cloud.points.size()));
    for (const int k : {1, 2, 7, 20, 64})
      for (const Vec3& query : queriesFor(cloud.points))
        ASSERT_EQ(searched(*tree, query, k), bruteForce(cloud.points, query, k))
            << cloud.name << ", k = " << k;
  }
}

TEST(KdTree, ReturnsAllPointsWhenAskedForMore) {
  const Points points = randomCloud(10, 3);
  const auto tree = makeKdTree(points);
  EXPECT_EQ(searched(*tree, points[4], 50), bruteForce(points, points[4], 10));
}

TEST(KdTree, AnswersNothingWithoutPointsOrWithoutRoom) {
  EXPECT_TRUE(searched(*makeKdTree({}), Vec3::Zero(), 5).empty());
  EXPECT_TRUE(searched(*makeKdTree({{0, 0, 0}}), Vec3::Zero(), 0).empty());
}

TEST(KdTree, OutlivesThePointsItWasBuiltFrom) {
  auto points = std::make_unique<Points>(randomCloud(500, 5));
  const Points copy = *points;
  const auto tree = makeKdTree(*points);
  points.reset();
  EXPECT_EQ(searched(*tree, copy[17], 9), bruteForce(copy, copy[17], 9));
}

TEST(NearestOfAll, ListsTheNearestOthersOfEveryPoint) {
  for (const Distribution& cloud : distributions()) {
    const auto tree = makeKdTree(cloud.points);
    const NeighborTable table = nearestOfAll(cloud.points, *tree, 9, {});
    ASSERT_EQ(table.k, std::min<int>(9, static_cast<int>(cloud.points.size()) - 1)) << cloud.name;
    for (Index i = 0; i < tree->size(); ++i) {
      std::vector<Ranked> expected = bruteForce(cloud.points, cloud.points[i], tree->size());
      expected.erase(
          std::find_if(expected.begin(), expected.end(), [&](const Ranked& r) { return r.second == i; }));
      for (int j = 0; j < table.k; ++j) ASSERT_EQ(table.row(i)[j], expected[j].second) << cloud.name;
    }
  }
}

TEST(NearestOfAll, IsTheSameForAnyNumberOfThreads) {
  const Points points = randomCloud(20000, 8);
  const auto tree = makeKdTree(points);
  Context one, many;
  one.threads = 1;
  many.threads = 7;
  EXPECT_EQ(nearestOfAll(points, *tree, 12, one).indices, nearestOfAll(points, *tree, 12, many).indices);
}

TEST(NearestOfAll, OfOnePointOrNoneIsEmpty) {
  EXPECT_EQ(nearestOfAll({{0, 0, 0}}, *makeKdTree({{0, 0, 0}}), 4, {}).k, 0);
  EXPECT_EQ(nearestOfAll({}, *makeKdTree({}), 4, {}).k, 0);
}

/// A search that finds one point fewer than it should.
class ForgetfulSearch : public NeighborSearch {
 public:
  explicit ForgetfulSearch(const Points& points) : tree_(makeKdTree(points)) {}
  Index size() const override { return tree_->size(); }
  int nearest(const Vec3& query, int k, Index* indices, double* squared_distances) const override {
    return tree_->nearest(query, k, indices, squared_distances) - 1;
  }

 private:
  std::unique_ptr<NeighborSearch> tree_;
};

TEST(NearestOfAll, RefusesASearchThatReturnsTooFew) {
  const Points points = randomCloud(30, 4);
  EXPECT_THROW(nearestOfAll(points, ForgetfulSearch(points), 5, {}), Failure);
}

TEST(Spacing, OfALatticeIsItsStep) {
  const int side = 9;
  const double step = 0.125;
  const Points points = changed(lattice(side), [&](const Vec3& p) -> Vec3 { return step * p; });
  const auto tree = makeKdTree(points);
  EXPECT_EQ(medianSpacing(points, *tree, {}), step);
  const std::vector<double> spacing = localSpacings(points, nearestOfAll(points, *tree, 12, {}), {});
  const int center = (side * side * side) / 2;
  EXPECT_EQ(spacing[center], step);
  EXPECT_GT(spacing[0], step) << "a corner has three neighbours at one step, then diagonals";
}

TEST(Spacing, IsNotMovedByAFewOutliers) {
  Points points = lattice(12);
  for (int i = 0; i < 100; ++i) points.emplace_back(1e4 * (i + 1), 0, 0);
  EXPECT_EQ(medianSpacing(points, *makeKdTree(points), {}), 1.0);
}

TEST(Spacing, ScalesWithTheCloud) {
  const Points points = randomCloud(3000, 21);
  const double spacing = medianSpacing(points, *makeKdTree(points), {});
  const Points scaled = changed(points, [](const Vec3& p) -> Vec3 { return 1024 * p; });
  EXPECT_EQ(medianSpacing(scaled, *makeKdTree(scaled), {}), 1024 * spacing);
}

TEST(Spacing, SamplesLargeCloudsEvenly) {
  Points points = lattice(31);
  for (Vec3& point : points)
    if (point.x() > 20) point += 3 * (point - Vec3(20, 0, 0));
  ASSERT_GT(points.size(), 20000u);
  EXPECT_EQ(medianSpacing(points, *makeKdTree(points), {}), 1.0) << "two thirds of the points are one apart";
}

TEST(Spacing, OfFewPoints) {
  EXPECT_EQ(medianSpacing({{0, 0, 0}}, *makeKdTree({{0, 0, 0}}), {}), 0);
  const Points two = {{0, 0, 0}, {0, 3, 4}};
  const auto tree = makeKdTree(two);
  EXPECT_EQ(medianSpacing(two, *tree, {}), 5);
  EXPECT_EQ(localSpacings(two, nearestOfAll(two, *tree, 16, {}), {}), (std::vector<double>{5, 5}));
}

}  // namespace
}  // namespace mlsmesh::core
