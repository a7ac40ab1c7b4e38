// SPDX-License-Identifier: BSD-3-Clause
#include "shapes/round_shapes.h"

#include <algorithm>

namespace mlsmesh::shapes {
namespace {

constexpr double kPi = 3.141592653589793;
constexpr double kTubeRadius = 0.4;
constexpr double kCylinderRadius = 0.6;

/// v / |v|, or `otherwise` where v has no direction.
Vec3 direction(const Vec3& v, const Vec3& otherwise) {
  const double length = v.norm();
  return length > 0.0 ? Vec3(v / length) : otherwise;
}

/// Nearest point of the torus' core circle.
Vec3 corePoint(const Vec3& x) {
  return direction({x.x(), x.y(), 0.0}, Vec3::UnitX());
}

}  // namespace

Eigen::AlignedBox3d Sphere::box() const {
  return {Vec3(-Vec3::Ones()), Vec3(Vec3::Ones())};
}

std::vector<Vec3> Sphere::sample(std::size_t count, Random& random) const {
  std::vector<Vec3> points(count);
  for (Vec3& point : points) point = random.direction();
  return points;
}

Vec3 Sphere::closestPoint(const Vec3& x) const {
  return direction(x, Vec3::UnitX());
}

Eigen::AlignedBox3d Torus::box() const {
  const Vec3 half(1.0 + kTubeRadius, 1.0 + kTubeRadius, kTubeRadius);
  return {Vec3(-half), half};
}

std::vector<Vec3> Torus::sample(std::size_t count, Random& random) const {
  std::vector<Vec3> points;
  points.reserve(count);
  while (points.size() < count) {
    const double tube_angle = random.uniform(0.0, 2.0 * kPi);
    const double circle_angle = random.uniform(0.0, 2.0 * kPi);
    const double radius = 1.0 + kTubeRadius * std::cos(tube_angle);
    if (random.uniform() * (1.0 + kTubeRadius) > radius) continue;
    points.emplace_back(radius * std::cos(circle_angle), radius * std::sin(circle_angle),
                        kTubeRadius * std::sin(tube_angle));
  }
  return points;
}

Vec3 Torus::closestPoint(const Vec3& x) const {
  const Vec3 core = corePoint(x);
  return core + kTubeRadius * direction(x - core, Vec3::UnitZ());
}

Vec3 Torus::normal(const Vec3& on_surface) const {
  return (on_surface - corePoint(on_surface)).normalized();
}

Eigen::AlignedBox3d Cylinder::box() const {
  const Vec3 half(kCylinderRadius, 1.0, kCylinderRadius);
  return {Vec3(-half), half};
}

std::vector<Vec3> Cylinder::sample(std::size_t count, Random& random) const {
  std::vector<Vec3> points(count);
  for (Vec3& point : points) {
    const double angle = random.uniform(0.0, 2.0 * kPi);
    const double height = random.uniform(-1.0, 1.0);
    point = {kCylinderRadius * std::cos(angle), height, kCylinderRadius * std::sin(angle)};
  }
  return points;
}

Vec3 Cylinder::closestPoint(const Vec3& x) const {
  const Vec3 outward = normal(x);
  return kCylinderRadius * outward + std::clamp(x.y(), -1.0, 1.0) * Vec3::UnitY();
}

Vec3 Cylinder::normal(const Vec3& on_surface) const {
  return direction({on_surface.x(), 0.0, on_surface.z()}, Vec3::UnitX());
}

}  // namespace mlsmesh::shapes
