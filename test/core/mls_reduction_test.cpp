// SPDX-License-Identifier: BSD-3-Clause
#include "mlsmesh/core/mls_reduction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "mlsmesh/core/bsp_clustering.h"
#include "surfaces.h"
#include "test_shapes.h"

namespace mlsmesh::core {
namespace {

using test::Cloud;
using test::Points;

/// Both clamp rules with the default projection and the paper's.
struct Variant {
  ProjectionParameters projection;
  ReductionParameters reduction;
};

std::vector<Variant> variants() {
  std::vector<Variant> all;
  for (const ClampRule clamp : {ClampRule::Guarded, ClampRule::FiniteOnly}) {
    for (const ProjectionParameters& projection : {defaultPreset().projection, paperPreset().projection}) {
      Variant& variant = all.emplace_back();
      variant.projection = projection;
      variant.reduction.clamp = clamp;
    }
  }
  return all;
}

/// Two parallel sheets so near to each other that every neighbourhood holds points of both, and a thin rod.
Points sheetsAndRod() {
  Points points = test::randomCloud(3000, 5);
  for (std::size_t i = 0; i < 2000; ++i) points[i].z() = i % 2 == 0 ? 0 : 0.02;
  for (std::size_t i = 2000; i < points.size(); ++i) {
    points[i].y() *= 0.01;
    points[i].z() = 0.01 * points[i].z() + 1;
  }
  return points;
}

std::vector<Points> clouds() {
  return {test::evenSample("torus", 0.07), sheetsAndRod(), test::randomCloud(1500, 6),
          test::noisy(test::evenSample("sphere", 0.07), 0.03)};
}

IndexLists singletons(Index count) {
  IndexLists lists;
  for (Index i = 0; i < count; ++i) {
    lists.items.push_back(i);
    lists.begin.push_back(i + 1);
  }
  return lists;
}

Vec3 centroidOf(const Points& points, const IndexLists& clusters, Index cluster) {
  Vec3 sum = Vec3::Zero();
  for (Index i = 0; i < clusters.size(cluster); ++i) sum += points[clusters.data(cluster)[i]];
  return sum / clusters.size(cluster);
}

double radiusOf(const Points& points, const IndexLists& clusters, Index cluster, const Vec3& center) {
  double radius = 0;
  for (Index i = 0; i < clusters.size(cluster); ++i)
    radius = std::max(radius, (points[clusters.data(cluster)[i]] - center).norm());
  return radius;
}

TEST(MlsReduction, GivesEveryClusterOneSoundRepresentative) {
  for (const Points& world : clouds()) {
    const Cloud cloud(world);
    for (const Variant& variant : variants()) {
      IndexLists clusters = clusterPoints(cloud.points.position, {}, {});
      const IndexLists before = clusters;
      const Representatives all =
          reducePoints(cloud.points, cloud.surface(variant.projection), clusters, variant.reduction, {});
      const std::size_t count = static_cast<std::size_t>(before.count());
      ASSERT_EQ(all.position.size(), count);
      EXPECT_EQ(clusters.items, before.items);
      EXPECT_EQ(clusters.begin, before.begin);
      EXPECT_EQ(all.normal.size(), count);
      EXPECT_EQ(all.variation.size(), count);
      EXPECT_EQ(all.spacing.size(), count);
      EXPECT_EQ(all.nearest.size(), count);
      EXPECT_EQ(all.kind.size(), count);
      for (std::size_t i = 0; i < count; ++i) {
        EXPECT_TRUE(all.position[i].allFinite());
        EXPECT_NEAR(all.normal[i].norm(), 1, 1e-9);
        EXPECT_GE(all.variation[i], 0);
        EXPECT_LE(all.variation[i], 1.0 / 3 + 1e-9);
        EXPECT_GT(all.spacing[i], 0);
      }
    }
  }
}

TEST(MlsReduction, StaysWithinHalfTheCluster) {
  int projected = 0, fallen_back = 0;
  for (const Points& world : clouds()) {
    const Cloud cloud(world);
    const Points& points = cloud.points.position;
    IndexLists clusters = clusterPoints(points, {}, {});
    const Representatives all = reducePoints(cloud.points, cloud.surface(), clusters, {}, {});
    for (Index c = 0; c < clusters.count(); ++c) {
      const Index* members = clusters.data(c);
      if (all.kind[c] == VertexKind::InputPoint) {
        ++fallen_back;
        const auto is_it = [&](Index i) { return points[i] == all.position[c] && i == all.nearest[c]; };
        EXPECT_TRUE(std::any_of(members, members + clusters.size(c), is_it));
        continue;
      }
      ++projected;
      const Vec3 center = centroidOf(points, clusters, c);
      const double reach = std::max(0.5 * radiusOf(points, clusters, c, center), 0.3 * all.spacing[c]);
      double off = (all.position[c] - center).norm();
      // Where the centroid lies off the points the projection starts from a member.
      for (Index i = 0; i < clusters.size(c); ++i)
        off = std::min(off, (all.position[c] - points[members[i]]).norm());
      EXPECT_LE(off, reach * (1 + 1e-9));
    }
  }
  EXPECT_GT(projected, 1000);
  EXPECT_GT(fallen_back, 0);  // the clouds are meant to need the clamp
}

TEST(MlsReduction, StartsFromAMemberWhereTheCentroidIsOff) {
  // Two planes one above the other; one cluster takes two points of each, so that its centroid is midway.
  Points world;
  for (const double z : {0.0, 20.0})
    for (const Vec3& p : test::planeLattice(12, 12)) world.push_back(p + Vec3(0, 0, z));
  const Cloud cloud(world);
  IndexLists clusters;
  for (Index i = 0; i < cloud.points.size(); ++i) {
    const Vec3 p = cloud.points.world(cloud.points.position[i]);
    if (p.x() == 5 && (p.y() == 5 || p.y() == 6)) clusters.items.push_back(i);
  }
  clusters.begin.push_back(4);
  ASSERT_EQ(clusters.items.size(), 4u);
  const Representatives all = reducePoints(cloud.points, cloud.surface(), clusters, {}, {});
  const double z = cloud.points.world(all.position[0]).z();
  EXPECT_NEAR(std::min(std::abs(z), std::abs(z - 20)), 0, 1e-9);
}

TEST(MlsReduction, RoundsToTheTypeThatIsStored) {
  test::Similarity motion;
  motion.shift = Vec3(431000.25, 5240000.5, 300);  // as in a map; floats are 0.03 to 0.5 apart there
  motion.scale = 500;
  const Points world = motion(test::evenSample("torus", 0.07));
  for (const StoredAs stored_as : {StoredAs::Float, StoredAs::Double}) {
    const Cloud cloud(world, stored_as);
    IndexLists clusters = clusterPoints(cloud.points.position, {}, {});
    const Representatives all = reducePoints(cloud.points, cloud.surface(), clusters, {}, {});
    for (const Vec3& p : all.position) EXPECT_EQ(cloud.points.stored(p), p);
    if (stored_as == StoredAs::Double) continue;
    for (const Vec3& p : all.position)
      EXPECT_EQ(test::asFloats(cloud.points.world(p)), cloud.points.world(p));
  }
}

TEST(MlsReduction, KeepsCoincidentRepresentativesOnce) {
  // Three layers one unit in the last place apart: most columns project to the middle one.
  constexpr double kUnit = 1.0 / 16384;  // of floats at 1000
  Points world;
  for (const Vec3& p : test::planeLattice(12, 12))
    for (int layer = 0; layer < 3; ++layer) world.push_back(p + Vec3(0, 0, 1000 + layer * kUnit));
  const Cloud cloud(world, StoredAs::Float);
  ASSERT_EQ(cloud.points.size(), 3 * 144);
  IndexLists clusters = singletons(cloud.points.size());
  const Representatives all = reducePoints(cloud.points, cloud.surface(), clusters, {}, {});
  const std::size_t count = all.position.size();
  EXPECT_GE(count, 144u);
  EXPECT_LE(count, 200u);
  EXPECT_EQ(all.normal.size(), count);
  EXPECT_EQ(all.variation.size(), count);
  EXPECT_EQ(all.spacing.size(), count);
  EXPECT_EQ(all.nearest.size(), count);
  EXPECT_EQ(all.kind.size(), count);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(all.position[i], all.position[j]);

  ASSERT_EQ(clusters.count(), all.size());
  std::vector<int> seen(static_cast<std::size_t>(cloud.points.size()), 0);
  for (Index c = 0; c < clusters.count(); ++c) {
    const Index* members = clusters.data(c);
    EXPECT_TRUE(std::is_sorted(members, members + clusters.size(c)));
    EXPECT_TRUE(c == 0 || clusters.data(c - 1)[0] < members[0]);  // the first of those that coincide stays
    for (Index i = 0; i < clusters.size(c); ++i) {
      ++seen[members[i]];
      EXPECT_LT((cloud.points.position[members[i]] - all.position[c]).norm(), 3 * kUnit);
    }
  }
  EXPECT_EQ(seen, std::vector<int>(seen.size(), 1));
}

TEST(MlsReduction, SeesHowFlatTheSurroundingsAre) {
  const auto largest_variation = [](const Points& world) {
    const Cloud cloud(world);
    IndexLists clusters = clusterPoints(cloud.points.position, {}, {});
    const Representatives all = reducePoints(cloud.points, cloud.surface(), clusters, {}, {});
    return *std::max_element(all.variation.begin(), all.variation.end());
  };
  EXPECT_LT(largest_variation(test::planeLattice(30, 30)), 1e-12);
  EXPECT_GT(largest_variation(test::lattice(10)), 0.1);
}

TEST(MlsReduction, NamesThePointNearestToEachRepresentative) {
  const Cloud cloud(test::evenSample("torus", 0.07));
  IndexLists clusters = clusterPoints(cloud.points.position, {}, {});
  const Representatives all = reducePoints(cloud.points, cloud.surface(), clusters, {}, {});
  for (Index i = 0; i < all.size(); ++i) {
    Index nearest;
    double squared;
    cloud.search->nearest(all.position[i], 1, &nearest, &squared);
    EXPECT_EQ(all.nearest[i], nearest);
  }
}

TEST(MlsReduction, DoesNotDependOnThreadsOrOrder) {
  const Points world = sheetsAndRod();
  const Cloud cloud(world), other(test::shuffled(world, 3));
  for (const Variant& variant : variants()) {
    IndexLists clusters = clusterPoints(cloud.points.position, {}, {}), other_clusters = clusters;
    const Representatives one = reducePoints(cloud.points, cloud.surface(variant.projection), clusters,
                                             variant.reduction, test::withThreads(1));
    const Representatives four = reducePoints(other.points, other.surface(variant.projection), other_clusters,
                                              variant.reduction, test::withThreads(4));
    EXPECT_EQ(one.position, four.position);
    EXPECT_EQ(one.normal, four.normal);
    EXPECT_EQ(one.variation, four.variation);
    EXPECT_EQ(one.nearest, four.nearest);
    EXPECT_EQ(clusters.items, other_clusters.items);
  }
}

}  // namespace
}  // namespace mlsmesh::core
