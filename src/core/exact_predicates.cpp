// SPDX-License-Identifier: BSD-3-Clause
// This work is based on J. R. Shewchuk, "Adaptive precision floating-point arithmetic and fast robust
// geometric predicates", Discrete & Computational Geometry 18, 1997: its error bounds for the plain
// determinants, and sums of doubles without rounding (grow-expansion) where those bounds cannot tell.
#include "exact_predicates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace mlsmesh::core {
namespace {

constexpr double kHalfUlp = std::numeric_limits<double>::epsilon() / 2;
constexpr double kErrorBound = (7 + 56 * kHalfUlp) * kHalfUlp;

// A sum of doubles without rounding: parts that do not overlap, none zero, the largest last.
class ExactSum {
 public:
  void add(double value) {
    int kept = 0;
    for (int i = 0; i < size_; ++i) {
      const double sum = value + parts_[i];
      const double rounded = sum - value;
      const double lost = (value - (sum - rounded)) + (parts_[i] - rounded);
      value = sum;
      if (lost != 0) parts_[kept++] = lost;
    }
    if (value != 0) parts_[kept++] = value;
    size_ = kept;
  }
  void addProduct(double a, double b) {
    const double product = a * b;
    add(std::fma(a, b, -product));
    add(product);
  }
  void addProduct(double a, double b, double c) {
    const double product = a * b;
    addProduct(std::fma(a, b, -product), c);
    addProduct(product, c);
  }
  int sign() const { return size_ == 0 ? 0 : parts_[size_ - 1] > 0 ? 1 : -1; }

 private:
  std::array<double, 192> parts_;  // six products of three differences, of two doubles each, four parts each
  int size_ = 0;
};

// A difference of doubles without rounding, as the sum of two.
using Difference = std::array<double, 2>;

Difference difference(double a, double b) {
  const double rounded = a - b;
  const double virtual_b = a - rounded;
  const double virtual_a = rounded + virtual_b;
  return {rounded, (a - virtual_a) + (virtual_b - b)};
}

void addProduct(const Difference& x, const Difference& y, double sign, ExactSum& sum) {
  for (const double p : x) {
    for (const double q : y) {
      if (p != 0 && q != 0) sum.addProduct(sign * p, q);
    }
  }
}

void addProduct(const Difference& x, const Difference& y, const Difference& z, double sign, ExactSum& sum) {
  for (const double p : x) {
    for (const double q : y) {
      for (const double r : z) {
        if (p != 0 && q != 0 && r != 0) sum.addProduct(sign * p, q, r);
      }
    }
  }
}

// The power of two that brings the largest coordinate near 1, so that products stay in range.
int scaleOf(std::initializer_list<const Vec3*> points) {
  double largest = 0;
  for (const Vec3* p : points) largest = std::max(largest, p->cwiseAbs().maxCoeff());
  return largest > 0 && std::isfinite(largest) ? -std::ilogb(largest) : 0;
}

std::array<Difference, 3> differences(const Vec3& a, const Vec3& b, int scale) {
  std::array<Difference, 3> result;
  for (int axis = 0; axis < 3; ++axis)
    result[axis] = difference(std::ldexp(a[axis], scale), std::ldexp(b[axis], scale));
  return result;
}

int exactOrientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const int scale = scaleOf({&a, &b, &c, &d});
  const auto u = differences(b, a, scale), v = differences(c, a, scale), w = differences(d, a, scale);
  ExactSum sum;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    addProduct(u[i], v[j], w[k], 1, sum);
    addProduct(u[j], v[i], w[k], -1, sum);
  }
  return sum.sign();
}

int exactOrientationAlong(int axis, const Vec3& a, const Vec3& b, const Vec3& c) {
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  const int scale = scaleOf({&a, &b, &c});
  const auto u = differences(b, a, scale), v = differences(c, a, scale);
  ExactSum sum;
  addProduct(u[i], v[j], 1, sum);
  addProduct(u[j], v[i], -1, sum);
  return sum.sign();
}

}  // namespace

int clearOrientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const double ux = b[0] - a[0], uy = b[1] - a[1], uz = b[2] - a[2];
  const double vx = c[0] - a[0], vy = c[1] - a[1], vz = c[2] - a[2];
  const double wx = d[0] - a[0], wy = d[1] - a[1], wz = d[2] - a[2];
  const double xy = ux * vy, yx = uy * vx, yz = uy * vz, zy = uz * vy, zx = uz * vx, xz = ux * vz;
  const double value = (xy - yx) * wz + (yz - zy) * wx + (zx - xz) * wy;
  const double size = (std::abs(xy) + std::abs(yx)) * std::abs(wz) +
                      (std::abs(yz) + std::abs(zy)) * std::abs(wx) +
                      (std::abs(zx) + std::abs(xz)) * std::abs(wy);
  return clearSign(value, kErrorBound * size);
}

int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const int sign = clearOrientation(a, b, c, d);
  return sign != 0 ? sign : exactOrientation(a, b, c, d);
}

int orientationAlong(int axis, const Vec3& a, const Vec3& b, const Vec3& c) {
  const int sign = clearOrientationAlong(axis, a, b, c);
  return sign != 0 ? sign : exactOrientationAlong(axis, a, b, c);
}

bool areCollinear(const Vec3& a, const Vec3& b, const Vec3& c) {
  if (!a.allFinite() || !b.allFinite() || !c.allFinite()) return true;
  for (int axis = 0; axis < 3; ++axis) {
    if (clearOrientationAlong(axis, a, b, c) != 0) return false;
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (exactOrientationAlong(axis, a, b, c) != 0) return false;
  }
  return true;
}

}  // namespace mlsmesh::core
