// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/types.h"

#include <cmath>

// Signs of determinants of coordinates as they are, without rounding error. Exact for finite coordinates that
// are zero or differ in magnitude by no more than 2^300.
namespace mlsmesh::core {

/// The sign of a value known up to `error`, if that is certain, else 0. Allows for underflow besides.
inline int clearSign(double value, double error) {
  const double limit = error + 1e-290;
  return value > limit ? 1 : value < -limit ? -1 : 0;
}

/// Sign (-1, 0, 1) of (b - a) x (c - a) . (d - a): 1 where a, b, c run counter-clockwise seen from d.
int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
/// The same if doubles can tell it for certain, else 0.
int clearOrientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Sign of the area of a, b, c seen against `axis` (0, 1, 2): 1 where they run counter-clockwise.
int orientationAlong(int axis, const Vec3& a, const Vec3& b, const Vec3& c);
/// The same if doubles can tell it for certain, else 0.
inline int clearOrientationAlong(int axis, const Vec3& a, const Vec3& b, const Vec3& c) {
  constexpr double kErrorBound = 3.0000000000000018 * 0x1p-53;
  const int i = axis == 2 ? 0 : axis + 1, j = axis == 0 ? 2 : axis - 1;
  const double left = (b[i] - a[i]) * (c[j] - a[j]), right = (b[j] - a[j]) * (c[i] - a[i]);
  return clearSign(left - right, kErrorBound * (std::abs(left) + std::abs(right)));
}

/// Whether the three lie on one line, or some of them coincide. Corners that are not finite count as
/// collinear.
bool areCollinear(const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace mlsmesh::core
