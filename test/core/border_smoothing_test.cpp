// SPDX-License-Identifier: BSD-3-Clause
#include "border_smoothing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "mlsmesh/core/multiresolution.h"
#include "surfaces.h"

namespace mlsmesh::core {
namespace {

using test::Points;

Reconstruction meshOf(const Points& world, bool smooth, int threads = 0) {
  Context context = test::withThreads(threads);
  MultiresolutionParameters parameters;
  parameters.refinement.smooth_borders = smooth;
  return reconstruct(makePointSet(world, StoredAs::Double, nullptr, context), nullptr, parameters, context);
}

/// Distance of a point of an open shape from its true border.
double fromRim(const std::string& shape, const Vec3& p) {
  if (shape == "cylinder") return std::hypot(std::hypot(p.x(), p.z()) - 0.6, std::abs(p.y()) - 1);
  if (shape == "disc") return std::hypot(std::hypot(p.x(), p.y()) - 1, p.z());
  double nearest = 10;  // saddle: y = (x^2 - z^2) / 2 over a square of side 2
  for (double t = -1; t <= 1; t += 0.005) {
    for (const double end : {-1.0, 1.0}) {
      nearest = std::min(nearest, (p - Vec3(end, (1 - t * t) / 2, t)).norm());
      nearest = std::min(nearest, (p - Vec3(t, (t * t - 1) / 2, end)).norm());
    }
  }
  return nearest;
}

Points scan(const std::string& shape, bool even) {
  if (shape != "disc")
    return even ? test::evenSample(shape, 0.035) : test::randomSample(*shapes::makeShape(shape), 7000);
  shapes::Random random(3);
  Points points;
  for (int i = 0; i < 5000; ++i) {
    const Vec3 d = random.normalVector();
    points.emplace_back(Vec3(d.x(), d.y(), 0).normalized() * std::sqrt((i + 0.5) / 5000));
  }
  return points;
}

struct BorderLook {
  double distance = 0;  ///< mean, from the true rim, of the border's vertices and the middles of its edges
  double turn = 0;      ///< sum of the angles between edges that follow each other, over their length
};

BorderLook lookAt(const std::string& shape, const Reconstruction& result, Index level) {
  HalfEdgeMesh mesh;
  EXPECT_TRUE(buildMesh(result.mesh.level_vertices[level], result.mesh.level_triangles[level], mesh));
  BorderLook look;
  double length = 0;
  int places = 0;
  for (const std::vector<Index>& loop : mesh.borderLoops()) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const auto at = [&](std::size_t k) {
        return result.points.world(result.mesh.position[loop[k % loop.size()]]);
      };
      const Vec3 a = at(i), b = at(i + 1), c = at(i + 2);
      look.distance += fromRim(shape, a) + fromRim(shape, (a + b) / 2);
      look.turn += std::acos(std::clamp((b - a).normalized().dot((c - b).normalized()), -1.0, 1.0));
      length += (b - a).norm();
      places += 2;
    }
  }
  EXPECT_GT(places, 20);
  look.distance /= places;
  look.turn /= length;
  return look;
}

struct Scan {
  const char* shape;
  bool even;
};

void PrintTo(const Scan& scan, std::ostream* out) {
  *out << scan.shape << (scan.even ? ", even" : ", random");
}

class Border : public testing::TestWithParam<Scan> {};

TEST_P(Border, IsNearerToTheRimAndTurnsLess) {
  const std::string shape = GetParam().shape;
  const Points world = scan(shape, GetParam().even);
  const Reconstruction smooth = meshOf(world, true), plain = meshOf(world, false);
  ASSERT_EQ(smooth.mesh.levelCount(), 3);
  for (Index level = 0; level < 3; ++level) {
    const BorderLook with = lookAt(shape, smooth, level), without = lookAt(shape, plain, level);
    EXPECT_LT(with.distance, 0.4 * without.distance);
    // Where the loop is convex without, there is nothing to gain, and the refined curve wavers a little.
    EXPECT_LE(with.turn, (level == 0 ? 1.0 : 1.01) * without.turn);
  }
}

TEST_P(Border, StaysSoundAndOfTheSameTopology) {
  const Points world = scan(GetParam().shape, GetParam().even);
  const Reconstruction smooth = meshOf(world, true), plain = meshOf(world, false);
  for (Index level = 0; level < smooth.mesh.levelCount(); ++level) {
    const Points used(smooth.mesh.position.begin(),
                      smooth.mesh.position.begin() + smooth.mesh.level_vertices[level]);
    const MeshReport report = reportMesh(used, smooth.mesh.level_triangles[level], Context());
    test::expectSound(report);
    EXPECT_EQ(report.self_intersections, 0);
    EXPECT_EQ(smooth.reports[level].self_intersections, 0);
    EXPECT_EQ(report.border_loops, plain.reports[level].border_loops);
    EXPECT_EQ(report.euler, plain.reports[level].euler);
  }
}

TEST_P(Border, MovesAloneAtLevelZero) {
  const Points world = scan(GetParam().shape, GetParam().even);
  const Reconstruction smooth = meshOf(world, true), plain = meshOf(world, false);
  ASSERT_EQ(smooth.mesh.level_triangles[0], plain.mesh.level_triangles[0]);
  HalfEdgeMesh mesh;
  ASSERT_TRUE(buildMesh(plain.mesh.level_vertices[0], plain.mesh.level_triangles[0], mesh));
  int moved = 0;
  for (Index v = 0; v < mesh.vertexCount(); ++v) {
    const Vec3& now = smooth.mesh.position[v];
    EXPECT_EQ(smooth.mesh.kind[v] == VertexKind::Border, now != plain.mesh.position[v]);
    if (now == plain.mesh.position[v]) continue;
    EXPECT_TRUE(mesh.isBorderVertex(v));
    EXPECT_EQ(smooth.points.stored(now), now);
    const Vec3& named = smooth.points.position[smooth.mesh.nearest[v]];
    for (const Vec3& p : smooth.points.position) ASSERT_GE((p - now).norm(), (named - now).norm());
    ++moved;
  }
  EXPECT_GT(moved, 20);
}

TEST_P(Border, IsTheSameForAnyNumberOfThreads) {
  const Points world = scan(GetParam().shape, GetParam().even);
  const Reconstruction one = meshOf(world, true, 1), four = meshOf(test::shuffled(world, 5), true, 4);
  EXPECT_EQ(one.mesh.position, four.mesh.position);
  EXPECT_EQ(one.mesh.normal, four.mesh.normal);
  EXPECT_EQ(one.mesh.level_triangles, four.mesh.level_triangles);
}

INSTANTIATE_TEST_SUITE_P(OpenShapes, Border,
                         testing::Values(Scan{"cylinder", true}, Scan{"cylinder", false},
                                         Scan{"saddle", true}, Scan{"saddle", false}, Scan{"disc", false}));

/// A strip of triangles between a curve and the same curve farther up.
struct Strip {
  Points points;
  HalfEdgeMesh mesh;

  explicit Strip(const Points& curve) {
    const auto n = static_cast<Index>(curve.size());
    points = curve;
    for (const Vec3& p : curve) points.push_back(p + Vec3(0, 5, 0));
    std::vector<Triangle> triangles;
    for (Index i = 0; i + 1 < n; ++i) {
      triangles.push_back({i, i + 1, n + i});
      triangles.push_back({i + 1, n + i + 1, n + i});
    }
    EXPECT_TRUE(buildMesh(2 * n, triangles, mesh));
  }
  Vec3 offset(Index i) const { return borderCurveOffset(mesh, points, mesh.find(i, i + 1)); }
};

TEST(BorderCurve, IsTheFourPointSchemeOnEqualEdges) {
  Points curve = {{0, 0, 0}};
  for (const double angle : {0.0, 0.3, 0.5, 0.2, -0.4})
    curve.push_back(curve.back() + Vec3(std::cos(angle), 0, std::sin(angle)));
  const Strip strip(curve);
  for (Index i = 1; i < 4; ++i) {
    const Vec3 offset = (curve[i] + curve[i + 1] - curve[i - 1] - curve[i + 2]) / 16;
    EXPECT_LT((strip.offset(i) - offset).norm(), 1e-12);
    EXPECT_GT(offset.norm(), 1e-3);
  }
}

TEST(BorderCurve, RunsAlongACircleWhoseEdgesDiffer) {
  Points curve;
  for (const double angle : {0.0, 0.2, 0.6, 0.7, 1.2, 1.4})
    curve.emplace_back(10 * std::cos(angle), 0, 10 * std::sin(angle));
  const Strip strip(curve);
  for (Index i = 1; i < 4; ++i) {
    const Vec3 middle = (curve[i] + curve[i + 1]) / 2;
    EXPECT_LT(10 - (middle + strip.offset(i)).norm(), 0.1 * (10 - middle.norm()));
    EXPECT_LT((middle + strip.offset(i)).norm(), 10 + 0.1 * (10 - middle.norm()));
  }
}

TEST(BorderCurve, KeepsCorners) {
  const Strip strip({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 0, 1}, {2, 0, 2}, {2, 0, 3}});
  EXPECT_EQ(strip.offset(1), Vec3(0, 0, 0));
  EXPECT_EQ(strip.offset(2), Vec3(0, 0, 0));
}

}  // namespace
}  // namespace mlsmesh::core
