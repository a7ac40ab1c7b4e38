// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/types.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>

namespace mlsmesh::shapes {

/// Random numbers that are the same with every standard library: the engine is std::mt19937_64, whose output
/// the standard fixes, and the distributions, which it leaves open, are our own.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// Uniform in [0, 1), 53 random bits.
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }

  /// Uniform in 0 .. count - 1; count > 0. The bias is below count / 2^53.
  std::size_t index(std::size_t count) {
    return static_cast<std::size_t>(uniform() * static_cast<double>(count));
  }

  /// Mean 0, standard deviation 1 (Box and Muller 1958).
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(kTwoPi * uniform());
  }

  /// Uniform on the unit sphere.
  core::Vec3 direction() {
    const double z = uniform(-1.0, 1.0);
    const double angle = uniform(0.0, kTwoPi);
    const double radius = std::sqrt(1.0 - z * z);
    return {radius * std::cos(angle), radius * std::sin(angle), z};
  }

  /// Three independent normal() values.
  core::Vec3 normalVector() {
    const double x = normal();
    const double y = normal();
    return {x, y, normal()};
  }

 private:
  static constexpr double kTwoPi = 6.283185307179586;
  std::mt19937_64 engine_;
};

}  // namespace mlsmesh::shapes
