// SPDX-License-Identifier: BSD-3-Clause
#include "shapes/scan.h"

#include <algorithm>
#include <cmath>

namespace mlsmesh::shapes {
namespace {

constexpr double kGoldenAngle = 2.399963229728653;
constexpr double kMinCosine = 0.17364817766693033;  // of 80 degrees
// Rays start this far from the surface and have hit it when they are so near, in diagonals.
constexpr double kRayStart = 2e-3;
constexpr double kRayHit = 5e-5;
constexpr std::size_t kBatch = 4096;

/// Share of the points that the density gradient keeps at x.
double keptShare(const Eigen::AlignedBox3d& box, const ScanOptions& options, const Vec3& x) {
  const int axis = options.density_axis;
  const double height = (x[axis] - box.min()[axis]) / std::max(box.sizes()[axis], 1e-12);
  return std::pow(options.density_ratio, -height);
}

void appendOutliers(const Shape& shape, std::size_t count, Random& random, Scan& result) {
  const Eigen::AlignedBox3d box = shape.box();
  const Vec3 margin = 0.1 * box.sizes();
  for (std::size_t i = 0; i < count; ++i) {
    Vec3 place;
    for (int axis = 0; axis < 3; ++axis) {
      place[axis] = random.uniform(box.min()[axis] - margin[axis], box.max()[axis] + margin[axis]);
    }
    result.points.push_back(place);
    result.surface_points.push_back(place);
    result.is_outlier.push_back(true);
  }
}

void shuffle(Random& random, Scan& result) {
  for (std::size_t i = result.points.size(); i > 1; --i) {
    const std::size_t other = random.index(i);
    std::swap(result.points[i - 1], result.points[other]);
    std::swap(result.surface_points[i - 1], result.surface_points[other]);
    std::vector<bool>::swap(result.is_outlier[i - 1], result.is_outlier[other]);
  }
}

}  // namespace

std::vector<Vec3> scannerPositions(const Shape& shape, int views) {
  const Vec3 center = shape.box().center();
  std::vector<Vec3> positions;
  for (int i = 0; i < views; ++i) {
    const double height = 1.0 - (2.0 * i + 1.0) / views;
    const double radius = std::sqrt(1.0 - height * height);
    const Vec3 direction(radius * std::cos(i * kGoldenAngle), height, radius * std::sin(i * kGoldenAngle));
    positions.push_back(center + 2.0 * shape.diagonal() * direction);
  }
  return positions;
}

bool isSeen(const Shape& shape, const Vec3& on_surface, const Vec3& from) {
  const double diagonal = shape.diagonal();
  const Vec3 way = from - on_surface;
  const double length = way.norm();
  const Vec3 direction = way / length;
  if (std::abs(direction.dot(shape.normal(on_surface))) < kMinCosine) return false;
  for (double t = kRayStart * diagonal; t < std::min(length, diagonal);) {
    const double free = shape.distanceBound(on_surface + t * direction);
    if (free < kRayHit * diagonal) return false;
    t += free;
  }
  return true;
}

Scan scan(const Shape& shape, const ScanOptions& options) {
  Random random(options.seed);
  const Eigen::AlignedBox3d box = shape.box();
  const std::vector<Vec3> scanners = scannerPositions(shape, options.views);
  const auto isKept = [&](const Vec3& point) {
    if (options.density_ratio > 1.0 && random.uniform() > keptShare(box, options, point)) return false;
    return scanners.empty() || std::any_of(scanners.begin(), scanners.end(), [&](const Vec3& scanner) {
             return isSeen(shape, point, scanner);
           });
  };
  Scan result;
  result.surface_points.reserve(options.count);
  while (result.surface_points.size() < options.count) {
    for (const Vec3& point : shape.sample(std::min(kBatch, options.count), random)) {
      if (result.surface_points.size() < options.count && isKept(point))
        result.surface_points.push_back(point);
    }
  }
  for (const Vec3& point : result.surface_points) {
    result.points.push_back(point);
    if (options.noise > 0.0) result.points.back() += options.noise * shape.diagonal() * random.normalVector();
  }
  result.is_outlier.assign(options.count, false);
  const auto outliers =
      static_cast<std::size_t>(std::llround(options.outliers * static_cast<double>(options.count)));
  appendOutliers(shape, outliers, random, result);
  if (outliers > 0) shuffle(random, result);
  return result;
}

}  // namespace mlsmesh::shapes
