// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "shapes/field.h"
#include "shapes/line_sampling.h"
#include "shapes/shape.h"

namespace mlsmesh::shapes {

/// A sitting elephant that looks along +x: thin ears and tusks, a raised trunk, and a tail that grows back
/// into its shoulders as a handle. A smooth union of tubes, ellipsoids and dishes, cut open by the plane y =
/// 0 it sits on: genus 1 with one border loop. Its normal is continuous.
class Figure : public Shape {
 public:
  Figure();
  std::string name() const override { return "figure"; }
  Topology topology() const override { return {-1, 1, true}; }
  Eigen::AlignedBox3d box() const override { return box_; }
  std::vector<Vec3> sample(std::size_t count, Random& random) const override;
  Vec3 closestPoint(const Vec3& x) const override;
  Vec3 normal(const Vec3& on_surface) const override { return solid_.at(on_surface).gradient.normalized(); }
  double distanceBound(const Vec3& x) const override;
  double borderDistanceBound(const Vec3& on_surface) const override { return on_surface.y(); }
  Vec3 color(const Vec3& x) const override { return solid_.at(x).color; }

  /// The field whose zero set, above y = 0, is the surface; negative inside, 1-Lipschitz.
  double implicitValue(const Vec3& x) const { return solid_.at(x).value; }

 private:
  Solid solid_;
  Eigen::AlignedBox3d box_;
  LineSampler sampler_;
};

}  // namespace mlsmesh::shapes
