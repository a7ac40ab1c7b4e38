// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/types.h"
#include "shapes/random.h"

#include <Eigen/Geometry>

#include <functional>
#include <vector>

namespace mlsmesh::shapes {

/// A field and its gradient at a place; 1-Lipschitz.
struct ValueAndGradient {
  double value;
  core::Vec3 gradient;
};
using Field = std::function<ValueAndGradient(const core::Vec3&)>;

/// Draws points uniform by area from the zero set of a field: the points at which isotropic random lines
/// cross a surface are uniform on it (Crofton), whatever its shape. The lines are drawn cell by cell, over
/// the equal cells of a grid that the surface may pass through.
class LineSampler {
 public:
  /// O(surface cells); `depth` halvings of the box's longest side make the grid.
  LineSampler(Field field, const Eigen::AlignedBox3d& box, int depth);

  /// Appends the points at which one random line crosses the surface within one random cell; often none.
  void appendCrossings(Random& random, std::vector<core::Vec3>& points) const;

 private:
  struct Line {
    core::Vec3 origin;
    core::Vec3 direction;
    core::Vec3 at(double t) const { return origin + t * direction; }
  };
  void collectCells(const core::Vec3& center, double half_side, int depth);
  Line randomLine(const core::Vec3& center, Random& random) const;
  void appendRoots(const Line& line, double t0, double f0, double t1, double f1,
                   std::vector<core::Vec3>& points) const;
  double root(const Line& line, double t0, double f0, double t1) const;

  Field field_;
  Eigen::AlignedBox3d box_;
  double half_side_ = 0.0;  ///< of a cell
  std::vector<core::Vec3> cells_;
};

}  // namespace mlsmesh::shapes
