// SPDX-License-Identifier: BSD-3-Clause
#include "troubled_places.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "mlsmesh/core/bsp_clustering.h"
#include "mlsmesh/core/multiresolution.h"
#include "surfaces.h"

namespace mlsmesh::core {
namespace {

TEST(TroubledPlaces, AreTheVerticesAndTheirNeighbours) {
  Triangulation triangulation;
  triangulation.triangles = {{0, 1, 2}, {2, 1, 3}, {4, 5, 6}, {7, 3, 4}};
  triangulation.duplicate_of = {6};  // vertex 7 is a copy of point 6
  triangulation.troubled = {0, 7};
  const std::vector<char> expected = {1, 1, 1, 1, 1, 1, 1};
  EXPECT_EQ(aroundTrouble(triangulation, 7), expected);
  triangulation.troubled = {0};
  EXPECT_EQ(aroundTrouble(triangulation, 7), (std::vector<char>{1, 1, 1, 0, 0, 0, 0}));
}

TEST(TroubledPlaces, AreClusteredFiner) {
  const test::Points points = test::randomSample(*shapes::makeShape("torus"), 3000);
  const ClusteringParameters parameters;
  const Context context;
  const IndexLists clusters = clusterPoints(points, parameters, context);
  std::vector<char> marked(static_cast<std::size_t>(clusters.count()), 0);
  for (Index c = 0; c < clusters.count(); ++c) marked[c] = c % 7 == 0 || c > 300;
  const IndexLists finer = finerClusters(points, clusters, marked, parameters, context);
  std::vector<Index> all = finer.items;
  std::sort(all.begin(), all.end());
  for (std::size_t i = 0; i < points.size(); ++i)
    ASSERT_EQ(all[i], static_cast<Index>(i));  // each point once
  Index kept = 0;
  for (Index c = 0; c < clusters.count(); ++c) {
    if (marked[c]) continue;
    EXPECT_TRUE(std::equal(clusters.data(c), clusters.data(c) + clusters.size(c), finer.data(kept)));
    ++kept;
  }
  EXPECT_GT(finer.count(), clusters.count());
  for (Index c = kept; c < finer.count(); ++c) EXPECT_LE(finer.size(c), parameters.max_size / 2);
  const std::vector<char> none(marked.size(), 0);
  EXPECT_EQ(finerClusters(points, clusters, none, parameters, context).items, clusters.items);
}

// A rod as thin as clusters are wide: representatives alone cannot carry it at first.
TEST(TroubledPlaces, GetMoreRepresentatives) {
  for (const double radius : {2.5, 3.0, 4.0}) {
    test::Points rod;  // about one spacing between points
    const int around = static_cast<int>(std::lround(2 * M_PI * radius));
    for (int ring = 0; ring <= 60; ++ring) {
      for (int i = 0; i < around; ++i) {
        const double u = 2 * M_PI * (i + 0.5 * (ring % 2)) / around;
        rod.emplace_back(radius * std::cos(u), radius * std::sin(u), ring);
      }
    }
    for (const double end : {0.0, 60.0}) {  // half a ball on both ends
      for (int ring = 1; ring < static_cast<int>(1.5 * radius); ++ring) {
        const double v = 0.5 * M_PI * ring / (1.5 * radius), size = radius * std::cos(v);
        const int count = std::max(3, static_cast<int>(std::lround(2 * M_PI * size)));
        for (int i = 0; i < count; ++i) {
          const double u = 2 * M_PI * i / count, height = radius * std::sin(v);
          rod.emplace_back(size * std::cos(u), size * std::sin(u), end > 0 ? end + height : -height);
        }
      }
      rod.emplace_back(0, 0, end > 0 ? end + radius : -radius);
    }
    Context context;
    const Reconstruction result =
        reconstruct(makePointSet(rod, StoredAs::Float, nullptr, context), nullptr, {}, context);
    for (const MeshReport& report : result.reports) {
      EXPECT_EQ(report.genus, 0) << radius;
      EXPECT_EQ(report.border_loops, 0) << radius;
      EXPECT_EQ(report.components, 1) << radius;
      EXPECT_EQ(report.self_intersections, 0) << radius;
    }
  }
}

}  // namespace
}  // namespace mlsmesh::core
