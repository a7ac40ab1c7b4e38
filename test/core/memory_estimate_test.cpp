// SPDX-License-Identifier: BSD-3-Clause
#include "mlsmesh/memory_estimate.h"

#include <gtest/gtest.h>

namespace mlsmesh {
namespace {

constexpr std::size_t kPoints = 100000;
constexpr std::size_t kPointBytes = 16;

MultiresolutionParameters withLevels(int levels) {
  MultiresolutionParameters parameters;
  parameters.refinement.levels = levels;
  return parameters;
}

TEST(MemoryEstimate, RisesWithWhatMakesMeshesLarger) {
  for (int levels = 0; levels < 6; ++levels) {
    const MultiresolutionParameters parameters = withLevels(levels);
    const auto estimate = peakMemoryEstimate(kPoints, kPointBytes, parameters);
    EXPECT_GT(peakMemoryEstimate(2 * kPoints, kPointBytes, parameters), estimate);
    EXPECT_GT(peakMemoryEstimate(kPoints, 2 * kPointBytes, parameters), estimate);
    EXPECT_GT(peakMemoryEstimate(kPoints, kPointBytes, withLevels(levels + 1)), estimate);
    MultiresolutionParameters more = parameters;
    more.reduce = false;
    EXPECT_GT(peakMemoryEstimate(kPoints, kPointBytes, more), estimate);
    more = parameters;
    more.clustering.max_size /= 2;
    EXPECT_GT(peakMemoryEstimate(kPoints, kPointBytes, more), estimate);
    more = parameters;
    more.refinement.threshold = 0;
    EXPECT_GE(peakMemoryEstimate(kPoints, kPointBytes, more), estimate);
  }
}

TEST(MemoryEstimate, IsNotLessThanTheDataOfTheResult) {
  MultiresolutionParameters parameters = withLevels(3);
  parameters.reduce = false;
  parameters.refinement.threshold = 0;
  const auto vertices = static_cast<double>(kPoints) * 4 * 4 * 4;  // each edge of each level split
  const double mesh = vertices * (24 + 24 + 4 + 2 * 12 + 2 * 56);  // vertices, triangles, polygons of PCL
  EXPECT_GT(static_cast<double>(peakMemoryEstimate(kPoints, kPointBytes, parameters)), mesh);
}

TEST(MemoryEstimate, OfNothingIsNothing) {
  EXPECT_EQ(peakMemoryEstimate(0, kPointBytes, {}), 0u);
}

}  // namespace
}  // namespace mlsmesh
