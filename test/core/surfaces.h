// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "mlsmesh/core/mls_surface.h"
#include "mlsmesh/core/point_set.h"
#include "mlsmesh/mesh_report.h"
#include "shapes/shape.h"

// Clouds sampled from surfaces known exactly, and what the steps' tests ask of meshes over them.
namespace mlsmesh::test {

using Points = std::vector<core::Vec3>;

inline Points randomSample(const shapes::Shape& shape, std::size_t count, std::uint64_t seed = 1) {
  shapes::Random random(seed);
  return shape.sample(count, random);
}

/// Random samples of the shape, each at least `distance` from those kept before it: with enough candidates
/// none fits any more, so that every place of the surface has a point within `distance` or little more.
inline Points evenSample(const shapes::Shape& shape, double distance, std::uint64_t seed = 1) {
  constexpr double kCandidatesPerSquare = 25;  // of side `distance`, on the faces of the box
  const core::Vec3 sides = shape.box().sizes();
  const double faces = 2 * (sides.x() * sides.y() + sides.y() * sides.z() + sides.z() * sides.x());
  using Cell = std::array<long, 3>;
  const auto cellOf = [&](const core::Vec3& p) {
    return Cell{std::lround(p.x() / distance), std::lround(p.y() / distance), std::lround(p.z() / distance)};
  };
  std::map<Cell, Points> kept;
  const auto hasRoom = [&](const core::Vec3& p) {
    const Cell c = cellOf(p);
    for (int i = 0; i < 27; ++i) {
      const auto near = kept.find({c[0] + i % 3 - 1, c[1] + i / 3 % 3 - 1, c[2] + i / 9 - 1});
      if (near == kept.end()) continue;
      for (const core::Vec3& q : near->second)
        if ((p - q).norm() < distance) return false;
    }
    return true;
  };
  const auto candidates = static_cast<std::size_t>(kCandidatesPerSquare * faces / (distance * distance));
  Points points;
  for (const core::Vec3& p : randomSample(shape, candidates, seed)) {
    if (!hasRoom(p)) continue;
    kept[cellOf(p)].push_back(p);
    points.push_back(p);
  }
  return points;
}

inline Points evenSample(const std::string& shape, double distance, std::uint64_t seed = 1) {
  return evenSample(*shapes::makeShape(shape), distance, seed);
}

/// Points (i, j, 0).
inline Points planeLattice(int columns, int rows) {
  Points points;
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j) points.emplace_back(i, j, 0);
  return points;
}

inline Points joined(Points a, const Points& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

inline Points shuffled(Points points, unsigned seed) {
  std::mt19937 random(seed);
  std::shuffle(points.begin(), points.end(), random);
  return points;
}

inline Points noisy(Points points, double deviation, std::uint64_t seed = 7) {
  shapes::Random random(seed);
  for (core::Vec3& p : points) p += deviation * random.normalVector();
  return points;
}

/// Some rotation about no axis of the frame, a scale and a shift.
struct Similarity {
  double scale = 1;
  Eigen::Matrix3d rotation =
      Eigen::AngleAxisd(0.7, core::Vec3(0.3, -0.5, 0.81).normalized()).toRotationMatrix();
  core::Vec3 shift = core::Vec3(12.5, -3.25, 7.75);

  core::Vec3 operator()(const core::Vec3& p) const { return scale * (rotation * p) + shift; }
  Points operator()(Points points) const {
    for (core::Vec3& p : points) p = (*this)(p);
    return points;
  }
};

inline core::Context withThreads(int threads) {
  core::Context context;
  context.threads = threads;
  return context;
}

/// A cloud as the steps see it.
struct Cloud {
  const core::PointSet points;
  const std::unique_ptr<core::NeighborSearch> search;
  const double spacing;

  explicit Cloud(const Points& world, core::StoredAs stored_as = core::StoredAs::Double)
      : Cloud(world, stored_as, core::Context()) {}
  core::MlsSurface surface(const ProjectionParameters& parameters = {}) const {
    return {points.position, *search, parameters};
  }

 private:
  Cloud(const Points& world, core::StoredAs stored_as, core::Context context)
      : points(core::makePointSet(world, stored_as, nullptr, context)),
        search(core::makeKdTree(points.position)),
        spacing(core::medianSpacing(points.position, *search, context)) {}
};

inline void expectSound(const MeshReport& report) {
  EXPECT_GT(report.triangles, 0);
  EXPECT_EQ(report.nonmanifold_edges, 0);
  EXPECT_EQ(report.nonmanifold_vertices, 0);
  EXPECT_EQ(report.orientation_conflicts, 0);
  EXPECT_EQ(report.degenerate_faces, 0);
  EXPECT_EQ(report.duplicate_faces, 0);
}

/// Sound, in one piece, and with the Euler number and border loops of the shape.
inline void expectTopologyOf(const shapes::Shape& shape, const MeshReport& report) {
  expectSound(report);
  EXPECT_EQ(report.components, 1);
  EXPECT_EQ(report.euler, shape.topology().euler);
  EXPECT_EQ(report.border_loops, shape.topology().border_loops);
}

/// Six times the volume under the triangles, seen from the origin.
inline double signedVolume(const Points& vertices, const std::vector<core::Triangle>& triangles) {
  double sum = 0;
  for (const auto& [a, b, c] : triangles) sum += vertices[a].dot(vertices[b].cross(vertices[c]));
  return sum;
}

/// The value below which the share of the values lies; reorders them.
inline double quantile(std::vector<double>& values, double share) {
  const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

inline double rootMeanSquare(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v * v;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

}  // namespace mlsmesh::test
