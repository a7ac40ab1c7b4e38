// SPDX-License-Identifier: BSD-3-Clause
#include "clouds/surface_kinds.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "shapes/shape.h"

namespace mlsmesh::test {

using core::Vec3;
using shapes::Random;

namespace {

using Points = std::vector<Vec3>;

Points sampled(std::size_t count, Random& random) {
  static const std::vector<std::string> kShapes{"sphere", "torus", "saddle", "cylinder", "moebius"};
  return shapes::makeShape(kShapes[random.index(kShapes.size())])->sample(count, random);
}

Points sphere(std::size_t count, double radius, const Vec3& center, Random& random) {
  Points points;
  for (std::size_t i = 0; i < count; ++i) points.push_back(center + radius * random.direction());
  return points;
}

Points clean(std::size_t count, Random& random) {
  return sampled(count, random);
}

// Up to two spacings of it.
Points noisy(std::size_t count, Random& random) {
  Points points = sampled(count, random);
  const double deviation = random.uniform(0, 6) / std::sqrt(static_cast<double>(count));
  for (Vec3& p : points) p += deviation * random.normalVector();
  return points;
}

// Caps are cut out of it.
Points withHoles(std::size_t count, Random& random) {
  Points points = sampled(count, random);
  for (std::size_t hole = 1 + random.index(4); hole > 0; --hole) {
    const Vec3 center = points[random.index(points.size())];
    const double radius = random.uniform(0, 0.6);
    const auto inside = [&](const Vec3& p) { return (p - center).norm() < radius; };
    const auto kept = std::remove_if(points.begin(), points.end(), inside);
    if (kept - points.begin() >= 3) points.erase(kept, points.end());
  }
  return points;
}

Points withOutliers(std::size_t count, Random& random) {
  Points points = sampled(count, random);
  const auto outliers = static_cast<std::size_t>(random.uniform(0, 0.5) * static_cast<double>(count));
  for (std::size_t i = 0; i < outliers; ++i)
    points.emplace_back(random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3));
  return points;
}

Points farOutliers(std::size_t count, Random& random) {
  Points points = sampled(count, random);
  for (std::size_t i = 1 + random.index(5); i > 0; --i)
    points.push_back(random.direction() * std::pow(10.0, random.uniform(1, 30)));
  return points;
}

// Two or three rectangles through the origin.
Points crossingSheets(std::size_t count, Random& random) {
  const std::size_t sheets = 2 + random.index(2);
  std::vector<std::pair<Vec3, Vec3>> axes;
  for (std::size_t i = 0; i < sheets; ++i) axes.emplace_back(random.direction(), random.direction());
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const auto& [u, v] = axes[i % sheets];
    points.push_back(random.uniform(-1, 1) * u + random.uniform(-1, 1) * v);
  }
  return points;
}

// Sheets one above the other, down to a hundredth of the spacing apart.
Points nearSheets(std::size_t count, Random& random) {
  const double apart = std::pow(10.0, random.uniform(-2, 1)) / std::sqrt(static_cast<double>(count));
  const std::size_t sheets = 2 + random.index(3);
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = random.uniform(-1, 1), y = random.uniform(-1, 1);
    points.emplace_back(x, y, 0.2 * x * x + static_cast<double>(i % sheets) * apart);
  }
  return points;
}

Points touchingAtAPoint(std::size_t count, Random& random) {
  Points points = sphere(count / 2 + 1, 1, {-1, 0, 0}, random);
  const Points other = sphere(count / 2 + 1, 0.5, {0.5, 0, 0}, random);
  points.insert(points.end(), other.begin(), other.end());
  points.push_back(Vec3::Zero());
  return points;
}

// A cylinder that lies on a plane.
Points touchingAlongALine(std::size_t count, Random& random) {
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const double along = random.uniform(-1, 1), angle = random.uniform(0, 6.3);
    if (i % 2 == 0)
      points.emplace_back(random.uniform(-1, 1), along, 0);
    else
      points.emplace_back(0.5 * std::cos(angle), along, 0.5 + 0.5 * std::sin(angle));
  }
  return points;
}

Points cone(std::size_t count, Random& random) {
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const double height = random.uniform(-1, 1), angle = random.uniform(0, 6.3);
    points.emplace_back(height * std::cos(angle), height * std::sin(angle), height);
  }
  return points;
}

Points someSpheres(std::size_t count, Random& random) {
  Points points;
  while (points.size() < count) {
    const Vec3 center(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2));
    const Points part =
        sphere(1 + random.index(count), std::pow(10.0, random.uniform(-2, 0)), center, random);
    points.insert(points.end(), part.begin(), part.end());
  }
  return points;
}

}  // namespace

std::vector<CloudKind> surfaceKinds() {
  return {{"clean surface", &clean},
          {"noisy surface", &noisy},
          {"surface with holes", &withHoles},
          {"surface among outliers", &withOutliers},
          {"surface and far outliers", &farOutliers},
          {"crossing sheets", &crossingSheets},
          {"near sheets", &nearSheets},
          {"surfaces that touch at a point", &touchingAtAPoint},
          {"surfaces that touch along a line", &touchingAlongALine},
          {"double cone", &cone},
          {"spheres of all sizes", &someSpheres}};
}

const std::vector<CloudKind>& cloudKinds() {
  static const std::vector<CloudKind> kinds = [] {
    std::vector<CloudKind> all = surfaceKinds();
    const std::vector<CloudKind> others = otherKinds();
    all.insert(all.end(), others.begin(), others.end());
    return all;
  }();
  return kinds;
}

const CloudKind& cloudKind(const std::string& name) {
  for (const CloudKind& kind : cloudKinds())
    if (kind.name == name) return kind;
  throw std::out_of_range("no kind of cloud is called " + name);
}

}  // namespace mlsmesh::test
