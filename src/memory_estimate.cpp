// SPDX-License-Identifier: BSD-3-Clause
#include "mlsmesh/memory_estimate.h"

#include <algorithm>
#include <cmath>

namespace mlsmesh {

namespace {

// Measured (bench_memory, and peak_rss_bytes of --json), rounded up.
constexpr double kBytesPerPoint = 130;
constexpr double kBytesPerVertex = 330;  // of the finest level, its triangles and the mesh for PCL included
constexpr double kUsualPointBytes = 16;
constexpr double kBytesAtEdges = 40000;    // where sharp edges are looked for, by the root of the points
constexpr double kCopiesOfFields = 2;      // of the vertices: the cloud of all, and that of the mesh
constexpr double kPointsPerCluster = 0.7;  // of the largest size allowed: clusters are cut in halves

// How many times as many vertices a level may have: four where each edge is split, as where the threshold is
// lower than usual. Representatives on surfaces need less, and after two levels hardly any; noisy points that
// are not reduced never cease to.
constexpr double kAllSplit = 4;
constexpr double kNoiseSplit = 3;
constexpr double kMostSplit = 3.2;
constexpr double kFewSplit = 1.5;
constexpr int kLevelsOfGrowth = 2;

double growth(const MultiresolutionParameters& parameters) {
  const int levels = parameters.refinement.levels;
  if (levels == 0) return 1;
  if (parameters.refinement.threshold < RefinementParameters().threshold) return std::pow(kAllSplit, levels);
  if (!parameters.reduce) return kAllSplit * std::pow(kNoiseSplit, levels - 1);
  const int first = std::min(levels, kLevelsOfGrowth);
  return std::pow(kMostSplit, first) * std::pow(kFewSplit, levels - first);
}

}  // namespace

std::uint64_t peakMemoryEstimate(std::size_t points, std::size_t point_bytes,
                                 const MultiresolutionParameters& parameters) {
  const double count = static_cast<double>(points);
  double vertices = count * growth(parameters);
  if (parameters.reduce) vertices *= std::min(1.0, 1 / (kPointsPerCluster * parameters.clustering.max_size));
  const double more_fields = std::max(0.0, static_cast<double>(point_bytes) - kUsualPointBytes);
  const double at_edges =
      parameters.reduce && parameters.features.detect ? kBytesAtEdges * std::sqrt(count) : 0;
  return static_cast<std::uint64_t>(kBytesPerPoint * count + at_edges +
                                    (kBytesPerVertex + kCopiesOfFields * more_fields) * vertices);
}

}  // namespace mlsmesh
