// SPDX-License-Identifier: BSD-3-Clause
// This work is based on M. Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018 (additive
// recurrences by the generalised golden ratio): such points measure a surface more closely than as many
// random ones.
#include "surface_samples.h"

#include <algorithm>
#include <cmath>

namespace mlsmesh {

using core::Index;
using core::Triangle;
using core::Vec3;

namespace {

/// The point of that number in the unit cube, of a sequence that fills it evenly: steps of powers of 1 / g,
/// where g^4 = g + 1, from the middle.
Vec3 evenlyInCube(std::size_t number) {
  constexpr double kStep = 1 / 1.2207440846057596;
  const auto factor = static_cast<double>(number);
  Vec3 point;
  double step = 1;
  for (int axis = 0; axis < 3; ++axis) {
    step *= kStep;
    const double place = 0.5 + factor * step;
    point[axis] = place - std::floor(place);
  }
  return point;
}

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
  std::ptrdiff_t at = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 even = evenlyInCube(i);
    const double share = (static_cast<double>(i) + even[2]) / static_cast<double>(count);
    while (at < last && sums[at] <= share * sums.back()) ++at;
    const auto& [a, b, c] = triangles[at];
    samples.position.push_back(pointOn(vertices[a], vertices[b], vertices[c], even[0], even[1]));
    samples.triangle.push_back(static_cast<Index>(at));
  }
  return samples;
}

}  // namespace mlsmesh
