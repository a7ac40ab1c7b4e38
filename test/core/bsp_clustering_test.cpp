// SPDX-License-Identifier: BSD-3-Clause
#include "mlsmesh/core/bsp_clustering.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <chrono>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "mlsmesh/core/failure.h"
#include "surfaces.h"
#include "test_shapes.h"

namespace mlsmesh::core {
namespace {

using test::Points;

constexpr double kFlattest = 1.0 / 3;  // no cluster has a larger variation, so none is split for it

std::vector<Index> membersOf(const IndexLists& clusters, Index cluster) {
  return {clusters.data(cluster), clusters.data(cluster) + clusters.size(cluster)};
}

double variationOf(const Points& points, const std::vector<Index>& members) {
  Vec3 mean = Vec3::Zero();
  for (const Index i : members) mean += points[i];
  mean /= static_cast<double>(members.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Index i : members) covariance += (points[i] - mean) * (points[i] - mean).transpose();
  const Vec3 values = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvalues();
  return values.sum() > 0 ? std::max(values[0], 0.0) / values.sum() : 0;
}

std::vector<Points> clouds() {
  return {test::evenSample("torus", 0.08), test::randomCloud(3000, 3), test::lattice(12),
          test::planeLattice(60, 40), test::randomSample(*shapes::makeShape("figure"), 3000)};
}

std::vector<ClusteringParameters> variants() {
  ClusteringParameters printed, shifted;
  printed.split_plane = SplitPlane::RegressionPlane;
  printed.split_rule = SplitRule::SizeAndVariation;
  printed.max_gap = 0;
  shifted.min_leaf = 1;
  shifted.max_variation = 0;
  return {{}, printed, shifted};
}

TEST(BspClustering, PutsEveryPointInOneCluster) {
  for (const Points& points : clouds()) {
    for (const ClusteringParameters& parameters : variants()) {
      const IndexLists clusters = clusterPoints(points, parameters, {});
      std::vector<int> seen(points.size(), 0);
      for (Index c = 0; c < clusters.count(); ++c) {
        const std::vector<Index> members = membersOf(clusters, c);
        ASSERT_FALSE(members.empty());
        EXPECT_TRUE(std::is_sorted(members.begin(), members.end()));
        for (const Index i : members) ++seen[i];
      }
      EXPECT_EQ(seen, std::vector<int>(points.size(), 1));
    }
  }
}

TEST(BspClustering, LeavesNoClusterThatIsLargeOrCurvedUnlessItCannotBeCut) {
  const ClusteringParameters parameters;
  for (const Points& points : clouds()) {
    const IndexLists clusters = clusterPoints(points, parameters, {});
    for (Index c = 0; c < clusters.count(); ++c) {
      EXPECT_LE(clusters.size(c), parameters.max_size);
      if (clusters.size(c) < 2 * parameters.min_leaf) continue;  // one side would be below min_leaf
      EXPECT_LE(variationOf(points, membersOf(clusters, c)), parameters.max_variation + 1e-9);
    }
  }
}

TEST(BspClustering, SplitsNothingThatIsSmallAndFlat) {
  ClusteringParameters parameters;
  parameters.max_gap = 0;
  EXPECT_EQ(clusterPoints(test::planeLattice(11, 1), parameters, {}).count(), 1);
  EXPECT_EQ(clusterPoints(test::planeLattice(12, 1), parameters, {}).count(), 2);
  parameters.max_variation = kFlattest;
  parameters.max_size = 27;
  EXPECT_EQ(clusterPoints(test::lattice(3), parameters, {}).count(), 1);
  parameters.max_variation = 0.3;  // a cube's is 1/3
  EXPECT_GT(clusterPoints(test::lattice(3), parameters, {}).count(), 1);
}

TEST(BspClustering, WithTheRuleAndSplitsOnlyWhatIsLargeAndCurved) {
  ClusteringParameters parameters;
  parameters.split_rule = SplitRule::SizeAndVariation;
  parameters.max_gap = 0;
  EXPECT_EQ(clusterPoints(test::planeLattice(60, 40), parameters, {}).count(), 1);
  for (const Points& points : clouds()) {
    const IndexLists clusters = clusterPoints(points, parameters, {});
    for (Index c = 0; c < clusters.count(); ++c) {
      const bool flat = variationOf(points, membersOf(clusters, c)) <= parameters.max_variation + 1e-9;
      EXPECT_TRUE(clusters.size(c) <= parameters.max_size || flat);
    }
  }
  EXPECT_GT(clusterPoints(test::evenSample("torus", 0.08), parameters, {}).count(), 10);
}

TEST(BspClustering, LeavesNoSideBelowTheMinimum) {
  for (const int min_leaf : {1, 2, 3, 5, 20}) {
    ClusteringParameters parameters;
    parameters.min_leaf = min_leaf;
    parameters.max_gap = 0;
    for (const Points& points : clouds()) {
      const IndexLists clusters = clusterPoints(points, parameters, {});
      for (Index c = 0; c < clusters.count(); ++c) {
        EXPECT_GE(clusters.size(c), min_leaf);
        EXPECT_LE(clusters.size(c), std::max(parameters.max_size, 2 * min_leaf - 1));
      }
    }
  }
}

TEST(BspClustering, EndsAtIdenticalPoints) {
  Points points(100, Vec3(0.1, 0.2, 0.3));
  EXPECT_EQ(clusterPoints(points, {}, {}).count(), 1);
  points.insert(points.end(), 50, Vec3(0.1, 0.2, 0.4));
  const IndexLists clusters = clusterPoints(points, {}, {});
  ASSERT_EQ(clusters.count(), 2);
  EXPECT_EQ(std::minmax(clusters.size(0), clusters.size(1)), std::minmax(Index{50}, Index{100}));
}

TEST(BspClustering, KnowsClustersOfOneAndNone) {
  EXPECT_EQ(clusterPoints({}, {}, {}).count(), 0);
  EXPECT_EQ(clusterPoints({{1, 2, 3}}, {}, {}).count(), 1);
}

/// Two layers of 6 x 3 points, nearer to each other than the points of a layer.
Points layers() {
  Points points;
  for (const double z : {0.0, 0.5})
    for (int x = 0; x < 6; ++x)
      for (int y = 0; y < 3; ++y) points.emplace_back(x, y, z);
  return points;
}

TEST(BspClustering, CutsAcrossTheLargestSpread) {
  ClusteringParameters parameters;
  parameters.max_variation = kFlattest;
  parameters.max_size = 18;
  const Points points = layers();
  const IndexLists clusters = clusterPoints(points, parameters, {});
  ASSERT_EQ(clusters.count(), 2);
  for (Index c = 0; c < 2; ++c)
    for (const Index i : membersOf(clusters, c))
      EXPECT_EQ(points[i].x() < 2.5, points[clusters.data(c)[0]].x() < 2.5);
}

TEST(BspClustering, CutsAlongTheRegressionPlaneAsPrinted) {
  ClusteringParameters parameters;
  parameters.split_plane = SplitPlane::RegressionPlane;
  parameters.max_variation = kFlattest;
  parameters.max_size = 18;
  const Points points = layers();
  const IndexLists clusters = clusterPoints(points, parameters, {});
  ASSERT_EQ(clusters.count(), 2);
  for (Index c = 0; c < 2; ++c)
    for (const Index i : membersOf(clusters, c)) EXPECT_EQ(points[i].z(), points[clusters.data(c)[0]].z());
}

/// Two rows of four points, one unit apart in a row, with `gap` units between the rows' ends.
Points twoRows(double gap) {
  Points points;
  for (int i = 0; i < 4; ++i) points.emplace_back(i, 0, 0);
  for (int i = 0; i < 4; ++i) points.emplace_back(3 + gap + i, 0, 0);
  return points;
}

TEST(BspClustering, CutsALeafAtItsGap) {
  ClusteringParameters parameters;
  parameters.max_gap = 8;
  EXPECT_EQ(clusterPoints(twoRows(7.9), parameters, {}).count(), 1);
  const IndexLists clusters = clusterPoints(twoRows(8.1), parameters, {});
  ASSERT_EQ(clusters.count(), 2);
  EXPECT_EQ(membersOf(clusters, 0), (std::vector<Index>{0, 1, 2, 3}));
  EXPECT_EQ(membersOf(clusters, 1), (std::vector<Index>{4, 5, 6, 7}));
  parameters.max_gap = 0;
  EXPECT_EQ(clusterPoints(twoRows(100), parameters, {}).count(), 1);
}

TEST(BspClustering, DoesNotDependOnThreadsOrOrder) {
  const Points world = test::randomSample(*shapes::makeShape("figure"), 20000);
  Context one = test::withThreads(1), four = test::withThreads(4);
  const PointSet set = makePointSet(world, StoredAs::Float, nullptr, one);
  const PointSet other = makePointSet(test::shuffled(world, 9), StoredAs::Float, nullptr, four);
  for (const ClusteringParameters& parameters : variants()) {
    const IndexLists expected = clusterPoints(set.position, parameters, one);
    for (int round = 0; round < 3; ++round) {
      const IndexLists clusters = clusterPoints(other.position, parameters, four);
      EXPECT_EQ(clusters.begin, expected.begin);
      EXPECT_EQ(clusters.items, expected.items);
    }
  }
}

TEST(BspClustering, CanBeCancelled) {
  Context context;
  context.progress.cancel();
  try {
    clusterPoints(test::randomCloud(1000, 1), {}, context);
    FAIL() << "was not cancelled";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), StatusCode::Cancelled);
  }
}

TEST(BspClustering, LeavesNothingHalfDoneWhenCancelled) {
  const Points points = test::randomCloud(200000, 1);
  for (const int delay : {1, 5, 20}) {
    Context context = test::withThreads(1);
    std::thread other([handle = context.progress, delay]() mutable {
      std::this_thread::sleep_for(std::chrono::milliseconds(delay));
      handle.cancel();
    });
    try {
      const IndexLists clusters = clusterPoints(points, {}, context);
      for (Index c = 0; c < clusters.count(); ++c)
        EXPECT_LE(clusters.size(c), ClusteringParameters().max_size);
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.code(), StatusCode::Cancelled);
    }
    other.join();
  }
}

}  // namespace
}  // namespace mlsmesh::core
