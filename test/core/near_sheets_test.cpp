// SPDX-License-Identifier: BSD-3-Clause
// Sheets nearer to each other than a neighbourhood is wide, and clouds that no surface without crossings has.
#include "near_sheets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "mlsmesh/core/multiresolution.h"
#include "sheet_clusters.h"
#include "surfaces.h"

namespace mlsmesh::core {
namespace {

using test::Points;

constexpr double kPi = 3.14159265358979323846;
constexpr double kSpacing = 0.05;  // of even samples: no two points are nearer

Reconstruction meshOf(const Points& world, bool reduce) {
  Context context;
  MultiresolutionParameters parameters;
  parameters.reduce = reduce;
  return reconstruct(makePointSet(world, StoredAs::Double, nullptr, context), nullptr, parameters, context);
}

std::vector<MeshReport> levelsOf(const Points& world, bool reduce) {
  return meshOf(world, reduce).reports;
}

double areaOf(const RefinedMesh& mesh, std::size_t level) {
  double area = 0;
  for (const auto& [a, b, c] : mesh.level_triangles[level]) {
    const Vec3 &p = mesh.position[a], &q = mesh.position[b], &r = mesh.position[c];
    area += 0.5 * (q - p).cross(r - p).norm();
  }
  return area;
}

void expectClean(const MeshReport& report) {
  test::expectSound(report);
  EXPECT_EQ(report.self_intersections.value_or(-1), 0);
}

void expectClean(const Points& world) {
  for (const bool reduce : {true, false}) {
    SCOPED_TRACE(reduce ? "reduced" : "not reduced");
    for (const MeshReport& report : levelsOf(world, reduce)) expectClean(report);
  }
}

struct Expected {
  Index components, euler, border_loops;
};

void expectTopology(const Points& world, const Expected& expected) {
  for (const bool reduce : {true, false}) {
    for (const MeshReport& report : levelsOf(world, reduce)) {
      SCOPED_TRACE(testing::Message() << (reduce ? "" : "not reduced, ") << report.triangles << " triangles");
      expectClean(report);
      EXPECT_EQ(report.components, expected.components);
      EXPECT_EQ(report.euler, expected.euler);
      EXPECT_EQ(report.border_loops, expected.border_loops);
    }
  }
}

Points moved(Points points, const Vec3& by) {
  for (Vec3& p : points) p += by;
  return points;
}

Points scaled(Points points, double factor) {
  for (Vec3& p : points) p *= factor;
  return points;
}

Index indexOfFirstOutside(const Slab& slab, const Points& points) {
  const auto outside =
      std::find_if(points.begin(), points.end(), [&](const Vec3& p) { return !slab.contains(p); });
  return static_cast<Index>(outside - points.begin());
}

std::optional<Slab> sheetOf(const Points& points, double least_gap) {
  std::vector<Index> all(points.size());
  std::iota(all.begin(), all.end(), 0);
  return sheetOfFirst(points, all.data(), static_cast<int>(all.size()), least_gap);
}

/// 5 x 5 points about one spacing apart at each of the heights, the first ones at the first height.
Points layers(const std::vector<double>& heights) {
  shapes::Random random(3);
  Points points;
  for (const double height : heights)
    for (Vec3 p : test::planeLattice(5, 5))
      points.push_back(p + Vec3(random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), height));
  return points;
}

TEST(SheetOfFirst, EndsHalfWayToTheNext) {
  const Points points = layers({0, 2, -3});
  for (const Points& world : {points, test::Similarity()(points)}) {
    const std::optional<Slab> slab = sheetOf(world, 1.5);
    ASSERT_TRUE(slab);
    EXPECT_EQ(indexOfFirstOutside(*slab, world), 25);
    EXPECT_NEAR(slab->gap, 2, 0.3);  // across an axis that leans a little
    EXPECT_NEAR(slab->high - slab->low, 2.5, 0.1);
  }
  EXPECT_FALSE(sheetOf(points, 2.5));  // the air over it is no gap, and with that layer it is no sheet
}

TEST(SheetOfFirst, IsNoneWhereThereIsOne) {
  EXPECT_FALSE(sheetOf(layers({0}), 0.5));
  Points bent = layers({0}), noisy = test::noisy(layers({0}), 0.4);
  for (Vec3& p : bent) p.z() = 0.2 * p.x() * p.x();
  EXPECT_FALSE(sheetOf(bent, 1.0));
  EXPECT_FALSE(sheetOf(noisy, 1.0));
}

TEST(SheetOfFirst, TakesNeitherScanLinesNorTerracesForSheets) {
  Points lines = layers({0}), terraces = lines;
  for (Vec3& p : lines) p.x() = 7 * std::round(p.x());
  for (Vec3& p : terraces) p.z() = p.x() < 2.4 ? 0 : 2;
  EXPECT_FALSE(sheetOf(lines, 1.5));
  EXPECT_FALSE(sheetOf(terraces, 1.5));
}

/// Over [-1, 1]^2, no two points nearer than kSpacing.
Points flatSheet(std::uint64_t seed) {
  Points points = test::evenSample("saddle", kSpacing, seed);
  for (Vec3& p : points) p.y() = 0;
  return points;
}

// Whether their rims are joined is open: at that distance they may as well be those of a slab.
TEST(NearSheets, ProjectionsStayOnTheirs) {
  for (const double apart : {2.5, 3.0, 4.0}) {
    const test::Cloud cloud(
        test::joined(flatSheet(1), moved(flatSheet(2), apart * kSpacing * Vec3::UnitY())));
    const MlsSurface surface = cloud.surface();
    int far = 0;
    for (const Vec3& p : cloud.points.position)
      far += std::abs((surface.project(p).position - p).y()) > 0.05 * kSpacing ? 1 : 0;
    EXPECT_LT(far, 0.01 * cloud.points.size()) << apart;
  }
}

TEST(NearSheets, GetMoreRepresentatives) {
  Representatives all;
  all.spacing = {1, 1, 1};
  all.sheet_gap = {std::numeric_limits<double>::infinity(), 3, 1.2};
  const Points points = test::planeLattice(6, 3);
  IndexLists clusters;
  clusters.items.resize(18);
  std::iota(clusters.items.begin(), clusters.items.end(), 0);
  clusters.begin = {0, 6, 12, 18};
  const std::optional<DividedClusters> finer = clustersBetweenSheets(points, clusters, all, Context());
  ASSERT_TRUE(finer);
  EXPECT_EQ(finer->divided, (std::vector<char>{0, 1, 1}));
  EXPECT_EQ(finer->clusters.size(0), 6);
  for (Index c = 1; c < finer->clusters.count(); ++c) EXPECT_LE(finer->clusters.size(c), c < 3 ? 4 : 1);
  std::vector<Index> members = finer->clusters.items;
  std::sort(members.begin(), members.end());
  EXPECT_EQ(members, clusters.items);
  all.sheet_gap.assign(3, 20);
  EXPECT_FALSE(clustersBetweenSheets(points, clusters, all, Context()));
}

TEST(NearSheets, FlatOnesAreNotMerged) {
  for (const double apart : {3.0, 4.0, 5.0}) {
    const Points world = test::joined(flatSheet(1), moved(flatSheet(2), apart * kSpacing * Vec3::UnitY()));
    for (const bool reduce : {true, false}) {
      SCOPED_TRACE(testing::Message() << apart << (reduce ? "" : ", not reduced"));
      const Reconstruction result = meshOf(world, reduce);
      for (std::size_t level = 0; level < result.reports.size(); ++level) {
        expectClean(result.reports[level]);
        const double rims = 8 * apart * kSpacing;
        EXPECT_GT(areaOf(result.mesh, level), 0.93 * 2 * 4);
        EXPECT_LT(areaOf(result.mesh, level), 2 * 4 + 1.1 * rims);
      }
    }
  }
}

TEST(NearSheets, AShellInsideAnotherStaysApart) {
  for (const double apart : {3.0, 3.5, 4.0, 5.0}) {
    SCOPED_TRACE(apart);
    const double inside = 1 - apart * kSpacing;
    expectTopology(test::joined(test::evenSample("sphere", kSpacing, 1),
                                scaled(test::evenSample("sphere", kSpacing / inside, 2), inside)),
                   {2, 4, 0});
  }
}

TEST(NearSheets, ALensIsClosed) {
  for (const double thick : {5.0, 8.0}) {
    SCOPED_TRACE(thick);
    Points points = test::evenSample("sphere", kSpacing, 1);
    for (Vec3& p : points) p.y() *= 0.5 * thick * kSpacing;
    expectTopology(points, {1, 2, 0});
  }
}

TEST(NearSheets, AsNearAsTheirPointsAreClean) {
  for (const double apart : {0.25, 0.5, 1.0, 1.5}) {
    SCOPED_TRACE(apart);
    expectClean(test::joined(flatSheet(1), moved(flatSheet(2), apart * kSpacing * Vec3::UnitY())));
  }
}

TEST(NearSheets, ThatTurnIntoEachOtherAreClean) {
  for (const double degrees : {2.0, 10.0, 45.0, 90.0}) {
    SCOPED_TRACE(degrees);
    test::Similarity turn;
    turn.rotation = Eigen::AngleAxisd(degrees * kPi / 180, Vec3::UnitX()).toRotationMatrix();
    turn.shift.setZero();
    expectClean(test::joined(flatSheet(1), turn(flatSheet(2))));
  }
}

TEST(Contradictory, CrossingSpheresAreClean) {
  const Points sphere = test::evenSample("sphere", kSpacing);
  for (const double apart : {0.1, 0.5, 1.0, 1.9, 2.0}) {
    SCOPED_TRACE(apart);
    expectClean(test::joined(sphere, moved(test::evenSample("sphere", kSpacing, 2), {apart, 0.01, 0})));
  }
}

TEST(Contradictory, ThreeSheetsAtOneLineAreClean) {
  Points wall;
  for (const Vec3& p : flatSheet(2))
    if (p.x() > 0) wall.emplace_back(0, p.x(), p.z());
  expectClean(test::joined(flatSheet(1), wall));
}

TEST(Contradictory, AKleinBottleIsClean) {
  shapes::Random random(1);
  Points points;
  while (points.size() < 20000) {  // the figure eight, turned half round on its way about the axis
    const double u = random.uniform(0, 2 * kPi), v = random.uniform(0, 2 * kPi);
    const double out = std::cos(u / 2) * std::sin(v) - std::sin(u / 2) * std::sin(2 * v);
    const double up = std::sin(u / 2) * std::sin(v) + std::cos(u / 2) * std::sin(2 * v);
    points.emplace_back((2 + out) * std::cos(u), up, (2 + out) * std::sin(u));
  }
  expectClean(points);
}

TEST(Contradictory, PointsThatFillABoxAreClean) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    shapes::Random random(seed);
    Points points;
    for (int i = 0; i < 2000; ++i) points.emplace_back(random.uniform(), random.uniform(), random.uniform());
    expectClean(points);
  }
}

}  // namespace
}  // namespace mlsmesh::core
