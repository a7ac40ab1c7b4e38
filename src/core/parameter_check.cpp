// SPDX-License-Identifier: BSD-3-Clause
#include "mlsmesh/core/parameter_check.h"

#include <cmath>
#include <limits>
#include <sstream>
#include <string>

#include "mlsmesh/core/failure.h"

namespace mlsmesh::core {

namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

template <typename Value>
[[noreturn]] void refuse(const char* member, Value value, const std::string& range) {
  std::ostringstream text;
  text << member << " is " << value << "; it must be " << range;
  throw Failure(StatusCode::InvalidParameter, text.str());
}

std::string text(double bound) {
  std::ostringstream stream;
  stream << bound;
  return stream.str();
}

template <typename Value>
void checkRange(const char* member, Value value, double low, double high) {
  if (value >= low && value <= high) return;
  refuse(member, value, text(low) + " .. " + text(high));
}

template <typename Value>
void checkAtLeast(const char* member, Value value, double low) {
  if (value >= low && value < kUnbounded) return;
  refuse(member, value, "at least " + text(low) + " and finite");
}

void checkPositive(const char* member, double value) {
  if (value > 0 && value < kUnbounded) return;
  refuse(member, value, "greater than 0 and finite");
}

}  // namespace

void check(const ClusteringParameters& parameters) {
  checkRange("clustering.max_variation", parameters.max_variation, 0, 1.0 / 3);
  checkAtLeast("clustering.max_size", parameters.max_size, 1);
  checkAtLeast("clustering.min_leaf", parameters.min_leaf, 1);
  const double gap = parameters.max_gap;
  if (gap != 0 && !(gap > 1 && gap < kUnbounded))
    refuse("clustering.max_gap", gap, "0, or greater than 1 and finite");
}

void check(const ProjectionParameters& parameters) {
  checkRange("projection.neighbors", parameters.neighbors, 4, 512);
  checkRange("projection.degree", parameters.degree, 0, 3);
  checkPositive("projection.support_factor", parameters.support_factor);
  checkPositive("projection.tolerance", parameters.tolerance);
  checkRange("projection.max_iterations", parameters.max_iterations, 1, 1000);
}

void check(const NoiseParameters& parameters) {
  checkRange("noise.sigma", parameters.sigma, -1, 1000);
  checkAtLeast("noise.residual_limit", parameters.residual_limit, 0);
}

void check(const OutlierParameters& parameters) {
  checkPositive("outliers.link", parameters.link);
  checkAtLeast("outliers.smallest_group", parameters.smallest_group, 1);
}

void check(const FeatureParameters& parameters) {
  checkRange("features.angle", parameters.angle, 10, 80);
  checkRange("features.spacing", parameters.spacing, 1, 4);
  checkPositive("features.max_noise", parameters.max_noise);
  checkPositive("features.threshold_share", parameters.threshold_share);
}

void check(const TriangulationParameters& parameters) {
  checkRange("triangulation.neighbors", parameters.neighbors, 4, 512);
  checkRange("triangulation.bend_first", parameters.bend_first, 0, 180);
  checkPositive("triangulation.bend_step", parameters.bend_step);
  checkRange("triangulation.bend_max", parameters.bend_max, 0, 180);
  checkPositive("triangulation.length_factor", parameters.length_factor);
  checkRange("triangulation.fill_max_edges", parameters.fill_max_edges, 3, 64);
  checkPositive("triangulation.fill_max_perimeter", parameters.fill_max_perimeter);
  checkRange("triangulation.fill_supported_edges", parameters.fill_supported_edges, 0, 64);
  checkAtLeast("triangulation.support_reach", parameters.support_reach, 0);
  checkAtLeast("triangulation.fill_reach", parameters.fill_reach, 0);
}

void check(const RefinementParameters& parameters) {
  checkRange("refinement.levels", parameters.levels, 0, 10);
  checkAtLeast("refinement.threshold", parameters.threshold, 0);
  checkRange("refinement.min_edge_ratio", parameters.min_edge_ratio, 0, 1);
  checkPositive("refinement.max_displacement", parameters.max_displacement);
  checkAtLeast("refinement.border_displacement", parameters.border_displacement, 0);
  checkRange("refinement.fold_angle", parameters.fold_angle, 0, 180);
}

void check(const MultiresolutionParameters& parameters) {
  checkAtLeast("min_representatives", parameters.min_representatives, 3);
  checkAtLeast("hole_size", parameters.hole_size, 0);
  check(parameters.clustering);
  check(parameters.features);
  check(parameters.projection);
  check(parameters.noise);
  check(parameters.outliers);
  check(parameters.triangulation);
  check(parameters.refinement);
}

}  // namespace mlsmesh::core
