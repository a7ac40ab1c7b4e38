// SPDX-License-Identifier: BSD-3-Clause
#include "mlsmesh/core/mls_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "mlsmesh/core/multiresolution.h"
#include "surfaces.h"
#include "test_shapes.h"

namespace mlsmesh::core {
namespace {

using test::Cloud;
using test::Points;

constexpr double kPi = 3.14159265358979323846;

ProjectionParameters withDegree(int degree, ProjectionMethod method = ProjectionMethod::OneStep) {
  ProjectionParameters parameters;
  parameters.degree = degree;
  parameters.method = method;
  return parameters;
}

/// Every degree with every method and support rule.
std::vector<ProjectionParameters> variants() {
  std::vector<ProjectionParameters> all;
  for (int degree = 0; degree <= 3; ++degree) {
    for (const ProjectionMethod method : {ProjectionMethod::OneStep, ProjectionMethod::Levin}) {
      all.push_back(withDegree(degree, method));
      all.push_back(all.back());
      all.back().support_rule = SupportRule::NearestDistance;
      all.back().support_factor = 3;
    }
  }
  return all;
}

/// Places up to half a spacing off the points of the cloud, one for every 23rd.
Points queriesNear(const Cloud& cloud) {
  shapes::Random random(4);
  Points queries;
  for (Index i = 0; i < cloud.points.size(); i += 23)
    queries.push_back(cloud.points.position[i] + 0.5 * cloud.spacing * random.direction());
  return queries;
}

TEST(MlsSurface, ReproducesPlanes) {
  const test::Similarity tilt;
  Points flat = test::randomCloud(2000, 1);
  for (Vec3& p : flat) p.z() = 0;
  const Points points = tilt(flat);
  const auto search = makeKdTree(points);
  const Vec3 normal = tilt.rotation.col(2);
  for (const ProjectionParameters& parameters : variants()) {
    const MlsSurface surface(points, *search, parameters);
    for (int i = 0; i < 100; ++i) {
      const Vec3 x = points[i] + 0.01 * normal + 0.005 * tilt.rotation.col(0);
      const Projection projection = surface.project(x);
      const Vec3 foot = x - (x - tilt.shift).dot(normal) * normal;
      // The mean of degree 0 sees the tilt of the reference plane, which is found to about 1e-8; a fit does
      // not.
      EXPECT_NEAR((projection.position - foot).dot(normal), 0, parameters.degree > 0 ? 1e-12 : 1e-9);
      EXPECT_LT((projection.position - foot).norm(), 1e-8);
      EXPECT_NEAR(std::abs(projection.normal.dot(normal)), 1, 1e-12);
      EXPECT_LT(projection.variation, 1e-12);
    }
  }
}

/// A square lattice over the paraboloid z = a x^2 + b y^2, symmetric about its apex, so that the reference
/// plane there is exactly z = const.
TEST(MlsSurface, ReproducesParaboloidsAtTheirApex) {
  Points points = test::planeLattice(21, 21);
  for (Vec3& p : points) {
    p -= Vec3(10, 10, 0);
    p *= 0.1;
    p.z() = 0.3 * p.x() * p.x() - 0.2 * p.y() * p.y();
  }
  const auto search = makeKdTree(points);
  for (const int degree : {2, 3}) {
    ProjectionParameters parameters = withDegree(degree);
    parameters.neighbors = 21;  // rings of the square lattice: 1 + 4 + 4 + 4 + 8
    const MlsSurface surface(points, *search, parameters);
    EXPECT_LT(surface.project({0, 0, 0.02}).position.norm(), 1e-10);
  }
  EXPECT_GT(MlsSurface(points, *search, withDegree(1)).project({0, 0, 0.02}).position.norm(), 1e-4);
}

double sphereError(const Cloud& cloud, const ProjectionParameters& parameters) {
  const MlsSurface surface = cloud.surface(parameters);
  std::vector<double> errors;
  for (const Vec3& x : queriesNear(cloud))
    errors.push_back(cloud.points.world(surface.project(x).position).norm() - 1);
  return test::rootMeanSquare(errors);
}

TEST(MlsSurface, FollowsCurvatureFromDegreeTwoOn) {
  const Cloud cloud(test::evenSample("sphere", 0.05));
  for (const ProjectionMethod method : {ProjectionMethod::OneStep, ProjectionMethod::Levin}) {
    // The mean of a disc of radius h lies h^2 / 4 under a unit sphere's top; h is about 1.5 * 0.06.
    const double linear = sphereError(cloud, withDegree(1, method));
    EXPECT_GT(linear, 5e-4);
    EXPECT_LT(linear, 4e-3);
    EXPECT_LT(sphereError(cloud, withDegree(0, method)), 8e-3);
    EXPECT_LT(sphereError(cloud, withDegree(2, method)), linear / 50);
    EXPECT_LT(sphereError(cloud, withDegree(3, method)), linear / 50);
  }
}

double normalError(const shapes::Shape& shape, const Cloud& cloud, int degree) {
  ProjectionParameters parameters = withDegree(degree);
  parameters.neighbors = 40;
  const MlsSurface surface = cloud.surface(parameters);
  std::vector<double> errors;
  for (const Vec3& x : queriesNear(cloud)) {
    const Projection projection = surface.project(x);
    const Vec3 truth = shape.normal(shape.closestPoint(cloud.points.world(projection.position)));
    errors.push_back(projection.normal.cross(truth).norm());
  }
  return test::rootMeanSquare(errors);
}

TEST(MlsSurface, GivesNormalsThatImproveWithTheDegree) {
  const auto torus = shapes::makeShape("torus");
  const Cloud cloud(test::evenSample(*torus, 0.05));
  const double linear = normalError(*torus, cloud, 1);
  const double quadratic = normalError(*torus, cloud, 2);
  const double cubic = normalError(*torus, cloud, 3);
  EXPECT_LT(linear, 0.2);
  EXPECT_LT(quadratic, linear / 2);
  EXPECT_LT(cubic, quadratic / 2);
}

TEST(MlsSurface, MovesWithThePoints) {
  const Points world = test::evenSample("torus", 0.1);
  test::Similarity motion;
  motion.scale = 37.5;
  const Points moved = motion(world);
  const auto search = makeKdTree(world);
  const auto moved_search = makeKdTree(moved);
  for (const ProjectionParameters& parameters : variants()) {
    const MlsSurface surface(world, *search, parameters), moved_surface(moved, *moved_search, parameters);
    for (std::size_t i = 0; i < world.size(); i += 7) {
      const Vec3 x = world[i] + Vec3(0.01, 0.02, -0.015);
      const Projection before = surface.project(x), after = moved_surface.project(motion(x));
      EXPECT_LT((motion(before.position) - after.position).norm(), 1e-5 * motion.scale * before.spacing);
      EXPECT_GT(std::abs(after.normal.dot(motion.rotation * before.normal)), 1 - 1e-8);
      EXPECT_NEAR(after.spacing, motion.scale * before.spacing, 1e-9);
      EXPECT_NEAR(after.support, motion.scale * before.support, 1e-9);
      EXPECT_NEAR(after.variation, before.variation, 1e-9);
      EXPECT_EQ(after.nearest, before.nearest);
      EXPECT_EQ(after.kind, before.kind);
    }
  }
}

TEST(MlsSurface, LevinsAlternationConverges) {
  const Cloud cloud(test::noisy(test::evenSample("torus", 0.08), 0.01));
  ProjectionParameters usual = withDegree(2, ProjectionMethod::Levin), exact = usual, hasty = usual;
  exact.tolerance = 1e-13;
  exact.max_iterations = 1000;
  hasty.max_iterations = 1;
  std::vector<double> usual_errors, hasty_errors;
  for (const Vec3& x : queriesNear(cloud)) {
    const Vec3 limit = cloud.surface(exact).project(x).position;
    usual_errors.push_back((cloud.surface(usual).project(x).position - limit).norm() / cloud.spacing);
    hasty_errors.push_back((cloud.surface(hasty).project(x).position - limit).norm() / cloud.spacing);
  }
  EXPECT_LT(test::quantile(usual_errors, 0.99), 1e-4);
  EXPECT_GT(test::quantile(hasty_errors, 0.5), 1e-4);  // or the alternation would not be needed
}

TEST(MlsSurface, StaysFiniteOnDegenerateNeighborhoods) {
  Points line, circle;
  for (int i = 0; i < 40; ++i) {
    line.emplace_back(0.1 * i, 0.2 * i, -0.1 * i);
    circle.emplace_back(std::cos(0.05 * kPi * i), std::sin(0.05 * kPi * i), 0);
  }
  const Points crowd = test::joined(Points(1, Vec3(1, 0, 0)), Points(30, Vec3(0, 0, 0)));
  const Points three = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  for (const Points& points : {line, circle, three, crowd, Points(1, Vec3(1, 2, 3))}) {
    const auto search = makeKdTree(points);
    for (const ProjectionParameters& parameters : variants()) {
      const MlsSurface surface(points, *search, parameters);
      for (const Vec3& x : {Vec3(0.31, 0.52, 0.1), Vec3(0.5, 0, 0), Vec3(0, 0, 300)}) {
        const Projection projection = surface.project(x);
        EXPECT_TRUE(projection.position.allFinite());
        EXPECT_NEAR(projection.normal.norm(), 1, 1e-9);
        EXPECT_TRUE(std::isfinite(projection.variation));
        EXPECT_TRUE(surface.startFrom(x).allFinite());
      }
    }
  }
}

TEST(MlsSurface, TellsWhichDegreeItUsed) {
  const Cloud cloud(test::evenSample("sphere", 0.2));
  const MlsSurface surface = cloud.surface();
  const Vec3 x = cloud.points.position[5];
  EXPECT_EQ(surface.project(x).kind, VertexKind::Projected);
  EXPECT_EQ(surface.project(x, 2).kind, VertexKind::Projected);
  EXPECT_EQ(surface.project(x, 1).kind, VertexKind::LowerDegree);
}

TEST(MlsSurface, MeasuresNeighborsAtThePlaceItIsAskedAbout) {
  const Points points = test::randomCloud(500, 8);
  const auto search = makeKdTree(points);
  ProjectionParameters parameters;
  parameters.neighbors = 17;
  const Vec3 x(0.1, -0.2, 0.05);
  std::vector<std::pair<double, std::size_t>> by_distance;
  for (std::size_t i = 0; i < points.size(); ++i) by_distance.emplace_back((points[i] - x).norm(), i);
  std::sort(by_distance.begin(), by_distance.end());
  Vec3 mean = Vec3::Zero();
  for (int i = 0; i < 17; ++i) mean += (points[by_distance[i].second] - x) / 17;

  const MlsSurface surface(points, *search, parameters);
  const Projection projection = surface.project(x);
  EXPECT_NEAR(projection.spacing, by_distance[16].first / std::sqrt(17 / kPi), 1e-12);
  EXPECT_NEAR(projection.support, 1.5 * projection.spacing, 1e-12);
  EXPECT_LT((projection.mean_difference - mean).norm(), 1e-12);
  EXPECT_EQ(surface.meanDifference(x), projection.mean_difference);

  parameters.support_rule = SupportRule::NearestDistance;
  parameters.support_factor = 3;
  const MlsSurface printed(points, *search, parameters);
  EXPECT_NEAR(printed.project(x).support, 3 * by_distance[0].first, 1e-12);
  // At a point of the cloud its distance to itself is no measure: the nearest other point counts.
  EXPECT_GT(printed.project(points[0]).support, 0);
}

TEST(MlsSurface, NamesThePointNearestToTheProjection) {
  const Cloud cloud(test::evenSample("torus", 0.1));
  const MlsSurface surface = cloud.surface();
  for (const Vec3& x : queriesNear(cloud)) {
    const Projection projection = surface.project(x);
    Index nearest;
    double squared;
    cloud.search->nearest(projection.position, 1, &nearest, &squared);
    EXPECT_EQ(projection.nearest, nearest);
  }
}

TEST(MlsSurface, StartsOnThePlaneUnderACentroid) {
  const Points flat = test::planeLattice(20, 20);
  const auto search = makeKdTree(flat);
  ProjectionParameters parameters;
  parameters.neighbors = 16;
  // Over the middle of a square the 16 nearest are 4 x 4 points about it, so n_c is exactly the plane's
  // normal.
  const Vec3 start = MlsSurface(flat, *search, parameters).startFrom({9.5, 9.5, 0.2});
  EXPECT_LT((start - Vec3(9.5, 9.5, 0)).norm(), 1e-12);
}

/// How far the vertices made from a noise-free scan lie from the truth, without those nearer than h to its
/// border and those whose kind says that they are not on the surface.
struct Accuracy {
  double spacing = 0;          ///< up to a factor that all clouds of a shape share
  double representatives = 0;  ///< RMS distance to the shape
  double refined = 0;          ///< the same of the vertices that refinement made
  double residual_median = 0;  ///< |Psi(y) - y| in spacings
  double residual_99 = 0;
  double share_flagged = 0;  ///< of vertices left out for their kind
};

Accuracy measure(const shapes::Shape& shape, std::size_t count) {
  MultiresolutionParameters parameters;
  parameters.refinement.levels = 1;
  parameters.refinement.threshold = 0;  // every edge, at every density
  Context context;
  const Points world = test::randomSample(shape, count);
  const Reconstruction result =
      reconstruct(makePointSet(world, StoredAs::Double, nullptr, context), nullptr, parameters, context);
  const auto search = makeKdTree(result.points.position);
  const MlsSurface surface(result.points.position, *search, parameters.projection);
  std::vector<double> representatives, refined, residuals;
  double flagged = 0;
  for (std::size_t v = 0; v < result.mesh.position.size(); ++v) {
    const Vec3& y = result.mesh.position[v];
    const Vec3 truth = shape.closestPoint(result.points.world(y));
    const Projection projection = surface.project(y);
    if (shape.borderDistanceBound(truth) <= projection.support) continue;
    if (result.mesh.kind[v] > VertexKind::LowerDegree) {
      ++flagged;
      continue;
    }
    const bool is_first = static_cast<Index>(v) < result.mesh.level_vertices[0];
    (is_first ? representatives : refined).push_back((result.points.world(y) - truth).norm());
    residuals.push_back((projection.position - y).norm() / result.spacing);
  }
  Accuracy accuracy;
  accuracy.spacing = 1 / std::sqrt(static_cast<double>(count));
  accuracy.representatives = test::rootMeanSquare(representatives);
  accuracy.refined = test::rootMeanSquare(refined);
  accuracy.residual_median = test::quantile(residuals, 0.5);
  accuracy.residual_99 = test::quantile(residuals, 0.99);
  accuracy.share_flagged = flagged / static_cast<double>(residuals.size());
  return accuracy;
}

double slope(const std::vector<Accuracy>& series, double Accuracy::*error) {
  double mean_x = 0, mean_y = 0, xx = 0, xy = 0;
  for (const Accuracy& a : series) {
    mean_x += std::log(a.spacing) / static_cast<double>(series.size());
    mean_y += std::log(a.*error) / static_cast<double>(series.size());
  }
  for (const Accuracy& a : series) {
    xx += (std::log(a.spacing) - mean_x) * (std::log(a.spacing) - mean_x);
    xy += (std::log(a.spacing) - mean_x) * (std::log(a.*error) - mean_y);
  }
  return xy / xx;
}

class MlsConvergence : public testing::TestWithParam<const char*> {};

// A fit of degree 2 misses the surface by terms of third order: halving the spacing divides the error by 8.
TEST_P(MlsConvergence, IsOfThirdOrder) {
  const auto shape = shapes::makeShape(GetParam());
  std::vector<Accuracy> series;
  for (const std::size_t count : {5000, 20000, 80000}) {
    const Accuracy a = series.emplace_back(measure(*shape, count));
    std::printf(
        "%s %zu points: RMS of representatives %.3g, refined %.3g; residual median %.2g, 99 %% %.2g\n",
        GetParam(), count, a.representatives, a.refined, a.residual_median, a.residual_99);
    EXPECT_LE(a.residual_median, 1e-3);
    EXPECT_LE(a.residual_99, 0.1);
    EXPECT_LE(a.share_flagged, 5e-3);
  }
  const double coarse = slope(series, &Accuracy::representatives), fine = slope(series, &Accuracy::refined);
  std::printf("%s: slope of representatives %.2f, of refined vertices %.2f\n", GetParam(), coarse, fine);
  EXPECT_GE(coarse, 2.7);
  EXPECT_GE(fine, 2.7);
}

INSTANTIATE_TEST_SUITE_P(Shapes, MlsConvergence, testing::Values("sphere", "torus", "saddle", "cylinder"),
                         [](const auto& tested) { return std::string(tested.param); });

}  // namespace
}  // namespace mlsmesh::core
