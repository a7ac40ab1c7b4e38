// SPDX-License-Identifier: BSD-3-Clause
#include "mlsmesh/core/outliers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mlsmesh/core/multiresolution.h"
#include "shapes/scan.h"
#include "surfaces.h"
#include "test_shapes.h"

namespace mlsmesh::core {
namespace {

using test::Points;

Reconstruction meshOf(const Points& world) {
  Context context;
  return reconstruct(makePointSet(world, StoredAs::Double, nullptr, context), nullptr, {}, context);
}

/// Points anywhere in the box from -1.2 to 1.2.
Points clutter(std::size_t count, unsigned seed) {
  Points points = test::randomCloud(count, seed);
  Vec3 low = points[0], high = points[0];
  for (const Vec3& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  for (Vec3& p : points) p = 2.4 * (p - low).cwiseQuotient(high - low) - Vec3::Constant(1.2);
  return points;
}

TEST(Outliers, PullNoVertexOffTheSurface) {
  const auto sphere = shapes::makeShape("sphere");
  const Points surface = test::randomSample(*sphere, 20000);
  const double radius = surface[0].norm();
  const double spacing = radius * std::sqrt(4 * 3.14159265358979 / 20000);
  for (const std::size_t count : {200, 1000, 2000}) {
    for (const unsigned seed : {1u, 2u}) {
      Points stray = clutter(count, seed);
      for (Vec3& p : stray) p *= radius;
      const auto far = std::count_if(stray.begin(), stray.end(), [&](const Vec3& p) {
        return std::abs(p.norm() - radius) > 1.5 * spacing;
      });
      const Reconstruction result = meshOf(test::joined(surface, stray));
      test::expectTopologyOf(*sphere, result.reports.back());
      EXPECT_GE(result.outliers, 0.95 * static_cast<double>(far));
      EXPECT_LE(result.outliers, static_cast<Index>(count + surface.size() / 200));
      for (const Vec3& p : result.mesh.position)
        EXPECT_LT(std::abs(result.points.world(p).norm() - radius), 1.2 * spacing);
    }
  }
}

TEST(Outliers, AreNotFoundWhereDensityFalls) {
  const auto torus = shapes::makeShape("torus");
  shapes::ScanOptions options;
  options.count = 30000;
  options.density_axis = 0;
  options.density_ratio = 10;
  const Reconstruction result = meshOf(shapes::scan(*torus, options).points);
  EXPECT_EQ(result.outliers, 0);
  test::expectTopologyOf(*torus, result.reports.back());
}

// Takes points 1 and 3 of 0 .. 5 out of the clusters {0, 3}, {1}, {2, 4, 5} on a line.
TEST(ForgetMembers, RenumbersTheRestAndMarksWhatSawThem) {
  Representatives all;
  all.position = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(100, 0, 0)};
  all.normal.assign(3, Vec3::UnitZ());
  all.variation.assign(3, 0);
  all.spacing.assign(3, 1);
  all.sheet_gap.assign(3, 10);
  all.nearest = {0, 1, 4};
  all.kind.assign(3, VertexKind::Projected);
  IndexLists clusters;
  clusters.begin = {0, 2, 3, 6};
  clusters.items = {0, 3, 1, 2, 4, 5};
  const std::vector<char> touched = forgetMembers({1, 3}, {Vec3(1, 0, 0), Vec3(0, 1, 0)}, 20, all, clusters);
  EXPECT_EQ(touched, (std::vector<char>{1, 0}));
  EXPECT_EQ(clusters.begin, (std::vector<Index>{0, 1, 4}));
  EXPECT_EQ(clusters.items, (std::vector<Index>{0, 1, 2, 3}));
  EXPECT_EQ(all.nearest, (std::vector<Index>{0, 2}));
  EXPECT_EQ(all.position.back(), Vec3(100, 0, 0));
}

}  // namespace
}  // namespace mlsmesh::core
