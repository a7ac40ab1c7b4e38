// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "shapes/shape.h"

#include <cstdint>
#include <vector>

namespace mlsmesh::shapes {

/// What a virtual scanner does to a surface. Lengths are shares of the diagonal of the shape's box.
struct ScanOptions {
  std::size_t count = 50000;  ///< points on the surface
  double noise = 0.0;         ///< standard deviation of every coordinate, >= 0
  double outliers = 0.0;      ///< points that lie anywhere, as a share of `count` and on top of it, >= 0
  int density_axis = 1;       ///< 0, 1, 2: x, y, z
  double density_ratio =
      1.0;        ///< density falls by this factor from the low to the high end of the axis, >= 1
  int views = 0;  ///< scanner positions around the shape; what none of them sees is left out; 0: no scanner
  std::uint64_t seed = 1;
};

struct Scan {
  std::vector<Vec3> points;
  std::vector<Vec3> surface_points;  ///< of the same index: before noise; an outlier's own place
  std::vector<bool> is_outlier;
};

/// The same shape and options give the same bits. Outliers are uniform in the shape's box grown by a tenth of
/// its sides in every direction, and stand at random places of the list. At most a few `count` calls of
/// Shape::sample, and a ray a point and view.
Scan scan(const Shape& shape, const ScanOptions& options);

/// Where the scanners stand: `views` directions of a Fibonacci sphere, twice the diagonal away from the box's
/// centre.
std::vector<Vec3> scannerPositions(const Shape& shape, int views);

/// Whether a scanner at `from` sees the point of the surface: the surface does not stand between the two, and
/// is met at less than 80 degrees from its normal (either side of it).
bool isSeen(const Shape& shape, const Vec3& on_surface, const Vec3& from);

}  // namespace mlsmesh::shapes
