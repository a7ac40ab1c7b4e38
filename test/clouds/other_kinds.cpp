// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstring>

#include "clouds/surface_kinds.h"

namespace mlsmesh::test {

using core::Vec3;
using shapes::Random;

namespace {

using Points = std::vector<Vec3>;

Vec3 inBox(Random& random) {
  const double x = random.uniform(-1, 1), y = random.uniform(-1, 1);
  return {x, y, random.uniform(-1, 1)};
}

Points volume(std::size_t count, Random& random) {
  Points points;
  for (std::size_t i = 0; i < count; ++i) points.push_back(inBox(random));
  return points;
}

// The chaos game between a few points (Barnsley 1988): a fractal of a dimension below three.
Points fractalDust(std::size_t count, Random& random) {
  const Points corners = volume(3 + random.index(6), random);
  const double share = random.uniform(0.4, 0.9);
  Points points;
  Vec3 at = Vec3::Zero();
  for (std::size_t i = 0; i < count; ++i) {
    at += share * (corners[random.index(corners.size())] - at);
    points.push_back(at);
  }
  return points;
}

// Random walks, one, two or three dimensions wide.
Points curve(std::size_t count, Random& random) {
  const Vec3 width = inBox(random).cwiseAbs().array().pow(4);
  Points points;
  Vec3 at = Vec3::Zero();
  for (std::size_t i = 0; i < count; ++i) {
    at += random.normalVector().cwiseProduct(width);
    points.push_back(at);
  }
  return points;
}

Points helix(std::size_t count, Random& random) {
  const double turns = random.uniform(0, 40), jitter = std::pow(10.0, random.uniform(-9, -1));
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(count);
    points.push_back(Vec3(std::cos(6.3 * turns * t), std::sin(6.3 * turns * t), 3 * t) +
                     jitter * random.normalVector());
  }
  return points;
}

// As many of the points of a small lattice as there is room for, some shaken a little.
Points lattice(std::size_t count, Random& random) {
  const int sides[] = {1 + static_cast<int>(random.index(3)), 1 + static_cast<int>(random.index(40)), 200};
  const double jitter = random.index(2) == 0 ? 0 : std::pow(10.0, random.uniform(-16, 0));
  Points points;
  for (int x = 0; x < sides[2] && points.size() < count; ++x)
    for (int y = 0; y < sides[1]; ++y)
      for (int z = 0; z < sides[0]; ++z) points.push_back(Vec3(x, y, z) + jitter * inBox(random));
  return points;
}

Points solidLattice(std::size_t count, Random& random) {
  const int side = std::max(2, static_cast<int>(std::cbrt(static_cast<double>(count))));
  const double kept = random.uniform(0.5, 1.2);
  Points points;
  for (int x = 0; x < side; ++x)
    for (int y = 0; y < side; ++y)
      for (int z = 0; z < side; ++z)
        if (random.uniform() < kept) points.emplace_back(x, y, z);
  return points;
}

// Few places, many points: all coincide, but for a few.
Points coincident(std::size_t count, Random& random) {
  const Points places = volume(1 + random.index(12), random);
  Points points;
  for (std::size_t i = 0; i < count; ++i) points.push_back(places[random.index(places.size())]);
  return points;
}

// Points a few units in the last place away from one another.
Points almostCoincident(std::size_t count, Random& random) {
  const Points places = volume(1 + random.index(1 + count / 3), random);
  const double apart = std::pow(10.0, random.uniform(-17, -3));
  Points points;
  for (std::size_t i = 0; i < count; ++i)
    points.push_back(places[random.index(places.size())] + apart * inBox(random));
  return points;
}

Points clump(std::size_t count, Random& random) {
  const double size = std::pow(10.0, random.uniform(-9, -1));
  Points points = volume(8, random);
  const Vec3 center = inBox(random);
  for (std::size_t i = 0; i < count; ++i) points.push_back(center + size * inBox(random));
  return points;
}

Points almostALine(std::size_t count, Random& random) {
  const double width = std::pow(10.0, random.uniform(-12, -1));
  Points points;
  for (std::size_t i = 0; i < count; ++i)
    points.push_back(Vec3(random.uniform(-1, 1), 0, 0) + width * inBox(random));
  return points;
}

Points circles(std::size_t count, Random& random) {
  const std::size_t rings = 1 + random.index(5);
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 6.283185307179586 * static_cast<double>(i / rings) * static_cast<double>(rings) /
                         static_cast<double>(count);
    const auto ring = static_cast<double>(i % rings);
    points.emplace_back((1 + ring) * std::cos(angle), (1 + ring) * std::sin(angle), 0);
  }
  return points;
}

// Sizes from 1e-30 to 1e30 in one cloud.
Points allSizes(std::size_t count, Random& random) {
  const double most = random.uniform(1, 30);
  Points points;
  for (std::size_t i = 0; i < count; ++i)
    points.push_back(random.direction() * std::pow(10.0, random.uniform(-most, most)));
  return points;
}

// As far as doubles go: squares of the small ones are nothing.
Points allSizesOfDoubles(std::size_t count, Random& random) {
  const double least = random.uniform(-320, -30), most = random.uniform(least, 49);
  Points points;
  for (std::size_t i = 0; i < count; ++i)
    points.push_back(random.direction() * std::pow(10.0, random.uniform(least, most)));
  return points;
}

// A surface with points beside it that doubles can hardly tell from the origin.
Points tinyDifferences(std::size_t count, Random& random) {
  const double least = random.uniform(-320, -10);
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    points.push_back(random.direction());
    if (i % 4 == 0) points.push_back(random.direction() * std::pow(10.0, random.uniform(least, 0)));
  }
  return points;
}

float anyFloat(Random& random) {
  const auto bits = static_cast<std::uint32_t>(random.index(std::size_t{1} << 32));
  float value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

// Infinities, NaNs and denormals among them.
Points anyBits(std::size_t count, Random& random) {
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const float x = anyFloat(random), y = anyFloat(random), z = anyFloat(random);
    points.push_back(Vec3(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)));
  }
  return points;
}

Points denormals(std::size_t count, Random& random) {
  constexpr double kSmallest = 1.4e-45;
  const double steps = std::pow(10.0, random.uniform(0.5, 6));
  Points points;
  for (std::size_t i = 0; i < count; ++i)
    points.push_back(kSmallest * (steps * inBox(random)).array().round());
  return points;
}

Points hugeCoordinates(std::size_t count, Random& random) {
  Points points;
  for (std::size_t i = 0; i < count; ++i) points.push_back(3.4e38 * random.direction());
  return points;
}

}  // namespace

std::vector<CloudKind> otherKinds() {
  return {{"volume", &volume},
          {"fractal dust", &fractalDust},
          {"random walk", &curve},
          {"helix", &helix},
          {"lattice", &lattice},
          {"solid lattice", &solidLattice},
          {"coincident points", &coincident},
          {"almost coincident points", &almostCoincident},
          {"clump in a box", &clump},
          {"almost a line", &almostALine},
          {"cocircular points", &circles},
          {"points of all sizes", &allSizes},
          {"points of all sizes of doubles", &allSizesOfDoubles},
          {"tiny differences", &tinyDifferences},
          {"arbitrary bits", &anyBits},
          {"denormal coordinates", &denormals},
          {"coordinates of 1e38", &hugeCoordinates}};
}

}  // namespace mlsmesh::test
