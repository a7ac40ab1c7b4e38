// SPDX-License-Identifier: BSD-3-Clause
#include "shapes/line_sampling.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace mlsmesh::shapes {
namespace {

using core::Vec3;

constexpr double kOneRootShare =
    0.125;  ///< a sign change over this share of a cell is taken for a single crossing
constexpr double kTouchingShare = 1e-6;  ///< two crossings nearer than this share of a cell may be missed
constexpr int kMaxRootSteps = 100;

/// The part of the line that lies in the cube, as t0 <= t1; t0 > t1 if it misses.
std::pair<double, double> clipToCube(const Vec3& origin, const Vec3& direction, const Vec3& center,
                                     double half_side) {
  double t0 = -std::numeric_limits<double>::infinity();
  double t1 = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const double inverse = 1.0 / direction[axis];
    const double a = (center[axis] - half_side - origin[axis]) * inverse;
    const double b = (center[axis] + half_side - origin[axis]) * inverse;
    t0 = std::max(t0, std::min(a, b));
    t1 = std::min(t1, std::max(a, b));
  }
  return {t0, t1};
}

}  // namespace

LineSampler::LineSampler(Field field, const Eigen::AlignedBox3d& box, int depth)
    : field_(std::move(field)), box_(box) {
  const double half_side = 0.5 * box.sizes().maxCoeff();
  half_side_ = std::ldexp(half_side, -depth);
  collectCells(box.center(), half_side, depth);
}

void LineSampler::collectCells(const Vec3& center, double half_side, int depth) {
  const Vec3 half = Vec3::Constant(half_side);
  if (!box_.intersects(Eigen::AlignedBox3d(center - half, center + half))) return;
  if (std::abs(field_(center).value) > std::sqrt(3.0) * half_side) return;
  if (depth == 0) {
    cells_.push_back(center);
    return;
  }
  for (int child = 0; child < 8; ++child) {
    const Vec3 side((child & 1) != 0 ? 0.5 : -0.5, (child & 2) != 0 ? 0.5 : -0.5,
                    (child & 4) != 0 ? 0.5 : -0.5);
    collectCells(center + half_side * side, 0.5 * half_side, depth - 1);
  }
}

LineSampler::Line LineSampler::randomLine(const Vec3& center, Random& random) const {
  const Vec3 direction = random.direction();
  const Vec3 across = direction.unitOrthogonal();
  const double radius = std::sqrt(3.0 * random.uniform()) * half_side_;
  const double angle = random.uniform(0.0, 6.283185307179586);
  const Vec3 offset = radius * (std::cos(angle) * across + std::sin(angle) * direction.cross(across));
  return {center + offset, direction};
}

void LineSampler::appendCrossings(Random& random, std::vector<Vec3>& points) const {
  const Vec3& center = cells_[random.index(cells_.size())];
  const Line line = randomLine(center, random);
  const auto [t0, t1] = clipToCube(line.origin, line.direction, center, half_side_);
  if (!(t0 < t1)) return;
  const std::size_t first = points.size();
  appendRoots(line, t0, field_(line.at(t0)).value, t1, field_(line.at(t1)).value, points);
  const auto outside = [this](const Vec3& point) { return !box_.contains(point); };
  points.erase(std::remove_if(points.begin() + static_cast<std::ptrdiff_t>(first), points.end(), outside),
               points.end());
}

void LineSampler::appendRoots(const Line& line, double t0, double f0, double t1, double f1,
                              std::vector<Vec3>& points) const {
  const double length = t1 - t0;
  if (std::abs(f0) + std::abs(f1) > length) return;  // too steep a way down to 0 and up again
  const bool changes_sign = (f0 < 0.0) != (f1 < 0.0);
  if (changes_sign && length < kOneRootShare * half_side_) {
    points.push_back(line.at(root(line, t0, f0, t1)));
    return;
  }
  if (length < kTouchingShare * half_side_) return;
  const double middle = 0.5 * (t0 + t1);
  const double f_middle = field_(line.at(middle)).value;
  appendRoots(line, t0, f0, middle, f_middle, points);
  appendRoots(line, middle, f_middle, t1, f1, points);
}

double LineSampler::root(const Line& line, double t0, double f0, double t1) const {
  // Newton's method, kept within a shrinking bracket.
  double t = 0.5 * (t0 + t1);
  for (int i = 0; i < kMaxRootSteps; ++i) {
    const ValueAndGradient f = field_(line.at(t));
    ((f.value < 0.0) == (f0 < 0.0) ? t0 : t1) = t;
    double next = t - f.value / f.gradient.dot(line.direction);
    if (!(next >= t0 && next <= t1)) next = 0.5 * (t0 + t1);
    const bool converged = std::abs(next - t) < 1e-14;
    t = next;
    if (converged) break;
  }
  return t;
}

}  // namespace mlsmesh::shapes
