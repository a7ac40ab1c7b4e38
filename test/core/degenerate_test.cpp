// SPDX-License-Identifier: BSD-3-Clause
// Clouds that are no surface, or hardly one. Each is refused with a reason, or every level keeps all
// promises, whichever way it is reconstructed.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "clouds/random_clouds.h"
#include "clouds/soundness.h"
#include "surfaces.h"
#include "test_shapes.h"

namespace mlsmesh::core {
namespace {

using test::Points;

constexpr double kPi = 3.14159265358979323846;

std::vector<MultiresolutionParameters> allWays() {
  std::vector<MultiresolutionParameters> ways{defaultPreset(), paperPreset(), printedPreset(), {}, {}};
  ways[3].reduce = false;
  ways[4].watertight = true;
  return ways;
}

void expectSoundOrRefused(const Points& world) {
  EXPECT_EQ(test::outcomeOf(world, StoredAs::Double).fault, "");
  for (const MultiresolutionParameters& way : allWays())
    EXPECT_EQ(test::outcomeOf(world, StoredAs::Float, way).fault, "");
}

void expectSound(const Points& world) {
  expectSoundOrRefused(world);
  for (const bool reduce : {true, false}) {
    MultiresolutionParameters parameters;
    parameters.reduce = reduce;
    EXPECT_EQ(name(test::outcomeOf(world, StoredAs::Double, parameters).code), std::string("Ok"));
  }
}

void expectRefusal(StatusCode code, const Points& world) {
  for (const StoredAs stored_as : {StoredAs::Float, StoredAs::Double})
    for (const MultiresolutionParameters& way : allWays())
      EXPECT_EQ(name(test::outcomeOf(world, stored_as, way).code), std::string(name(code)));
}

Points moved(Points points, const Vec3& by) {
  for (Vec3& p : points) p += by;
  return points;
}

Points stretched(Points points, const Vec3& by) {
  for (Vec3& p : points) p = p.cwiseProduct(by);
  return points;
}

Points sphere(std::size_t count, double radius, const Vec3& center, std::uint64_t seed) {
  shapes::Random random(seed);
  Points points;
  for (std::size_t i = 0; i < count; ++i) points.push_back(center + radius * random.direction());
  return points;
}

/// Uniform in the rectangle that u and v span.
Points sheet(std::size_t count, const Vec3& u, const Vec3& v, std::uint64_t seed) {
  shapes::Random random(seed);
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const double along = random.uniform(-1, 1);
    points.push_back(along * u + random.uniform(-1, 1) * v);
  }
  return points;
}

TEST(Degenerate, AllPointsEqual) {
  expectRefusal(StatusCode::TooFewPoints, Points(1000, Vec3(1, 2, 3)));
  expectRefusal(StatusCode::TooFewPoints, Points(1000, Vec3::Zero()));
}

TEST(Degenerate, TwoPlaces) {
  Points points(500, Vec3(-1e6, 0, 0));
  points.resize(1000, Vec3(1e6, 1, 2));
  expectRefusal(StatusCode::TooFewPoints, points);
}

TEST(Degenerate, OnALine) {
  Points points;
  for (int i = 0; i < 1000; ++i) points.emplace_back(0.1 * i, 0.2 * i, -0.3 * i);
  expectRefusal(StatusCode::DegenerateInput, points);
}

TEST(Degenerate, OnALineButOne) {
  Points points;
  for (int i = 0; i < 1000; ++i) points.emplace_back(i, 0, 0);
  for (const double height : {1e-6, 1e-3, 1.0, 1e3, 1e6}) {
    SCOPED_TRACE(height);
    points.emplace_back(500.5, height, 0);
    expectSoundOrRefused(points);
    points.pop_back();
  }
}

TEST(Degenerate, OnTwoLines) {
  Points points;
  for (int i = 0; i < 500; ++i) {
    points.emplace_back(i, 0, 0);
    points.emplace_back(0, 0.7 * i, 3);
  }
  expectSoundOrRefused(points);
}

TEST(Degenerate, OnAPlane) {
  expectSound(sheet(1500, {1, 0.3, 0.2}, {-0.2, 1, 0.7}, 1));
  expectSound(sheet(1500, Vec3::UnitX(), Vec3::UnitY(), 1));
}

TEST(Degenerate, OnACircle) {
  Points points;
  for (int i = 0; i < 720; ++i) points.emplace_back(std::cos(kPi * i / 360), std::sin(kPi * i / 360), 0);
  expectSoundOrRefused(points);
}

TEST(Degenerate, OnAHelix) {
  Points points;
  for (int i = 0; i < 2000; ++i) points.emplace_back(std::cos(0.05 * i), std::sin(0.05 * i), 0.01 * i);
  expectSoundOrRefused(points);
}

TEST(Degenerate, OnASphereToTheLastBit) {
  // Lattice points at one distance from the origin: all cospherical, many cocircular.
  Points points;
  constexpr int kSquare = 1105;  // 5 * 13 * 17
  for (int x = -33; x <= 33; ++x)
    for (int y = -33; y <= 33; ++y)
      for (int z = -33; z <= 33; ++z)
        if (x * x + y * y + z * z == kSquare) points.emplace_back(x, y, z);
  ASSERT_GT(points.size(), 100u);
  expectSound(points);
}

TEST(Degenerate, TwoPointsFarFromTheOthersAndEachOther) {
  const Points surface = test::evenSample("torus", 0.12);
  for (const double far : {1e2, 1e12, 1e30})
    expectSoundOrRefused(test::joined(surface, {{far, 0, 0}, {-far, far, 0}}));
}

TEST(Degenerate, AMillionPointsInThreeHundredPlaces) {
  const Points places = sphere(300, 1, Vec3::Zero(), 1);
  Points points;
  for (std::size_t i = 0; i < 1000000; ++i) points.push_back(places[i * 7919 % places.size()]);
  const auto mesh = [](const Points& world) {
    Context context;
    return reconstruct(makePointSet(world, StoredAs::Float, nullptr, context), nullptr, {}, context).mesh;
  };
  const RefinedMesh a = mesh(places), b = mesh(points);
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.level_triangles, b.level_triangles);
}

TEST(Degenerate, SquareLatticesOfEverySize) {
  for (const int columns : {2, 3, 4, 7, 20})
    for (const int rows : {2, 3, 5, 30}) expectSoundOrRefused(test::planeLattice(columns, rows));
}

TEST(Degenerate, CubicLatticesOfEverySize) {
  for (const int side : {2, 3, 4, 7, 9}) expectSoundOrRefused(test::lattice(side));
}

TEST(Degenerate, BodyCenteredLattice) {
  const Points corners = test::lattice(6);
  expectSoundOrRefused(test::joined(corners, moved(corners, Vec3::Constant(0.5))));
}

TEST(Degenerate, ADenseClumpInAHugeBox) {
  Points points = stretched(test::randomCloud(100, 1), Vec3::Constant(1e6));
  expectSoundOrRefused(test::joined(points, sphere(800, 1e-3, Vec3(3, 4, 5), 1)));
  expectSoundOrRefused(test::joined(points, stretched(test::randomCloud(500, 2), Vec3::Constant(1e-3))));
}

TEST(Degenerate, MoreOutliersThanPoints) {
  const Points object = sphere(300, 0.2, Vec3::Zero(), 1);
  expectSoundOrRefused(test::joined(object, test::randomCloud(800, 3)));
  expectSoundOrRefused(test::joined(object, stretched(test::randomCloud(600, 3), Vec3::Constant(100))));
}

TEST(Degenerate, SpheresThatTouchAtAPoint) {
  Points points = test::joined(sphere(800, 1, {-1, 0, 0}, 1), sphere(800, 1, {1, 0, 0}, 2));
  points.push_back(Vec3::Zero());
  expectSound(points);
}

TEST(Degenerate, ADoubleCone) {
  shapes::Random random(1);
  Points points{Vec3::Zero()};
  for (int i = 0; i < 1500; ++i) {
    const double height = random.uniform(-1, 1), angle = random.uniform(0, 2 * kPi);
    points.emplace_back(height * std::cos(angle), height * std::sin(angle), height);
  }
  expectSound(points);
}

TEST(Degenerate, ACylinderThatLiesOnAPlane) {
  Points points = sheet(2000, Vec3::UnitX(), Vec3::UnitY(), 1);
  shapes::Random random(2);
  for (int i = 0; i < 2000; ++i) {
    const double along = random.uniform(-1, 1), angle = random.uniform(0, 2 * kPi);
    points.emplace_back(0.4 * std::cos(angle), along, 0.4 + 0.4 * std::sin(angle));
  }
  expectSound(points);
}

TEST(Degenerate, ThreePagesOnOneSpine) {
  Points points;
  for (int page = 0; page < 3; ++page) {
    const double angle = 2 * kPi * page / 3;
    const Vec3 out(std::cos(angle), std::sin(angle), 0);
    points = test::joined(points, moved(sheet(1000, 0.5 * out, Vec3::UnitZ(), 1), 0.5 * out));
  }
  expectSound(points);
}

TEST(Degenerate, CrossingSheets) {
  const Points x = sheet(600, Vec3::UnitY(), Vec3::UnitZ(), 1),
               y = sheet(600, Vec3::UnitX(), Vec3::UnitZ(), 2);
  const Points z = sheet(600, Vec3::UnitX(), Vec3::UnitY(), 3);
  expectSound(test::joined(x, y));
  expectSound(test::joined(test::joined(x, y), z));
  expectSound(test::joined(z, sheet(600, {1, 0, 0.05}, Vec3::UnitY(), 4)));  // at three degrees
}

TEST(Degenerate, CrossingLattices) {
  const Points flat = test::planeLattice(21, 21);
  Points upright;
  for (const Vec3& p : flat) upright.emplace_back(p.x(), 10, p.y() - 10);
  expectSound(test::joined(flat, upright));
}

TEST(Degenerate, AVolumeFullOfPoints) {
  expectSoundOrRefused(test::randomCloud(1000, 5));
}

TEST(Degenerate, Dust) {
  // Cantor's, in three dimensions: dimension 3 log 2 / log 3.
  Points points{Vec3::Zero()};
  for (int level = 0; level < 3; ++level) {
    const double step = 2 * std::pow(3.0, level);
    const Points before = points;
    for (int corner = 1; corner < 8; ++corner)
      points = test::joined(points, moved(before, step * Vec3(corner & 1, corner >> 1 & 1, corner >> 2)));
  }
  expectSoundOrRefused(points);
  shapes::Random random(1);
  for (int seed = 1; seed <= 3; ++seed)
    expectSoundOrRefused(test::cloudKind("fractal dust").draw(500, random));
}

TEST(Degenerate, StretchedAMillionTimes) {
  const Points torus = test::evenSample("torus", 0.08);
  for (const Vec3& by : {Vec3(1e6, 1, 1), Vec3(1, 1e-6, 1), Vec3(1e3, 1, 1e-3)}) {
    SCOPED_TRACE(by.transpose());
    expectSoundOrRefused(stretched(torus, by));
    expectSoundOrRefused(stretched(test::randomCloud(600, 1), by));
    expectSoundOrRefused(stretched(test::lattice(7), by));
  }
}

TEST(Degenerate, DensityThatFallsAMillionfold) {
  shapes::Random random(1);
  Points points;
  for (int i = 0; i < 2000; ++i) {
    const double radius = std::pow(10.0, random.uniform(-6, 0)), angle = random.uniform(0, 2 * kPi);
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
  }
  expectSound(points);
}

TEST(Degenerate, PointsAFewUnitsInTheLastPlaceApart) {
  Points points;
  const double step = std::ldexp(1.0, -23);
  for (const Vec3& p : test::planeLattice(30, 30)) points.push_back(Vec3::Ones() + step * p);
  expectSoundOrRefused(points);
  expectSoundOrRefused(moved(points, Vec3::Constant(1024)));
}

TEST(Degenerate, TheLimitsOfFloats) {
  const Points torus = test::evenSample("torus", 0.1);
  for (const double scale : {1e-44, 1e-40, 1e-38, 1e-30, 1e30, 1e38, 2e38}) {
    SCOPED_TRACE(scale);
    expectSoundOrRefused(stretched(torus, Vec3::Constant(scale)));
  }
}

TEST(Degenerate, MoreWindowsOfTheBendThanNumbersTellApart) {
  MultiresolutionParameters parameters;
  parameters.triangulation.bend_first = 0;
  parameters.triangulation.bend_step = 1e-300;
  const test::Outcome outcome = test::outcomeOf(test::evenSample("torus", 0.1), StoredAs::Double, parameters);
  EXPECT_EQ(outcome.fault, "");
  EXPECT_EQ(outcome.code, StatusCode::Ok);
}

TEST(Degenerate, ThreePoints) {
  for (const double height : {1e-8, 1e-4, 1.0, 1e4, 1e8})
    expectSoundOrRefused({{0, 0, 0}, {1, 0, 0}, {0.5, height, 0}});
}

}  // namespace
}  // namespace mlsmesh::core
