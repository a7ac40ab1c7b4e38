// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/types.h"

#include <Eigen/Geometry>

#include <array>
#include <memory>
#include <vector>

namespace mlsmesh::shapes {

using core::Vec3;

/// A value of a scalar field that is negative inside a solid, with its gradient and the solid's colour there.
struct FieldValue {
  double value = 0.0;
  Vec3 gradient = Vec3::Zero();
  Vec3 color = Vec3::Zero();
};

/// A part of a solid. Its field is 1-Lipschitz: |value| is at most the distance of the part's surface.
class Part {
 public:
  virtual ~Part() = default;
  /// `color` of the result is left unset.
  virtual FieldValue at(const Vec3& x) const = 0;
  /// A cheap lower bound of at(x).value.
  virtual double lowerBound(const Vec3& x) const = 0;
};

/// An ellipsoid with axes along x, y, z.
class Ellipsoid : public Part {
 public:
  Ellipsoid(const Vec3& center, const Vec3& radii) : center_(center), radii_(radii) {}
  FieldValue at(const Vec3& x) const override;
  double lowerBound(const Vec3& x) const override;

 private:
  Vec3 center_;
  Vec3 radii_;
};

/// All points within `half_thickness` of a spherical cap: a dish with a round rim.
class Dish : public Part {
 public:
  /// The cap of the sphere (center, radius) within `opening` (radians, < pi / 2) of the unit vector `axis`.
  Dish(const Vec3& center, const Vec3& axis, double radius, double opening, double half_thickness);
  FieldValue at(const Vec3& x) const override;
  double lowerBound(const Vec3& x) const override;

 private:
  Vec3 nearestOfCap(const Vec3& x) const;

  Vec3 center_;
  Vec3 axis_;
  double radius_;
  double cos_opening_;
  double sin_opening_;
  double half_thickness_;
};

/// The union of the balls whose centre and radius run along a uniform cubic B-spline from the first control
/// ball to the last: a tube of varying radius with round ends. Its surface has a continuous normal.
class Tube : public Part {
 public:
  struct Ball {
    Vec3 center = Vec3::Zero();
    double radius = 0.0;
  };
  /// At least two control balls.
  explicit Tube(const std::vector<Ball>& control);
  FieldValue at(const Vec3& x) const override;
  double lowerBound(const Vec3& x) const override;

 private:
  struct Jet {
    Ball ball;
    Ball first;   ///< derivative by the parameter
    Ball second;  ///< second derivative
  };
  Jet jet(double t) const;
  /// Parameter of the ball that is nearest to x.
  double nearestBall(const Vec3& x) const;
  double refine(const Vec3& x, double low, double high, double t) const;

  std::vector<Ball> control_;  ///< with one phantom ball at either end
  std::vector<Ball> samples_;  ///< kSamplesPerSpan a span, and the last
  Eigen::AlignedBox3d box_;    ///< of all balls
  double max_radius_;
};

/// Parts joined by smooth unions (Quilez's cubic polynomial minimum: twice differentiable, exact farther than
/// the blend width apart), colours mixed in the same proportion. 1-Lipschitz.
class Solid {
 public:
  /// Joins `part` to what is there, with blends as wide as `blend` > 0.
  void add(std::unique_ptr<Part> part, double blend, const Vec3& color);
  /// At least one part must have been added.
  FieldValue at(const Vec3& x) const;

 private:
  struct Member {
    std::unique_ptr<Part> part;
    double blend;
    Vec3 color;
  };
  std::vector<Member> members_;
};

}  // namespace mlsmesh::shapes
