// SPDX-License-Identifier: BSD-3-Clause
// Clouds as scanners give them: dense here and sparse there, in lines, in layers, every point more than once.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "mlsmesh/core/multiresolution.h"
#include "shapes/scan.h"
#include "surfaces.h"

namespace mlsmesh::core {
namespace {

using test::Points;

constexpr double kPi = 3.14159265358979323846;

Reconstruction meshOf(const Points& world, bool reduce) {
  Context context;
  MultiresolutionParameters parameters;
  parameters.reduce = reduce;
  parameters.refinement.levels = reduce ? 2 : 1;
  return reconstruct(makePointSet(world, StoredAs::Double, nullptr, context), nullptr, parameters, context);
}

/// Every level is sound, without triangles that meet, and of the shape's topology.
void expectShapeOf(const shapes::Shape& shape, const Points& world, bool reduce) {
  for (const MeshReport& report : meshOf(world, reduce).reports) {
    SCOPED_TRACE(testing::Message() << shape.name() << (reduce ? "" : ", not reduced") << ", "
                                    << report.triangles << " triangles");
    test::expectTopologyOf(shape, report);
    EXPECT_EQ(report.self_intersections.value_or(-1), 0);
  }
}

void expectShapeOf(const shapes::Shape& shape, const Points& world) {
  for (const bool reduce : {true, false}) expectShapeOf(shape, world, reduce);
}

using ShapeAndSeed = std::tuple<const char*, std::uint64_t>;

class UnevenShape : public testing::TestWithParam<ShapeAndSeed> {
 protected:
  const std::unique_ptr<shapes::Shape> shape = shapes::makeShape(std::get<0>(GetParam()));
  const std::uint64_t seed = std::get<1>(GetParam());
};

TEST_P(UnevenShape, DensityThatFallsAHundredfold) {
  for (const double ratio : {10.0, 100.0}) {
    SCOPED_TRACE(ratio);
    shapes::ScanOptions options;
    options.count = 20000;
    options.density_ratio = ratio;
    options.density_axis = 0;
    options.seed = seed;
    expectShapeOf(*shape, shapes::scan(*shape, options).points);
  }
}

TEST_P(UnevenShape, AStepOfThirtyThreeToOne) {
  Points points;
  for (const Vec3& p : test::evenSample(*shape, 0.02, seed))
    if (p.x() > 0.1) points.push_back(p);
  for (const Vec3& p : test::evenSample(*shape, 0.02 * std::sqrt(33), seed))
    if (p.x() <= 0.1) points.push_back(p);
  expectShapeOf(*shape, points);
}

TEST_P(UnevenShape, LayersOfScansThatDoNotQuiteAgree) {
  constexpr double kSpacing = 0.04;
  Points points;
  shapes::Random random(seed);
  for (int layer = 0; layer < 4; ++layer) {
    const Vec3 shift = 0.25 * kSpacing * random.normalVector();
    for (const Vec3& p : test::evenSample(*shape, kSpacing, seed + 10 * layer))
      if (layer == 0 || p[layer - 1] > 0) points.push_back(p + shift);
  }
  expectShapeOf(*shape, points, true);
  // The points themselves are no surface, but what is made of them is sound.
  for (const MeshReport& report : meshOf(points, false).reports) {
    test::expectSound(report);
    EXPECT_EQ(report.self_intersections.value_or(-1), 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, UnevenShape,
                         testing::Combine(testing::Values("sphere", "torus"), testing::Values(1, 2)),
                         [](const auto& instance) {
                           return std::string(std::get<0>(instance.param)) +
                                  std::to_string(std::get<1>(instance.param));
                         });

/// Circles about the tube of the torus, at its outside `apart` times as far from each other as their points
/// are. Each starts at some angle; `jitter` of a point is in distances of points.
Points linesOnATorus(int around_tube, double apart, double jitter, std::uint64_t seed) {
  constexpr double kTube = 0.4;
  shapes::Random random(seed);
  const int lines = static_cast<int>(around_tube * (1 + kTube) / kTube / apart);
  Points points;
  for (int line = 0; line < lines; ++line) {
    const double u = 2 * kPi * line / lines, start = jitter > 0 ? random.uniform() : 0;
    for (int i = 0; i < around_tube; ++i) {
      const double v = 2 * kPi * (i + start + jitter * (random.uniform() - 0.5)) / around_tube;
      const double radius = 1 + kTube * std::cos(v);
      points.emplace_back(radius * std::cos(u), kTube * std::sin(v), radius * std::sin(u));
    }
  }
  return points;
}

TEST(Uneven, ScanLinesMuchFartherApartThanTheirPoints) {
  const auto torus = shapes::makeShape("torus");
  for (const double apart : {2.0, 4.0, 7.0, 10.0}) {
    for (const double jitter : {0.0, 0.4, 1.0}) {
      SCOPED_TRACE(testing::Message() << apart << " apart, jitter " << jitter);
      expectShapeOf(*torus, linesOnATorus(160, apart, jitter, 1));
    }
  }
}

TEST(Uneven, PointsThatAreThereFourTimesAreThereOnce) {
  const Points once = test::evenSample("torus", 0.06);
  const Points four_times =
      test::shuffled(test::joined(test::joined(once, once), test::joined(once, once)), 3);
  for (const bool reduce : {true, false}) {
    const Reconstruction a = meshOf(once, reduce), b = meshOf(four_times, reduce);
    EXPECT_EQ(a.mesh.position, b.mesh.position);
    EXPECT_EQ(a.mesh.level_triangles, b.mesh.level_triangles);
  }
}

}  // namespace
}  // namespace mlsmesh::core
