// SPDX-License-Identifier: BSD-3-Clause
// Clouds full of ties: cocircular points, equal distances, exact planes. Every mesh of V points with one
// border loop of B edges and no handle has 2 V - 2 - B triangles, and a closed one of genus 0 has 2 V - 4.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "mlsmesh/core/multiresolution.h"
#include "surfaces.h"

namespace mlsmesh::core {
namespace {

using test::Points;

constexpr double kPi = 3.14159265358979323846;

MeshReport levelZero(const Points& world, bool reduce, StoredAs stored_as = StoredAs::Double) {
  Context context;
  MultiresolutionParameters parameters;
  parameters.reduce = reduce;
  parameters.refinement.levels = 0;
  const Reconstruction result =
      reconstruct(makePointSet(world, stored_as, nullptr, context), nullptr, parameters, context);
  test::expectSound(result.reports.at(0));
  return result.reports.at(0);
}

/// As it lies, turned in its plane, and turned in space.
std::vector<Points> turned(const Points& points) {
  std::vector<Points> all{points};
  for (const double degrees : {30.0, 45.0, 7.0}) {
    test::Similarity turn;
    turn.rotation = Eigen::AngleAxisd(degrees * kPi / 180, Vec3::UnitZ()).toRotationMatrix();
    turn.shift.setZero();
    all.push_back(turn(points));
  }
  all.push_back(test::Similarity()(points));
  return all;
}

Points hexagonalLattice(int columns, int rows) {
  Points points;
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j) points.emplace_back(i + 0.5 * (j % 2), j * std::sqrt(0.75), 0);
  return points;
}

/// Rows of `around` points, one above the other, over a radius that depends on the height.
template <typename Radius>
Points rings(int around, int rows, double height, const Radius& radius) {
  Points points;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * kPi * i / around;
      points.emplace_back(radius(j) * std::cos(angle), radius(j) * std::sin(angle), height * j);
    }
  }
  return points;
}

TEST(Lattice, SquaresAreMeshedWhole) {
  for (const Points& world : turned(test::planeLattice(40, 30))) {
    const MeshReport report = levelZero(world, false);
    EXPECT_EQ(report.triangles, 2 * 39 * 29);
    EXPECT_EQ(report.border_loops, 1);
    EXPECT_EQ(report.border_edges, 2 * (39 + 29));
  }
}

TEST(Lattice, HexagonsAreMeshedWhole) {
  for (const Points& world : turned(hexagonalLattice(40, 30))) {
    const MeshReport report = levelZero(world, false);
    EXPECT_EQ(report.border_loops, 1);
    EXPECT_EQ(report.vertices, 40 * 30);
    EXPECT_EQ(report.triangles, 2 * 40 * 30 - 2 - report.border_edges);
    // At the two ragged sides a row may or may not be bridged, which a triangle does.
    EXPECT_LE(report.border_edges, 2 * (39 + 29));
    EXPECT_GE(report.border_edges, 2 * 39 + 29);
  }
}

TEST(Lattice, MissingCellsAreClosed) {
  Points points;
  Index missing = 0;
  for (const Vec3& p : test::planeLattice(40, 40)) {
    const int i = static_cast<int>(p.x()), j = static_cast<int>(p.y());
    if (i % 5 == 2 && j % 5 == 2)
      ++missing;
    else
      points.push_back(p);
  }
  ASSERT_EQ(missing, 64);
  for (const Points& world : turned(points)) {
    const MeshReport report = levelZero(world, false);
    EXPECT_EQ(report.triangles, 2 * 39 * 39 - 2 * missing);  // two less for every point inside
    EXPECT_EQ(report.border_loops, 1);
  }
}

TEST(Lattice, JitterAlongOneAxisOpensNothing) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> jitter(-0.3, 0.3);
  Points points = test::planeLattice(40, 40);
  for (Vec3& p : points) p.x() += jitter(random);
  for (const Points& world : turned(points)) {
    const MeshReport report = levelZero(world, false);
    EXPECT_EQ(report.vertices, 1600);
    EXPECT_EQ(report.border_loops, 1);
    EXPECT_EQ(report.triangles, 2 * 1600 - 2 - report.border_edges);
  }
}

TEST(Lattice, RowsThatAreFartherApartThanTheirPointsAreJoined) {
  Points points = test::planeLattice(30, 60);
  for (Vec3& p : points) p.x() *= 2;
  for (const Points& world : turned(points)) {
    const MeshReport report = levelZero(world, false);
    EXPECT_EQ(report.triangles, 2 * 29 * 59);
    EXPECT_EQ(report.border_loops, 1);
  }
}

TEST(Lattice, ACylinderOfRingsIsOpenAtItsTwoEnds) {
  for (const Points& world : turned(rings(60, 30, 2 * 10 * std::sin(kPi / 60), [](int) { return 10.0; }))) {
    const MeshReport report = levelZero(world, false);
    EXPECT_EQ(report.triangles, 2 * 60 * 29);
    EXPECT_EQ(report.border_loops, 2);
    EXPECT_EQ(report.euler, 0);
  }
}

Points graduatedSphere(int around, int belts) {
  Points points{{0, 0, 1}, {0, 0, -1}};
  for (int j = 1; j <= belts; ++j) {
    const double polar = kPi * j / (belts + 1);
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * kPi * i / around;
      points.emplace_back(std::sin(polar) * std::cos(angle), std::sin(polar) * std::sin(angle),
                          std::cos(polar));
    }
  }
  return points;
}

// On the rings next to the poles, all nearest points may be of the ring.
TEST(Lattice, AGraduatedSphereIsClosed) {
  for (const auto& [around, belts] : {std::pair(24, 23), {48, 23}, {64, 31}, {128, 31}}) {
    SCOPED_TRACE(testing::Message() << around << " x " << belts);
    for (const Points& world : turned(graduatedSphere(around, belts))) {
      const MeshReport report = levelZero(world, false);
      EXPECT_EQ(report.euler, 2);
      EXPECT_EQ(report.border_loops, 0);
      EXPECT_EQ(report.triangles, 2 * static_cast<Index>(world.size()) - 4);
    }
  }
}

TEST(Lattice, CocircularRingsFillADisc) {
  Points points{{0, 0, 0}};
  for (int ring = 1; ring <= 16; ++ring) {
    for (int i = 0; i < 6 * ring; ++i) {
      const double angle = 2 * kPi * i / (6 * ring);
      points.emplace_back(ring * std::cos(angle), ring * std::sin(angle), 0);
    }
  }
  for (const Points& world : turned(points)) {
    const MeshReport report = levelZero(world, false);
    EXPECT_EQ(report.triangles, 6 * 16 * 16);
    EXPECT_EQ(report.border_edges, 6 * 16);
    EXPECT_EQ(report.border_loops, 1);
  }
}

/// The points of an n x n x n lattice that lie on the surface of its cube.
Points cubeLattice(int n) {
  Points points;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k)
        if (std::set<int>{0, n - 1}.count(i) + std::set<int>{0, n - 1}.count(j) +
                std::set<int>{0, n - 1}.count(k) >
            0)
          points.emplace_back(i, j, k);
  return points;
}

TEST(Lattice, ACubeIsClosed) {
  for (const Points& world : turned(cubeLattice(12))) {
    const MeshReport report = levelZero(world, false);
    EXPECT_EQ(report.triangles, 6 * 2 * 11 * 11);
    EXPECT_EQ(report.euler, 2);
    EXPECT_EQ(report.border_loops, 0);
  }
}

TEST(Lattice, ADepthImageIsMeshedWhole) {
  Points points;
  for (int u = 0; u < 60; ++u) {
    for (int v = 0; v < 40; ++v) {
      const Vec3 ray((u - 29.5) / 60, (v - 19.5) / 60, 1);
      points.push_back((2 + 0.2 * std::sin(0.1 * u) * std::cos(0.1 * v)) * ray);
    }
  }
  for (const Points& world : turned(points)) {
    for (const StoredAs stored_as : {StoredAs::Double, StoredAs::Float}) {
      const MeshReport report = levelZero(world, false, stored_as);
      EXPECT_EQ(report.vertices, 60 * 40);
      EXPECT_EQ(report.triangles, 2 * 60 * 40 - 2 - report.border_edges);
      EXPECT_EQ(report.border_loops, 1);
    }
  }
}

struct Reduced {
  const char* name;
  Points points;
  Index euler;
  Index loops;
};

TEST(Lattice, ReducedOnesKeepTheirTopology) {
  const std::vector<Reduced> all{
      {"squares", test::planeLattice(60, 50), 1, 1},
      {"hexagons", hexagonalLattice(60, 50), 1, 1},
      {"cylinder", rings(120, 60, 2 * 10 * std::sin(kPi / 120), [](int) { return 10.0; }), 0, 2},
      {"cube", cubeLattice(30), 2, 0}};
  for (const Reduced& lattice : all) {
    for (const Points& world : turned(lattice.points)) {
      const MeshReport report = levelZero(world, true);
      EXPECT_EQ(report.components, 1) << lattice.name;
      EXPECT_EQ(report.euler, lattice.euler) << lattice.name;
      EXPECT_EQ(report.border_loops, lattice.loops) << lattice.name;
    }
  }
}

}  // namespace
}  // namespace mlsmesh::core
