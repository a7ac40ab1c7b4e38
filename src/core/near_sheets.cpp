// SPDX-License-Identifier: BSD-3-Clause
// Two sheets that a neighbourhood sees at once pull each other's fit to the middle between them. Where both
// are flat at its scale, the direction across them is a principal axis of the whole, of whatever rank (or,
// where that has no definite ones, of the points nearest to the first), and the points leave a gap along it.
#include "near_sheets.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace mlsmesh::core {
namespace {

constexpr std::size_t kLeastPoints = 6;
constexpr std::array<std::size_t, 3> kNearest = {7, 11, 16};  // that are on one sheet, hopefully
constexpr double kScatter = 0.25;                             // of a sheet along its normal, in gaps
constexpr double kAcross = 0.9;  // cosine between the normal of a sheet and the axis that it was found by
constexpr double kAside = 0.8;   // distance of the sheets' centroids along them, in radii of gyration
constexpr double kLine = 0.05;   // ratio of the spreads in a sheet below which it is a line

using Solver = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>;

// Of the first `count`.
Solver principalAxes(const std::vector<Vec3>& offsets, std::size_t count) {
  Vec3 mean = Vec3::Zero();
  for (std::size_t i = 0; i < count; ++i) mean += offsets[i];
  mean /= static_cast<double>(count);
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < count; ++i)
    covariance.noalias() += (offsets[i] - mean) * (offsets[i] - mean).transpose();
  Solver solver;
  solver.computeDirect(covariance);
  return solver;
}

// Directions in which the sheets may lie above each other.
std::vector<Vec3> candidates(const std::vector<Vec3>& offsets) {
  const Eigen::Matrix3d whole = principalAxes(offsets, offsets.size()).eigenvectors();
  std::vector<Vec3> axes{whole.col(0), whole.col(1), whole.col(2)};
  for (const std::size_t nearest : kNearest) {
    if (nearest < offsets.size()) axes.push_back(principalAxes(offsets, nearest).eigenvectors().col(0));
  }
  return axes;
}

// The heights about 0 without a gap of `least_gap` between them.
struct Layer {
  double lowest = 0, highest = 0;
  double gap_below = std::numeric_limits<double>::infinity();
  double gap_above = std::numeric_limits<double>::infinity();

  double gap() const { return std::min(gap_below, gap_above); }
};

Layer layerOfZero(std::vector<double>& heights, double least_gap) {
  std::sort(heights.begin(), heights.end());
  const auto zero = std::lower_bound(heights.begin(), heights.end(), 0.0);
  auto first = zero, last = zero;
  Layer layer;
  while (first != heights.begin() && *first - *std::prev(first) < least_gap) --first;
  while (std::next(last) != heights.end() && *std::next(last) - *last < least_gap) ++last;
  layer.lowest = *first;
  layer.highest = *last;
  if (first != heights.begin()) layer.gap_below = *first - *std::prev(first);
  if (std::next(last) != heights.end()) layer.gap_above = *std::next(last) - *last;
  return layer;
}

Vec3 meanOf(const std::vector<Vec3>& offsets) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& d : offsets) sum += d;
  return sum / static_cast<double>(offsets.size());
}

// Whether the points within the layer are a flat sheet across the axis, and the others lie over or under it:
// terraces, as of quantised depths, lie beside each other.
bool isSheetUnderOthers(const std::vector<Vec3>& offsets, const Vec3& axis, const Layer& layer) {
  std::vector<Vec3> own, others;
  for (const Vec3& d : offsets) {
    const double height = axis.dot(d);
    (layer.lowest <= height && height <= layer.highest ? own : others).push_back(d);
  }
  if (own.size() < kLeastPoints) return false;
  const Solver solver = principalAxes(own, own.size());
  const Vec3 spread = solver.eigenvalues().cwiseMax(0.0) / static_cast<double>(own.size());
  const Vec3 aside = (meanOf(others) - meanOf(own)).cross(axis);
  return std::sqrt(spread[0]) <= kScatter * layer.gap() && spread[1] >= kLine * spread[2] &&
         std::abs(solver.eigenvectors().col(0).dot(axis)) >= kAcross &&
         aside.squaredNorm() <= kAside * kAside * (spread[1] + spread[2]);
}

}  // namespace

std::optional<Slab> sheetOfFirst(const std::vector<Vec3>& points, const Index* neighbors, int count,
                                 double least_gap) {
  if (static_cast<std::size_t>(count) <= kLeastPoints) return std::nullopt;
  const Vec3& first = points[neighbors[0]];
  std::vector<Vec3> offsets;
  for (int i = 0; i < count; ++i) offsets.push_back(points[neighbors[i]] - first);
  std::vector<double> heights(offsets.size());
  for (const Vec3& axis : candidates(offsets)) {
    std::transform(offsets.begin(), offsets.end(), heights.begin(),
                   [&](const Vec3& d) { return axis.dot(d); });
    const Layer layer = layerOfZero(heights, least_gap);
    if (std::isinf(layer.gap()) || !isSheetUnderOthers(offsets, axis, layer)) continue;
    const double at = axis.dot(first);
    return Slab{axis, at + layer.lowest - 0.5 * layer.gap_below, at + layer.highest + 0.5 * layer.gap_above,
                layer.gap()};
  }
  return std::nullopt;
}

}  // namespace mlsmesh::core
