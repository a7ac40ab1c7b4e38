// SPDX-License-Identifier: BSD-3-Clause
#include "seams.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mlsmesh/core/multiresolution.h"
#include "surfaces.h"

namespace mlsmesh::core {
namespace {

using test::Points;

struct Outcome {
  FrontStatistics front;
  MeshReport report;
  std::size_t warnings = 0;
};

Outcome outcomeOf(const Points& world, bool reduce) {
  Context context;
  MultiresolutionParameters parameters;
  parameters.reduce = reduce;
  parameters.refinement.levels = 0;
  const Reconstruction result =
      reconstruct(makePointSet(world, StoredAs::Double, nullptr, context), nullptr, parameters, context);
  return {result.front, result.reports[0], context.warnings.size()};
}

void expectSeams(const Points& world, bool reduce, Index seams) {
  const Outcome outcome = outcomeOf(world, reduce);
  test::expectSound(outcome.report);
  EXPECT_EQ(outcome.report.self_intersections.value_or(-1), 0);
  EXPECT_EQ(outcome.front.seams, seams);
  EXPECT_EQ(outcome.front.seam_edges > 0, seams > 0);
  EXPECT_EQ(outcome.warnings, seams > 0 ? 1u : 0u);
}

Points shifted(Points points, const Vec3& by) {
  for (Vec3& p : points) p += by;
  return points;
}

/// A flat strip of `columns` x 5 vertices, bent to a ring that does not close by `gap` columns; each step
/// along it turns the strip by the same angle about its middle line, `twist` in all.
struct Strip {
  static constexpr int kRows = 5;
  Points points, normals;
  HalfEdgeMesh mesh;

  Strip(int columns, double gap, double twist) {
    const double step = 2 * M_PI / (columns - 1 + gap);
    for (int c = 0; c < columns; ++c) {
      const double turn = twist * c / (columns - 1 + gap);
      const Vec3 out(std::cos(c * step), std::sin(c * step), 0);
      const Vec3 across = std::cos(turn) * out + std::sin(turn) * Vec3::UnitZ();
      const Vec3 along = Vec3::UnitZ().cross(out);
      for (int r = 0; r < kRows; ++r) {
        points.push_back(out / step + (r - 2) * across);
        normals.push_back(across.cross(along));
      }
    }
    std::vector<Triangle> triangles;
    for (Index c = 0; c + 1 < columns; ++c) {
      for (Index a = c * kRows; a + 1 < (c + 1) * kRows; ++a) {
        triangles.push_back({a, a + kRows, a + kRows + 1});
        triangles.push_back({a, a + kRows + 1, a + 1});
      }
    }
    EXPECT_TRUE(buildMesh(static_cast<Index>(points.size()), triangles, mesh));
  }

  SeamCount seams() const { return countSeams(mesh, points, normals); }
};

TEST(Seams, AreWhereAHalfTwistedStripWouldClose) {
  const SeamCount found = Strip(60, 1, M_PI).seams();
  EXPECT_EQ(found.seams, 1);
  EXPECT_EQ(found.edges, 2 * (Strip::kRows - 1));
  EXPECT_NEAR(found.length, Strip::kRows - 1, 1e-9);
}

TEST(Seams, AreNotWhereAStripOfTwoSidesWouldClose) {
  EXPECT_EQ(Strip(60, 1, 0).seams().seams, 0);
  EXPECT_EQ(Strip(60, 1, 2 * M_PI).seams().seams, 0);
}

TEST(Seams, AreNotAcrossAWideGap) {
  EXPECT_EQ(Strip(60, 5, M_PI).seams().seams, 0);
}

TEST(Seams, AMoebiusBandHasOne) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    SCOPED_TRACE(seed);
    expectSeams(test::randomSample(*shapes::makeShape("moebius"), 5000, seed), true, 1);
    expectSeams(test::randomSample(*shapes::makeShape("moebius"), 2000, seed), false, 1);
    expectSeams(test::evenSample("moebius", 0.035, seed), true, 1);
    expectSeams(test::evenSample("moebius", 0.06, seed), false, 1);
  }
}

TEST(Seams, ANoisyMoebiusBandHasOne) {
  const Points clean = test::randomSample(*shapes::makeShape("moebius"), 20000);
  expectSeams(test::noisy(clean, 0.5 * test::Cloud(clean).spacing), true, 1);
}

TEST(Seams, TwoMoebiusBandsHaveTwo) {
  const Points band = test::evenSample("moebius", 0.05);
  const Points both = test::joined(band, shifted(band, {7, 1, 2}));
  expectSeams(both, true, 2);
  expectSeams(both, false, 2);
}

TEST(Seams, SurfacesOfTwoSidesHaveNone) {
  for (const char* shape : {"sphere", "torus", "cylinder", "saddle"}) {
    SCOPED_TRACE(shape);
    for (const std::uint64_t seed : {1, 2}) {
      expectSeams(test::randomSample(*shapes::makeShape(shape), 5000, seed), true, 0);
      expectSeams(test::evenSample(shape, 0.1, seed), false, 0);
    }
  }
}

TEST(Seams, SheetsAndSlabsHaveNone) {
  const Points sheet = test::planeLattice(60, 40);
  for (const double distance : {2.0, 3.0, 6.0}) {
    SCOPED_TRACE(distance);
    const Points sheets = test::joined(sheet, shifted(sheet, {0.4, 0.3, distance}));
    Points walls;
    for (int i = 0; i < 60; ++i)
      for (double z = 1; z < distance; ++z)
        for (const double y : {0.0, 39.0}) walls.emplace_back(i, y, z);
    for (const bool reduce : {true, false}) {
      EXPECT_EQ(outcomeOf(sheets, reduce).front.seams, 0);
      EXPECT_EQ(outcomeOf(test::joined(sheets, walls), reduce).front.seams, 0);
    }
  }
}

}  // namespace
}  // namespace mlsmesh::core
