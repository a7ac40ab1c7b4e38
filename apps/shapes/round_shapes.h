// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "shapes/shape.h"

namespace mlsmesh::shapes {

/// Radius 1 about the origin.
class Sphere : public Shape {
 public:
  std::string name() const override { return "sphere"; }
  Topology topology() const override { return {2, 0, true}; }
  Eigen::AlignedBox3d box() const override;
  std::vector<Vec3> sample(std::size_t count, Random& random) const override;
  Vec3 closestPoint(const Vec3& x) const override;
  Vec3 normal(const Vec3& on_surface) const override { return on_surface.normalized(); }
};

/// A tube of radius 0.4 about the unit circle in the plane z = 0.
class Torus : public Shape {
 public:
  std::string name() const override { return "torus"; }
  Topology topology() const override { return {0, 0, true}; }
  Eigen::AlignedBox3d box() const override;
  std::vector<Vec3> sample(std::size_t count, Random& random) const override;
  Vec3 closestPoint(const Vec3& x) const override;
  Vec3 normal(const Vec3& on_surface) const override;
};

/// Radius 0.6 about the y axis, -1 <= y <= 1, without its discs.
class Cylinder : public Shape {
 public:
  std::string name() const override { return "cylinder"; }
  Topology topology() const override { return {0, 2, true}; }
  Eigen::AlignedBox3d box() const override;
  std::vector<Vec3> sample(std::size_t count, Random& random) const override;
  Vec3 closestPoint(const Vec3& x) const override;
  Vec3 normal(const Vec3& on_surface) const override;
  double borderDistanceBound(const Vec3& on_surface) const override { return 1.0 - std::abs(on_surface.y()); }
};

}  // namespace mlsmesh::shapes
