// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "shapes/shape.h"

namespace mlsmesh::shapes {

/// A surface given by S(u, v) over a rectangle; u may be periodic.
class Sheet : public Shape {
 public:
  std::vector<Vec3> sample(std::size_t count, Random& random) const override;
  Vec3 closestPoint(const Vec3& x) const override;
  Vec3 normal(const Vec3& on_surface) const override;

 protected:
  /// A place of the surface and its derivatives by u and v.
  struct Jet {
    Vec3 position;
    Vec3 du;
    Vec3 dv;
  };
  struct Domain {
    Eigen::Vector2d min;
    Eigen::Vector2d max;
    bool u_is_periodic;  ///< S is defined for every u, not for [min, max] alone
  };

  Sheet(const Domain& domain, double max_area_element)
      : domain_(domain), max_area_element_(max_area_element) {}
  /// Fills the table of starting places; to be called once, at the end of the derived class's constructor.
  void prepare();
  virtual Jet jet(const Eigen::Vector2d& uv) const = 0;
  /// Parameters of the nearest point of the surface.
  Eigen::Vector2d closestParameters(const Vec3& x) const;

 private:
  Eigen::Vector2d closestStart(const Vec3& x) const;
  Eigen::Vector2d clampToDomain(const Eigen::Vector2d& uv) const;
  Eigen::Vector2d descentStep(const Vec3& x, const Eigen::Vector2d& uv) const;

  Domain domain_;
  double max_area_element_;  ///< of |S_u x S_v|, for rejection
  std::vector<Eigen::Vector2d> start_parameters_;
  std::vector<Vec3> start_points_;
};

/// y = (x^2 - z^2) / 2 over the square |x|, |z| <= 1.
class Saddle : public Sheet {
 public:
  Saddle();
  std::string name() const override { return "saddle"; }
  Topology topology() const override { return {1, 1, true}; }
  Eigen::AlignedBox3d box() const override;
  double borderDistanceBound(const Vec3& on_surface) const override;

 protected:
  Jet jet(const Eigen::Vector2d& uv) const override;
};

/// A band of width 0.7 about the unit circle in the plane y = 0, turned by half a turn.
class Moebius : public Sheet {
 public:
  Moebius();
  std::string name() const override { return "moebius"; }
  Topology topology() const override { return {0, 1, false}; }
  Eigen::AlignedBox3d box() const override { return box_; }
  double borderDistanceBound(const Vec3& on_surface) const override;

 protected:
  Jet jet(const Eigen::Vector2d& uv) const override;

 private:
  Eigen::AlignedBox3d box_;
};

}  // namespace mlsmesh::shapes
