// SPDX-License-Identifier: BSD-3-Clause
#include "clouds.h"
#include "mlsmesh/advancing_front_triangulation.h"
#include "mlsmesh/mls_multiresolution.h"
#include "mlsmesh/mls_reduction.h"
#include "mlsmesh/pcl_search.h"

#include <gtest/gtest.h>

#include <pcl/point_types.h>
#include <pcl/search/brute_force.h>
#include <pcl/search/kdtree.h>
#include <pcl/search/octree.h>
#include <pcl/search/organized.h>

#include <functional>
#include <string>
#include <vector>

namespace mlsmesh::testing {
namespace {

using Point = pcl::PointXYZ;
using Search = pcl::search::Search<Point>;

struct NamedSearch {
  std::string label;
  std::function<Search::Ptr()> make;
};

const std::vector<NamedSearch>& exactSearches() {
  static const std::vector<NamedSearch> searches{
      {"KdTree", [] { return Search::Ptr(new pcl::search::KdTree<Point>); }},
      {"KdTree, unsorted", [] { return Search::Ptr(new pcl::search::KdTree<Point>(false)); }},
      {"Octree", [] { return Search::Ptr(new pcl::search::Octree<Point>(0.2)); }},
      {"BruteForce", [] { return Search::Ptr(new pcl::search::BruteForce<Point>); }},
  };
  return searches;
}

core::PointSet pointSet(const std::vector<core::Vec3>& positions) {
  core::Context context;
  return core::makePointSet(positions, core::StoredAs::Double, nullptr, context);
}

// Asks both searches the same and compares bit by bit, order included.
void expectSameAnswers(const core::NeighborSearch& expected, const core::NeighborSearch& actual,
                       const std::vector<core::Vec3>& queries, int k, const std::string& label) {
  ASSERT_EQ(expected.size(), actual.size());
  std::vector<core::Index> expected_index(k), index(k);
  std::vector<double> expected_distance(k), distance(k);
  for (const core::Vec3& query : queries) {
    const int expected_count = expected.nearest(query, k, expected_index.data(), expected_distance.data());
    ASSERT_EQ(expected_count, actual.nearest(query, k, index.data(), distance.data())) << label;
    ASSERT_EQ(expected_index, index) << label << " k " << k;
    ASSERT_EQ(expected_distance, distance) << label << " k " << k;
  }
}

std::vector<core::Vec3> queriesAround(const std::vector<core::Vec3>& points, double spread) {
  std::vector<core::Vec3> queries(points.begin(), points.begin() + std::min<std::size_t>(points.size(), 60));
  Jitter jitter(5);
  for (int i = 0; i < 60; ++i) {
    const core::Vec3 shift(spread * jitter(), spread * jitter(), spread * jitter());
    queries.push_back(points[(i * 17) % points.size()] + shift);
  }
  return queries;
}

TEST(PclSearch, AnswersAsTheBuiltInTree) {
  const core::PointSet points = pointSet(spherePoints(700));
  const auto built_in = core::makeKdTree(points.position);
  for (const auto& [label, make] : exactSearches()) {
    const PclSearch<Point> search(points.position, make());
    for (const int k : {1, 6, 20}) {
      expectSameAnswers(*built_in, search, queriesAround(points.position, 0.3), k, label);
    }
  }
}

TEST(PclSearch, TiesGoToTheLowestIndexOnALattice) {
  const core::PointSet points = pointSet(latticePoints(12));
  const auto built_in = core::makeKdTree(points.position);
  for (const auto& [label, make] : exactSearches()) {
    const PclSearch<Point> search(points.position, make());
    for (const int k : {1, 2, 4, 7, 20}) expectSameAnswers(*built_in, search, points.position, k, label);
  }
}

TEST(PclSearch, AllPointsTiedStillGiveTheLowestIndices) {
  // The centre of a sphere: the float distances say nothing about the order.
  const core::PointSet points = pointSet(spherePoints(300));
  const auto built_in = core::makeKdTree(points.position);
  for (const auto& [label, make] : exactSearches()) {
    expectSameAnswers(*built_in, PclSearch<Point>(points.position, make()), {-points.origin}, 10, label);
  }
}

TEST(PclSearch, DistancesFinerThanAFloatAreOrderedInDoubles) {
  // Neighbours 1e-9 apart at a distance of 100 from the local origin: equal floats, different doubles.
  std::vector<core::Vec3> positions;
  for (int i = 0; i < 40; ++i) positions.emplace_back(100, 1e-9 * ((i * 7) % 40), 1e-10 * i);
  positions.emplace_back(-100, 0, 0);
  positions.emplace_back(0, 3, 0);
  const core::PointSet points = pointSet(positions);
  const auto built_in = core::makeKdTree(points.position);
  for (const auto& [label, make] : exactSearches()) {
    expectSameAnswers(*built_in, PclSearch<Point>(points.position, make()), points.position, 5, label);
  }
}

TEST(PclSearch, MoreNeighboursThanPointsGivesAllPoints) {
  const core::PointSet points = pointSet(spherePoints(9));
  const auto built_in = core::makeKdTree(points.position);
  for (const auto& [label, make] : exactSearches()) {
    std::vector<core::Index> index(30);
    std::vector<double> distance(30);
    const PclSearch<Point> search(points.position, make());
    EXPECT_EQ(search.nearest({0.1, 0.2, 0.3}, 30, index.data(), distance.data()), 9) << label;
    EXPECT_EQ(search.nearest({0.1, 0.2, 0.3}, 0, index.data(), distance.data()), 0) << label;
  }
}

// Finds one point fewer than it is asked for.
class LazySearch : public pcl::search::BruteForce<Point> {
 public:
  int nearestKSearch(const Point& point, int k, pcl::Indices& indices,
                     std::vector<float>& distances) const override {
    return pcl::search::BruteForce<Point>::nearestKSearch(point, k - 1, indices, distances);
  }
  using pcl::search::Search<Point>::nearestKSearch;
};

TEST(PclSearch, ASearchThatFindsTooFewIsNamed) {
  AdvancingFrontTriangulation<Point> step;
  step.setInputCloud(cloudOf<Point>(spherePoints(200)));
  step.setSearchMethod(Search::Ptr(new LazySearch));
  pcl::PolygonMesh output;
  step.reconstruct(output);
  EXPECT_EQ(step.status().code, StatusCode::InvalidParameter);
  EXPECT_NE(step.status().message.find("BruteForce"), std::string::npos) << step.status().message;
  EXPECT_TRUE(isEmpty(output));
}

TEST(UserSearch, GivesTheSameMeshAsTheBuiltInTree) {
  const auto cloud = cloudOf<Point>(cylinderPoints(40, 20));
  MlsMultiresolution<Point> built_in;
  built_in.setInputCloud(cloud);
  pcl::PolygonMesh expected;
  built_in.reconstruct(expected);
  ASSERT_TRUE(built_in.status().ok()) << built_in.status().message;
  for (const auto& [label, make] : exactSearches()) {
    MlsMultiresolution<Point> step;
    step.setInputCloud(cloud);
    step.setSearchMethod(make());
    pcl::PolygonMesh output;
    step.reconstruct(output);
    ASSERT_TRUE(step.status().ok()) << label << ": " << step.status().message;
    EXPECT_TRUE(sameMesh(expected, output)) << label;
  }
}

TEST(UserSearch, GivesTheSameRepresentativesAndTrianglesOnALattice) {
  const auto cloud = cloudOf<Point>(latticePoints(15));
  MlsReduction<Point, pcl::PointNormal> reduction;
  AdvancingFrontTriangulation<Point> triangulation;
  reduction.setInputCloud(cloud);
  triangulation.setInputCloud(cloud);
  pcl::PointCloud<pcl::PointNormal> expected_points, points;
  pcl::PolygonMesh expected_mesh, mesh;
  reduction.process(expected_points);
  triangulation.reconstruct(expected_mesh);
  ASSERT_EQ(expected_points.size(), 225u) << reduction.status().message;
  for (const auto& [label, make] : exactSearches()) {
    reduction.setSearchMethod(make());
    triangulation.setSearchMethod(make());
    reduction.process(points);
    triangulation.reconstruct(mesh);
    ASSERT_EQ(points.size(), expected_points.size()) << label << ": " << reduction.status().message;
    for (std::size_t i = 0; i < points.size(); ++i)
      EXPECT_EQ(positionOf(points[i]), positionOf(expected_points[i]));
    EXPECT_TRUE(sameMesh(expected_mesh, mesh)) << label;
  }
}

TEST(UserSearch, AnOrganisedSearchIsReplacedWithAWarning) {
  AdvancingFrontTriangulation<Point> step;
  step.setInputCloud(cloudOf<Point>(spherePoints(200)));
  step.setSearchMethod(Search::Ptr(new pcl::search::OrganizedNeighbor<Point>));
  pcl::PolygonMesh output;
  step.reconstruct(output);
  ASSERT_TRUE(step.status().ok()) << step.status().message;
  EXPECT_EQ(output.polygons.size(), 396u);
  ASSERT_EQ(step.status().warnings.size(), 1u);
  EXPECT_NE(step.status().warnings[0].find("OrganizedNeighbor"), std::string::npos);
}

TEST(UserSearch, OneTreeServesOneStepAfterAnother) {
  const Search::Ptr tree(new pcl::search::KdTree<Point>);
  AdvancingFrontTriangulation<Point> step;
  step.setSearchMethod(tree);
  for (const int count : {300, 100, 200}) {
    step.setInputCloud(cloudOf<Point>(spherePoints(count)));
    pcl::PolygonMesh output;
    step.reconstruct(output);
    EXPECT_EQ(output.polygons.size(), 2u * static_cast<unsigned>(count) - 4u) << step.status().message;
  }
}

}  // namespace
}  // namespace mlsmesh::testing
