// SPDX-License-Identifier: BSD-3-Clause
#include "mlsmesh/mesh_distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "mlsmesh/core/failure.h"
#include "surface_samples.h"
#include "test_shapes.h"

namespace mlsmesh {
namespace {

using core::Triangle;
using core::Vec3;
using test::Soup;

constexpr std::size_t kSamples = 20000;

SoupView viewOf(const Soup& soup) {
  return {soup.vertices, soup.triangles};
}

/// [0, 1] x [0, 1] at height z, each triangle facing up.
Soup square(double z) {
  return {{{0, 0, z}, {1, 0, z}, {1, 1, z}, {0, 1, z}}, {{0, 1, 2}, {0, 2, 3}}};
}

/// (side + 1)^2 points of the unit square at height z, 1 / side apart.
std::vector<Vec3> lattice(int side, double z) {
  std::vector<Vec3> points;
  for (int i = 0; i <= side; ++i)
    for (int j = 0; j <= side; ++j) points.emplace_back(1.0 * i / side, 1.0 * j / side, z);
  return points;
}

/// Subdivided octahedron with its vertices on the sphere.
Soup sphere(double radius, int subdivisions) {
  Soup soup = test::octahedron();
  for (int step = 0; step < subdivisions; ++step) {
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : soup.triangles) {
      const core::Index first = soup.vertexCount();
      for (const auto& [p, q] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
        soup.vertices.push_back((soup.vertices[p] + soup.vertices[q]).normalized());
      finer.insert(finer.end(), {{a, first, first + 2},
                                 {b, first + 1, first},
                                 {c, first + 2, first + 1},
                                 {first, first + 1, first + 2}});
    }
    soup.triangles = finer;
  }
  for (Vec3& v : soup.vertices) v *= radius;
  return soup;
}

CloudDistances cloudDistances(const std::vector<Vec3>& points, const Soup& mesh, int threads = 1) {
  core::Context context;
  context.threads = threads;
  return measureCloud(points, viewOf(mesh), kSamples, context);
}

SurfaceDistances surfaceDistances(const Soup& mesh, const Soup& truth) {
  return measureSurface(viewOf(mesh), viewOf(truth), kSamples, core::Context());
}

TEST(CloudDistances, OfPointsAboveASquare) {
  const CloudDistances d = cloudDistances(lattice(20, 0.25), square(0));
  EXPECT_EQ(d.points, 441);
  EXPECT_NEAR(d.spacing, 0.05, 1e-12);
  EXPECT_NEAR(d.diagonal, std::sqrt(2.0), 1e-15);
  for (const double value : {d.cloud_to_mesh.mean, d.cloud_to_mesh.rms, d.cloud_to_mesh.p95,
                             d.cloud_to_mesh.p99, d.cloud_to_mesh.max, d.cloud_to_mesh.min})
    EXPECT_NEAR(value, 0.25, 1e-15);
  EXPECT_EQ(d.uncovered, 1);
  EXPECT_EQ(d.unsupported, 1) << "0.25 is 5 spacings, or more beside a point";
}

TEST(CloudDistances, FromTheMeshAreThoseFromTheNearestPoint) {
  const CloudDistances d = cloudDistances(lattice(20, 0), square(0));
  EXPECT_EQ(d.cloud_to_mesh.max, 0);
  EXPECT_EQ(d.uncovered, 0);
  EXPECT_EQ(d.unsupported, 0);
  // Mean distance from the middle of a square of side s: s (sqrt 2 + asinh 1) / 6.
  EXPECT_NEAR(d.mesh_to_cloud.mean, 0.05 * (std::sqrt(2.0) + std::asinh(1.0)) / 6, 2e-4);
  EXPECT_NEAR(d.mesh_to_cloud.rms, 0.05 / std::sqrt(6.0), 2e-4);
  EXPECT_LE(d.mesh_to_cloud.max, 0.025 * std::sqrt(2.0) + 1e-12);
}

TEST(CloudDistances, TellInventedSurface) {
  Soup mesh = together(square(0), square(0));
  for (std::size_t v = 4; v < 8; ++v) mesh.vertices[v] += Vec3(0, 0, 10);
  EXPECT_NEAR(cloudDistances(lattice(20, 0), mesh).unsupported, 0.5, 1e-3);
}

TEST(CloudDistances, CountWhatIsNotFiniteAndTakeDuplicates) {
  std::vector<Vec3> points = lattice(20, 0);
  points.insert(points.end(), points.begin(), points.end());
  points.emplace_back(std::numeric_limits<double>::quiet_NaN(), 0, 0);
  const CloudDistances d = cloudDistances(points, square(0));
  EXPECT_EQ(d.points, 882);
  EXPECT_EQ(d.non_finite, 1);
  EXPECT_NEAR(d.spacing, 0.05, 1e-12) << "of distinct points";
}

TEST(CloudDistances, OfAMeshWithoutTrianglesAreUnknown) {
  const CloudDistances d = cloudDistances(lattice(3, 0), {{}, {}});
  EXPECT_EQ(d.points, 16);
  EXPECT_TRUE(std::isnan(d.cloud_to_mesh.mean));
  EXPECT_TRUE(std::isnan(d.unsupported));
}

TEST(CloudDistances, OfOnePointHaveNoSpacing) {
  const CloudDistances d = cloudDistances({{0.5, 0.5, 2}}, square(0));
  EXPECT_EQ(d.cloud_to_mesh.max, 2);
  EXPECT_TRUE(std::isnan(d.spacing));
}

TEST(CloudDistances, NeedAPoint) {
  const Vec3 nowhere(std::numeric_limits<double>::infinity(), 0, 0);
  try {
    cloudDistances({nowhere}, square(0));
    FAIL();
  } catch (const core::Failure& failure) {
    EXPECT_EQ(failure.code(), StatusCode::EmptyInput);
  }
}

TEST(CloudDistances, AreTheSameOnTwoThreads) {
  const Soup mesh = sphere(1, 4);
  const std::vector<Vec3> points = test::randomCloud(5000, 4);
  const CloudDistances one = cloudDistances(points, mesh, 1), two = cloudDistances(points, mesh, 2);
  EXPECT_EQ(one.cloud_to_mesh.mean, two.cloud_to_mesh.mean);
  EXPECT_EQ(one.mesh_to_cloud.rms, two.mesh_to_cloud.rms);
  EXPECT_EQ(one.spacing, two.spacing);
}

TEST(SurfaceDistances, OfASurfaceFromItself) {
  const Soup ball = sphere(1, 3);
  const SurfaceDistances d = surfaceDistances(ball, ball);
  EXPECT_NEAR(d.hausdorff, 0, 1e-12);
  EXPECT_EQ(d.f_scores[2].score, 1);
  EXPECT_NEAR(d.normal_consistency, 1, 1e-3);
  EXPECT_NEAR(d.same_side, 1, 1e-12);
}

TEST(SurfaceDistances, OfConcentricSpheres) {
  const SurfaceDistances d = surfaceDistances(sphere(1.01, 5), sphere(1, 5));
  EXPECT_NEAR(d.diagonal, 2 * std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(d.mean, 0.01, 1e-4);
  EXPECT_NEAR(d.rms, 0.01, 1e-4);
  EXPECT_NEAR(d.hausdorff, 0.01, 4e-4);
  EXPECT_NEAR(d.mesh_to_truth.p95, 0.01, 4e-4);
  EXPECT_EQ(d.f_scores[0].score, 1) << "0.5 % of the diagonal are 0.017";
  EXPECT_EQ(d.f_scores[1].score, 0) << "0.25 % are 0.0087";
  EXPECT_LT(d.normal_error.mean, 2);
}

TEST(SurfaceDistances, TellPrecisionFromRecall) {
  Soup half = square(0);
  half.vertices[1].x() = half.vertices[2].x() = 0.5;
  const SurfaceDistances d = surfaceDistances(half, square(0));
  EXPECT_EQ(d.f_scores[2].precision, 1);
  EXPECT_NEAR(d.f_scores[2].recall, 0.5, 0.003);
  EXPECT_NEAR(d.f_scores[2].score, 2 * 0.5 / 1.5, 0.003);
  EXPECT_EQ(d.mesh_to_truth.max, 0);
  EXPECT_NEAR(d.truth_to_mesh.mean, 0.125, 1e-3);
  EXPECT_EQ(d.hausdorff, 0.5) << "at the vertices, which are looked at beside the points";
  EXPECT_NEAR(d.mean, 0.0625, 1e-3);
}

TEST(SurfaceDistances, MindSidesApartFromNormals) {
  Soup turned = square(0);
  for (Triangle& t : turned.triangles) std::swap(t[0], t[1]);
  const SurfaceDistances d = surfaceDistances(turned, square(0));
  EXPECT_EQ(d.normal_error.max, 0);
  EXPECT_EQ(d.same_side, 0);
}

TEST(SurfaceDistances, MeasureTheAngleOfNormals) {
  Soup slope = square(0);
  slope.vertices[1].z() = slope.vertices[2].z() = std::tan(std::acos(-1) / 18);
  const SurfaceDistances d = surfaceDistances(slope, square(0));
  EXPECT_NEAR(d.normal_error.mean, 10, 1e-9);
  EXPECT_NEAR(d.normal_consistency, std::cos(std::acos(-1) / 18), 1e-12);
}

TEST(SurfaceDistances, OfAMeshWithoutAreaScoreNothing) {
  const SurfaceDistances d = surfaceDistances({{}, {}}, square(0));
  EXPECT_TRUE(std::isnan(d.mean));
  EXPECT_EQ(d.f_scores[0].score, 0);
}

TEST(SurfaceDistances, NeedATruth) {
  EXPECT_THROW(surfaceDistances(square(0), {{{1, 1, 1}}, {}}), core::Failure);
}

TEST(SurfaceSamples, AreUniformByArea) {
  Soup soup = square(0);
  soup.vertices.insert(soup.vertices.end(), {{5, 0, 0}, {5, 0, 3}, {5, 2, 0}});
  soup.triangles.push_back({4, 5, 6});
  soup.triangles.push_back({4, 4, 5});
  const SurfaceSamples samples = sampleSurface(soup.vertices, soup.triangles, 4000);
  ASSERT_EQ(samples.position.size(), 4000u);
  std::vector<int> count(4, 0);
  Vec3 sum(0, 0, 0);
  for (std::size_t i = 0; i < 4000; ++i) {
    ++count[samples.triangle[i]];
    if (samples.triangle[i] == 2) sum += samples.position[i];
  }
  EXPECT_NEAR(count[0], 500, 1);
  EXPECT_NEAR(count[2], 3000, 1);
  EXPECT_EQ(count[3], 0) << "it has no area";
  EXPECT_LT((sum / count[2] - Vec3(5, 2.0 / 3, 1)).norm(), 0.05) << "their mean is the centroid";
}

TEST(PointDistances, AreThoseBehindTheStatistics) {
  const Soup mesh = square(0.25);
  const std::vector<Vec3> cloud = lattice(10, 0);
  const std::vector<double> to_mesh = distancesFromMesh(cloud, viewOf(mesh), core::Context());
  ASSERT_EQ(to_mesh.size(), cloud.size());
  for (const double distance : to_mesh) EXPECT_NEAR(distance, 0.25, 1e-12);
  const std::vector<double> to_cloud =
      distancesFromCloud({{0.5, 0.5, 0.25}, {0.55, 0.5, 0}, {2, 1, 0}}, cloud, core::Context());
  ASSERT_EQ(to_cloud.size(), 3u);
  EXPECT_NEAR(to_cloud[0], 0.25, 1e-12);
  EXPECT_NEAR(to_cloud[1], 0.05, 1e-12);
  EXPECT_NEAR(to_cloud[2], 1, 1e-12);
  EXPECT_TRUE(distancesFromMesh({}, viewOf(mesh), core::Context()).empty());
  EXPECT_THROW(distancesFromMesh(cloud, viewOf(Soup()), core::Context()), core::Failure);
  EXPECT_THROW(distancesFromCloud(cloud, {}, core::Context()), core::Failure);
}

}  // namespace
}  // namespace mlsmesh
