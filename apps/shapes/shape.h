// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/types.h"
#include "shapes/random.h"

#include <Eigen/Geometry>

#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace mlsmesh::shapes {

using core::Vec3;

/// What a mesh of a whole shape must come out as. All shapes are connected.
struct Topology {
  int euler = 2;  ///< V - E + F
  int border_loops = 0;
  bool orientable = true;
};

/// A surface known exactly: what makes virtual scans and what their reconstructions are measured against.
/// Sizes are of the order of 1; +y is up. Every member is const and safe to call from many threads.
class Shape {
 public:
  virtual ~Shape() = default;

  virtual std::string name() const = 0;
  virtual Topology topology() const = 0;
  /// Contains the surface; tight to 1 % of its diagonal.
  virtual Eigen::AlignedBox3d box() const = 0;
  double diagonal() const { return box().diagonal().norm(); }

  /// `count` points, each uniform by area, on the surface to 1e-9.
  virtual std::vector<Vec3> sample(std::size_t count, Random& random) const = 0;
  /// The nearest point of the surface: exact for sphere, torus and cylinder; for the others to 1e-9 where x
  /// is nearer to the surface than half its smallest radius of curvature, and some point of the surface
  /// elsewhere.
  virtual Vec3 closestPoint(const Vec3& x) const = 0;
  double distance(const Vec3& x) const { return (x - closestPoint(x)).norm(); }
  /// Unit normal at a point of the surface; outward for a shape that is closed or (the figure) nearly so.
  virtual Vec3 normal(const Vec3& on_surface) const = 0;

  /// At most the distance of x from the surface, near 0 only near it, and cheap: for marching along rays.
  virtual double distanceBound(const Vec3& x) const { return distance(x); }
  /// At most the distance of a point of the surface from its border; infinite if there is none.
  virtual double borderDistanceBound(const Vec3& /*on_surface*/) const {
    return std::numeric_limits<double>::infinity();
  }
  /// Red, green, blue in 0 .. 1, a smooth function of the place: by default of the position in the box.
  virtual Vec3 color(const Vec3& x) const;
};

/// "sphere" (radius 1), "torus" (1 and 0.4), "saddle" (y = (x^2 - z^2) / 2 over [-1, 1]^2), "cylinder"
/// (radius 0.6, height 2, open), "moebius" (radius 1, width 0.7), "figure" (a sitting elephant, its tail a
/// handle, open below).
const std::vector<std::string>& shapeNames();

/// Null if no shape has that name.
std::unique_ptr<Shape> makeShape(const std::string& name);

}  // namespace mlsmesh::shapes
