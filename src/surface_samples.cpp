// SPDX-License-Identifier: BSD-3-Clause
#include "surface_samples.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace mlsmesh {

using core::Index;
using core::Triangle;
using core::Vec3;

namespace {

/// Numbers in [0, 1), the same with every standard library.
class Uniform {
 public:
  double operator()() { return static_cast<double>(bits_() >> 11) * 0x1p-53; }

 private:
  std::mt19937_64 bits_{20031012};
};

/// Of every triangle, the area of all up to and with it.
std::vector<double> areaUpTo(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles) {
  std::vector<double> sums;
  sums.reserve(triangles.size());
  double sum = 0;
  for (const auto& [a, b, c] : triangles) {
    sum += 0.5 * (vertices[b] - vertices[a]).cross(vertices[c] - vertices[a]).norm();
    sums.push_back(sum);
  }
  return sums;
}

/// Uniform on the triangle: the square root makes up for its narrowing towards the first corner.
Vec3 pointOn(const Vec3& a, const Vec3& b, const Vec3& c, double u, double v) {
  const double away = std::sqrt(u);
  return a + away * ((1 - v) * (b - a) + v * (c - a));
}

}  // namespace

SurfaceSamples sampleSurface(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles,
                             std::size_t count) {
  SurfaceSamples samples;
  const std::vector<double> sums = areaUpTo(vertices, triangles);
  if (sums.empty() || !(sums.back() > 0)) return samples;
  const auto last = std::lower_bound(sums.begin(), sums.end(), sums.back()) - sums.begin();
  samples.position.reserve(count);
  samples.triangle.reserve(count);
  Uniform uniform;
  std::ptrdiff_t at = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double share = (static_cast<double>(i) + uniform()) / static_cast<double>(count);
    while (at < last && sums[at] <= share * sums.back()) ++at;
    const auto& [a, b, c] = triangles[at];
    const double u = uniform(), v = uniform();
    samples.position.push_back(pointOn(vertices[a], vertices[b], vertices[c], u, v));
    samples.triangle.push_back(static_cast<Index>(at));
  }
  return samples;
}

}  // namespace mlsmesh
