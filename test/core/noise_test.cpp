// SPDX-License-Identifier: BSD-3-Clause
#include "mlsmesh/core/noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "mlsmesh/core/multiresolution.h"
#include "surfaces.h"

namespace mlsmesh::core {
namespace {

using test::Points;

NoiseEstimate estimateOf(const Points& points) {
  return estimateNoise(points, *makeKdTree(points), Context());
}

struct NoisyShape {
  const char* name;
  std::size_t count;
  double spacing;  // one over the root of the density
};

const std::vector<NoisyShape> kShapes = {{"sphere", 20000, std::sqrt(4 * M_PI / 20000)},
                                         {"torus", 20000, std::sqrt(4 * M_PI * M_PI * 0.4 / 20000)}};

Points noisySample(const NoisyShape& shape, double relative, std::uint64_t seed) {
  return test::noisy(test::randomSample(*shapes::makeShape(shape.name), shape.count, seed),
                     relative * shape.spacing, seed + 100);
}

TEST(NoiseEstimate, IsWhatWasAdded) {
  for (const NoisyShape& shape : kShapes) {
    for (const double relative : {0.15, 0.3, 0.6, 1.0}) {
      for (const std::uint64_t seed : {1, 2, 3}) {
        const NoiseEstimate estimate = estimateOf(noisySample(shape, relative, seed));
        EXPECT_NEAR(estimate.sigma / (relative * shape.spacing), 1, 0.1)
            << shape.name << ", " << relative << ", seed " << seed;
      }
    }
  }
}

TEST(NoiseEstimate, IsNextToNothingForCleanClouds) {
  for (const NoisyShape& shape : kShapes) EXPECT_LT(estimateOf(noisySample(shape, 0, 1)).relative, 0.02);
  EXPECT_LT(estimateOf(test::planeLattice(50, 50)).relative, 1e-9);
}

// Neighbourhoods of a hundred are all around its tube there, and their residuals stand still as those of noise do.
TEST(NoiseEstimate, ATubeOfFewPointsIsNoNoise) {
  const auto torus = shapes::makeShape("torus");
  for (const std::size_t count : {400, 500, 600, 800})
    for (const std::uint64_t seed : {1, 2, 3, 4})
      EXPECT_LT(estimateOf(test::randomSample(*torus, count, seed)).relative, 0.1) << count << ", seed " << seed;
}

TEST(NoiseEstimate, GrowsWithTheCloud) {
  const Points points = noisySample(kShapes[1], 0.4, 1);
  test::Similarity motion;
  motion.scale = 250;
  const NoiseEstimate before = estimateOf(points), after = estimateOf(motion(points));
  EXPECT_NEAR(after.sigma, 250 * before.sigma, 1e-3 * after.sigma);
  EXPECT_NEAR(after.relative, before.relative, 1e-3);
}

TEST(NoiseEstimate, SheetsApartAreNoNoise) {
  for (const double apart : {3.0, 4.0, 6.0}) {
    Points points = test::planeLattice(60, 60);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> jitter(-0.3, 0.3);
    for (int i = 0; i < 3600; ++i) points.emplace_back(points[i] + apart * Vec3::UnitZ());
    for (Vec3& p : points) p += Vec3(jitter(random), jitter(random), 0);
    EXPECT_LT(estimateOf(points).relative, 0.02) << apart;
  }
}

TEST(NoiseAdaptation, LeavesCleanCloudsAndThoseWhoDoNotWantItAlone) {
  const MultiresolutionParameters given;
  for (const bool adapt : {true, false}) {
    MultiresolutionParameters parameters = given;
    parameters.noise.adapt = adapt;
    const NoiseAdaptation adaptation = adaptTo({0.5, adapt ? 0.05 : 1.0}, parameters);
    EXPECT_EQ(adaptation.passes, 0);
    EXPECT_EQ(adaptation.residual_limit, 0);
    EXPECT_EQ(adaptation.parameters.projection.support_factor, given.projection.support_factor);
    EXPECT_EQ(adaptation.parameters.projection.neighbors, given.projection.neighbors);
    EXPECT_EQ(adaptation.parameters.refinement.threshold, given.refinement.threshold);
  }
}

TEST(NoiseAdaptation, WidensFitsAndNeverNarrowsThem) {
  MultiresolutionParameters given;
  given.projection.support_factor = 3;
  given.projection.neighbors = 60;
  double support = 0, threshold = 0;
  for (double relative = 0.1; relative < 3; relative *= 1.2) {
    const NoiseAdaptation adaptation = adaptTo({relative, relative}, given);
    const ProjectionParameters& first =
        adaptation.passes > 0 ? adaptation.denoising : adaptation.parameters.projection;
    EXPECT_GE(first.support_factor, given.projection.support_factor);
    EXPECT_GE(first.neighbors, given.projection.neighbors);
    EXPECT_GE(adaptation.parameters.refinement.threshold, given.refinement.threshold);
    if (adaptation.passes == 0) {
      EXPECT_GE(first.support_factor, support);
      support = first.support_factor;
    }
    EXPECT_GE(adaptation.parameters.refinement.threshold, 0.9 * threshold);
    threshold = adaptation.parameters.refinement.threshold;
  }
}

TEST(NoiseAdaptation, TakesTheNoiseThatItIsTold) {
  const Points points = noisySample(kShapes[0], 0.3, 1);
  Context context;
  MultiresolutionParameters parameters;
  parameters.refinement.levels = 0;
  parameters.noise.sigma = 0;  // none, whatever it looks like
  const Reconstruction result =
      reconstruct(makePointSet(points, StoredAs::Double, nullptr, context), nullptr, parameters, context);
  EXPECT_EQ(result.noise.estimate.sigma, 0);
  EXPECT_EQ(result.noise.parameters.projection.neighbors, parameters.projection.neighbors);
}

TEST(Denoising, BringsPointsToTheSurface) {
  const auto shape = shapes::makeShape("torus");
  const Points clean = test::randomSample(*shape, 20000, 1);
  for (const double relative : {0.5, 1.0}) {
    Points points = test::noisy(clean, relative * kShapes[1].spacing, 9);
    const auto meanSquare = [&] {
      std::vector<double> distance;
      for (const Vec3& p : points) distance.push_back(shape->distance(p));
      return test::rootMeanSquare(distance);
    };
    const double before = meanSquare();
    const NoiseAdaptation adaptation = adaptTo(estimateOf(points), {});
    ASSERT_GT(adaptation.passes, 0);
    for (int pass = 0; pass < adaptation.passes; ++pass)
      points =
          projectAll(points, *makeKdTree(points), adaptation.denoising, adaptation.residual_limit, Context());
    EXPECT_LT(meanSquare(), 0.35 * before) << relative;
  }
}

}  // namespace
}  // namespace mlsmesh::core
