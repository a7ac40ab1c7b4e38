// SPDX-License-Identifier: BSD-3-Clause
#include "exact_predicates.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

namespace mlsmesh::core {
namespace {

__extension__ using Wide = __int128;
using Whole = std::array<std::int64_t, 3>;

int signOf(Wide value) {
  return value > 0 ? 1 : value < 0 ? -1 : 0;
}

Vec3 asDoubles(const Whole& p) {
  return Vec3(static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2]));
}

Wide doubleArea(int axis, const Whole& a, const Whole& b, const Whole& c) {
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  return Wide(b[i] - a[i]) * (c[j] - a[j]) - Wide(b[j] - a[j]) * (c[i] - a[i]);
}

Wide volume(const Whole& a, const Whole& b, const Whole& c, const Whole& d) {
  Wide sum = 0;
  for (int axis = 0; axis < 3; ++axis) sum += doubleArea(axis, a, b, c) * (d[axis] - a[axis]);
  return sum;
}

class WholePoints {
 public:
  WholePoints(std::int64_t largest, unsigned seed) : random_(seed), coordinate_(-largest, largest) {}
  Whole next() { return {coordinate_(random_), coordinate_(random_), coordinate_(random_)}; }

 private:
  std::mt19937_64 random_;
  std::uniform_int_distribution<std::int64_t> coordinate_;
};

TEST(ExactPredicates, AgreeWithWholeNumbers) {
  for (const std::int64_t largest : {1, 2, 1000, 1 << 30}) {
    WholePoints points(largest, 7);
    for (int i = 0; i < 20000; ++i) {
      const Whole a = points.next(), b = points.next(), c = points.next(), d = points.next();
      const Vec3 p = asDoubles(a), q = asDoubles(b), r = asDoubles(c), s = asDoubles(d);
      ASSERT_EQ(orientation(p, q, r, s), signOf(volume(a, b, c, d)));
      bool flat = true;
      for (int axis = 0; axis < 3; ++axis) {
        const int side = signOf(doubleArea(axis, a, b, c));
        ASSERT_EQ(orientationAlong(axis, p, q, r), side);
        flat = flat && side == 0;
      }
      ASSERT_EQ(areCollinear(p, q, r), flat);
    }
  }
}

TEST(ExactPredicates, SeeOneUnitInTheLastPlace) {
  WholePoints points(std::int64_t{1} << 50, 11);
  for (int i = 0; i < 20000; ++i) {
    const Whole a = points.next(), b = points.next(), c = points.next();
    Whole d;  // the fourth corner of their parallelogram
    for (int axis = 0; axis < 3; ++axis) d[axis] = b[axis] + c[axis] - a[axis];
    const Vec3 p = asDoubles(a), q = asDoubles(b), r = asDoubles(c);
    ASSERT_EQ(orientation(p, q, r, asDoubles(d)), 0);
    for (int axis = 0; axis < 3; ++axis) {
      for (const int step : {-1, 1}) {
        Whole off = d;
        off[axis] += step;
        ASSERT_EQ(orientation(p, q, r, asDoubles(off)), step * signOf(doubleArea(axis, a, b, c)));
      }
    }
  }
}

TEST(ExactPredicates, SeeOnALineWhatRoundingHides) {
  constexpr double kUlp = 0x1p-53;
  for (int i = 0; i < 64; ++i) {
    for (int j = 0; j < 64; ++j) {
      const Vec3 p(0.5 + i * kUlp, 0.5 + j * kUlp, 0), q(12, 12, 0), r(24, 24, 0);
      ASSERT_EQ(orientationAlong(2, p, q, r), signOf(j - i));
      ASSERT_EQ(areCollinear(p, q, r), i == j);
    }
  }
}

TEST(ExactPredicates, DoNotDependOnScale) {
  WholePoints points(3, 5);
  for (int i = 0; i < 2000; ++i) {
    const Whole a = points.next(), b = points.next(), c = points.next(), d = points.next();
    for (const int exponent : {-900, -340, -100, 100, 340, 900}) {
      const auto scaled = [&](const Whole& p) -> Vec3 { return std::ldexp(1.0, exponent) * asDoubles(p); };
      ASSERT_EQ(orientation(scaled(a), scaled(b), scaled(c), scaled(d)), signOf(volume(a, b, c, d)));
      ASSERT_EQ(orientationAlong(0, scaled(a), scaled(b), scaled(c)), signOf(doubleArea(0, a, b, c)));
    }
  }
}

TEST(ExactPredicates, ClearSignsAreRightOrZero) {
  WholePoints points(1 << 20, 3);
  int unclear = 0;
  for (int i = 0; i < 20000; ++i) {
    const Whole a = points.next(), b = points.next(), c = points.next(), d = points.next();
    const int clear = clearOrientation(asDoubles(a), asDoubles(b), asDoubles(c), asDoubles(d));
    ASSERT_EQ(clear * clear, clear * signOf(volume(a, b, c, d)));
    unclear += clear == 0;
  }
  EXPECT_LT(unclear, 20);
}

TEST(ExactPredicates, CornersThatAreNotFiniteAreCollinear) {
  const Vec3 o(0, 0, 0), x(1, 0, 0), y(0, 1, 0);
  EXPECT_FALSE(areCollinear(o, x, y));
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    EXPECT_TRUE(areCollinear(o, x, Vec3(0, bad, 0)));
}

}  // namespace
}  // namespace mlsmesh::core
