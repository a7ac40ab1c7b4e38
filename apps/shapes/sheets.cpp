// SPDX-License-Identifier: BSD-3-Clause
#include "shapes/sheets.h"

#include <Eigen/LU>

#include <algorithm>

namespace mlsmesh::shapes {
namespace {

constexpr double kPi = 3.141592653589793;
constexpr double kHalfWidth = 0.35;
constexpr int kStartsPerSide = 24;
constexpr int kMaxSteps = 200;
constexpr double kConverged = 1e-13;  // parameter step

}  // namespace

void Sheet::prepare() {
  for (int i = 0; i < kStartsPerSide; ++i) {
    for (int j = 0; j < kStartsPerSide; ++j) {
      const Eigen::Vector2d fraction((i + 0.5) / kStartsPerSide, (j + 0.5) / kStartsPerSide);
      const Eigen::Vector2d uv = domain_.min + fraction.cwiseProduct(domain_.max - domain_.min);
      start_parameters_.push_back(uv);
      start_points_.push_back(jet(uv).position);
    }
  }
}

std::vector<Vec3> Sheet::sample(std::size_t count, Random& random) const {
  std::vector<Vec3> points;
  points.reserve(count);
  while (points.size() < count) {
    const double u = random.uniform(domain_.min.x(), domain_.max.x());
    const double v = random.uniform(domain_.min.y(), domain_.max.y());
    const Jet place = jet({u, v});
    const double area_element = place.du.cross(place.dv).norm();
    if (random.uniform() * max_area_element_ <= area_element) points.push_back(place.position);
  }
  return points;
}

Eigen::Vector2d Sheet::closestStart(const Vec3& x) const {
  std::size_t best = 0;
  for (std::size_t i = 1; i < start_points_.size(); ++i) {
    if ((x - start_points_[i]).squaredNorm() < (x - start_points_[best]).squaredNorm()) best = i;
  }
  return start_parameters_[best];
}

Eigen::Vector2d Sheet::clampToDomain(const Eigen::Vector2d& uv) const {
  Eigen::Vector2d clamped = uv.cwiseMax(domain_.min).cwiseMin(domain_.max);
  if (domain_.u_is_periodic) clamped.x() = uv.x();
  return clamped;
}

Eigen::Vector2d Sheet::descentStep(const Vec3& x, const Eigen::Vector2d& uv) const {
  const Jet place = jet(uv);
  const Vec3 offset = x - place.position;
  Eigen::Vector2d slope(offset.dot(place.du), offset.dot(place.dv));
  Eigen::Matrix2d metric;
  metric << place.du.squaredNorm(), place.du.dot(place.dv), place.du.dot(place.dv), place.dv.squaredNorm();
  // A parameter at its bound whose slope points outwards stays there.
  const Eigen::Vector2d tried = clampToDomain(uv + 1e-6 * slope.cwiseSign());
  for (int i = 0; i < 2; ++i) {
    if (tried[i] != uv[i] || slope[i] == 0.0) continue;
    slope[i] = 0.0;
    metric(0, 1) = metric(1, 0) = 0.0;
  }
  return metric.inverse() * slope;
}

Eigen::Vector2d Sheet::closestParameters(const Vec3& x) const {
  Eigen::Vector2d uv = closestStart(x);
  double best = (x - jet(uv).position).squaredNorm();
  for (int i = 0; i < kMaxSteps; ++i) {
    Eigen::Vector2d step = descentStep(x, uv);
    Eigen::Vector2d next = clampToDomain(uv + step);
    double distance = (x - jet(next).position).squaredNorm();
    while (distance > best && step.norm() > kConverged) {
      step *= 0.5;
      next = clampToDomain(uv + step);
      distance = (x - jet(next).position).squaredNorm();
    }
    const bool converged = (next - uv).norm() < kConverged;
    if (distance <= best) uv = next;
    best = std::min(best, distance);
    if (converged) break;
  }
  return uv;
}

Vec3 Sheet::closestPoint(const Vec3& x) const {
  return jet(closestParameters(x)).position;
}

Vec3 Sheet::normal(const Vec3& on_surface) const {
  const Jet place = jet(closestParameters(on_surface));
  return place.du.cross(place.dv).normalized();
}

Saddle::Saddle() : Sheet({{-1.0, -1.0}, {1.0, 1.0}, false}, std::sqrt(3.0)) {
  prepare();
}

Eigen::AlignedBox3d Saddle::box() const {
  return {Vec3(-1.0, -0.5, -1.0), Vec3(1.0, 0.5, 1.0)};
}

double Saddle::borderDistanceBound(const Vec3& on_surface) const {
  return 1.0 - std::max(std::abs(on_surface.x()), std::abs(on_surface.z()));
}

Sheet::Jet Saddle::jet(const Eigen::Vector2d& uv) const {
  const double x = uv.x();
  const double z = uv.y();
  return {{x, 0.5 * (x * x - z * z), z}, {1.0, x, 0.0}, {0.0, -z, 1.0}};
}

Moebius::Moebius()
    : Sheet({{0.0, -kHalfWidth}, {2.0 * kPi, kHalfWidth}, true},
            std::hypot(1.0 + kHalfWidth, 0.5 * kHalfWidth)) {
  prepare();
  // The band is ruled, so its border spans its box; the border runs around twice.
  constexpr int kBorderSamples = 4096;
  for (int i = 0; i < kBorderSamples; ++i) {
    box_.extend(jet({4.0 * kPi * i / kBorderSamples, kHalfWidth}).position);
  }
}

double Moebius::borderDistanceBound(const Vec3& on_surface) const {
  // Straight across the band; along it the border comes no nearer than the angle between the two allows.
  return 0.9 * (kHalfWidth - std::abs(closestParameters(on_surface).y()));
}

Sheet::Jet Moebius::jet(const Eigen::Vector2d& uv) const {
  const double cos_u = std::cos(uv.x());
  const double sin_u = std::sin(uv.x());
  const double cos_half = std::cos(0.5 * uv.x());
  const double sin_half = std::sin(0.5 * uv.x());
  const double radius = 1.0 + uv.y() * cos_half;
  const double radius_du = -0.5 * uv.y() * sin_half;
  Jet place;
  place.position = {radius * cos_u, uv.y() * sin_half, -radius * sin_u};
  place.du = {radius_du * cos_u - radius * sin_u, 0.5 * uv.y() * cos_half,
              -radius_du * sin_u - radius * cos_u};
  place.dv = {cos_half * cos_u, sin_half, -cos_half * sin_u};
  return place;
}

}  // namespace mlsmesh::shapes
