// SPDX-License-Identifier: BSD-3-Clause
// Distances so small that doubles hold no square of them, and places with no neighbours at all.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "clouds/random_clouds.h"
#include "clouds/soundness.h"
#include "mlsmesh/core/mls_surface.h"
#include "surfaces.h"
#include "test_shapes.h"

namespace mlsmesh::core {
namespace {

using test::Points;

std::vector<ProjectionParameters> allMethods() {
  std::vector<ProjectionParameters> all(4);
  all[1].method = ProjectionMethod::Levin;
  all[2].support_rule = SupportRule::NearestDistance;
  all[3] = all[2];
  all[3].method = ProjectionMethod::Levin;
  return all;
}

/// Directions with lengths from 10^least to 10^most.
Points ofAllSizes(double least, double most) {
  shapes::Random random(1);
  Points points;
  for (int i = 0; i < 400; ++i)
    points.push_back(random.direction() * std::pow(10.0, random.uniform(least, most)));
  return points;
}

TEST(DegenerateCases, PointsWhoseDistancesHaveNoSquare) {
  for (const double least : {-320.0, -250.0, -170.0, -100.0}) {
    for (const double most : {-150.0, -49.0, 0.0, 45.0}) {
      SCOPED_TRACE(testing::Message() << least << " .. " << most);
      const Points points = ofAllSizes(least, std::max(least, most));
      EXPECT_EQ(test::outcomeOf(points, StoredAs::Double).fault, "");
      EXPECT_EQ(test::outcomeOf(test::joined(points, test::evenSample("torus", 0.1)), StoredAs::Double).fault,
                "");
    }
  }
}

TEST(DegenerateCases, CoordinatesThatNoExtentTellsFromZeroAreZero) {
  Context context;
  const Points world = {{1e-71, 0, 0}, {-1e-320, 1e-160, 0}, {1, 0, 0},
                        {-1, 1, 0},    {0, -1, 1e-69},       {0, 0, -1e-69}};
  const PointSet set = makePointSet(world, StoredAs::Double, nullptr, context);
  EXPECT_EQ(set.size(), 5);
  EXPECT_EQ(set.duplicates, 1);
  for (const Vec3& p : set.position) EXPECT_EQ(set.stored(p), p);
  const auto atZero = [&](const Vec3& p) { return set.world(p) == Vec3(Vec3::Zero()); };
  EXPECT_EQ(std::count_if(set.position.begin(), set.position.end(), atZero), 1);
}

// Denoising may move points that lie above each other to one place.
TEST(DegenerateCases, ProjectionsAmongPointsAtOnePlace) {
  const Vec3 place(1, -2, 3);
  for (const double apart : {0.0, 1e-310, 1e-200}) {
    Points points(40, place);
    for (int i = 0; i < 40 && apart > 0; ++i) points[i] = apart * Vec3(i % 4, i % 3, i % 5);
    const auto search = makeKdTree(points);
    for (const ProjectionParameters& parameters : allMethods()) {
      const MlsSurface surface(points, *search, parameters);
      const Vec3 start = surface.startFrom(points[0]);
      EXPECT_LE((start - points[0]).norm(), 10 * apart);
      const Projection projection = surface.project(points[0]);
      EXPECT_LE((projection.position - points[0]).norm(), 10 * apart);
      EXPECT_NEAR(projection.normal.norm(), 1, 1e-9);
      EXPECT_GE(projection.nearest, 0);
      EXPECT_LT(projection.nearest, 40);
    }
  }
}

TEST(DegenerateCases, ThereIsNoProjectionOfNowhere) {
  const Points points = test::randomCloud(100, 1);
  const auto search = makeKdTree(points);
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const ProjectionParameters& parameters : allMethods()) {
    const MlsSurface surface(points, *search, parameters);
    for (const Vec3& x : {Vec3(nan, 0, 0), Vec3(0, inf, 0), Vec3(0, -inf, nan), Vec3(0, 0, 1e200)}) {
      const Points normals(points.size(), Vec3::UnitZ());
      for (const Projection& none :
           {surface.project(x), surface.projectSide(x, 2, Vec3::UnitZ(), normals, 0.5)}) {
        EXPECT_FALSE(none.position.allFinite());
        EXPECT_FALSE(none.normal.allFinite());
        EXPECT_EQ(none.nearest, 0);
      }
    }
  }
}

}  // namespace
}  // namespace mlsmesh::core
