// SPDX-License-Identifier: BSD-3-Clause
#include "border_trim.h"

#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <vector>

#include "mlsmesh/core/multiresolution.h"
#include "surfaces.h"

namespace mlsmesh::core {
namespace {

using test::Points;

/// A flat fan under a border of three points in a row, of which the middle one lies a little deeper, and the
/// triangle that spans the row.
struct Row {
  Points points;
  std::vector<Triangle> triangles{{0, 3, 4}, {0, 4, 1}, {1, 4, 2}, {2, 4, 5}};

  explicit Row(double depth, double height)
      : points{{-1, 0, 0}, {0, -depth, height}, {1, 0, 0}, {-1, -1, 0}, {0, -1, 0}, {1, -1, 0}} {}

  Index trimmed(bool spanned = true) const {
    std::vector<Triangle> all = triangles;
    if (spanned) all.push_back({0, 1, 2});
    HalfEdgeMesh mesh;
    EXPECT_TRUE(buildMesh(6, all, mesh));
    const Index removed = trimFlaps(mesh, points, Points(6, Vec3::UnitZ()));
    EXPECT_EQ(mesh.validate(), "");
    EXPECT_EQ(mesh.triangleCount(), static_cast<Index>(all.size()) - removed);
    return removed;
  }
};

TEST(BorderTrim, TakesAwayWhatStandsUp) {
  EXPECT_EQ(Row(0.02, -0.1).trimmed(), 1);
  EXPECT_EQ(Row(0.02, 0.1).trimmed(), 1);
}

TEST(BorderTrim, KeepsWhatLiesFlat) {
  EXPECT_EQ(Row(0.1, 0).trimmed(), 0);
  EXPECT_EQ(Row(0.1, 0.05).trimmed(), 0);
}

TEST(BorderTrim, KeepsTrianglesThatAreNotObtuse) {
  EXPECT_EQ(Row(0.02, 1).trimmed(), 0);  // as high as a wall, with a right angle
}

TEST(BorderTrim, OrphansNoVertexAndPinchesNone) {
  EXPECT_EQ(Row(0.02, -0.1).trimmed(false), 0);
  const Points up(4, Vec3::UnitX());  // against all triangles
  HalfEdgeMesh one, two;
  ASSERT_TRUE(buildMesh(3, {{0, 1, 2}}, one));
  EXPECT_EQ(trimFlaps(one, {{-1, 0, 0}, {0, 0.1, 0}, {1, 0, 0}}, up), 0);
  ASSERT_TRUE(buildMesh(4, {{0, 1, 2}, {0, 2, 3}}, two));
  EXPECT_EQ(trimFlaps(two, {{-1, 0, 0}, {0, -0.1, 0}, {1, 0, 0}, {0, 0.1, 0}}, up), 0);
}

/// Triangles that lie farther than 60 degrees off the surface.
Index flapsOf(const shapes::Shape& shape, const Points& vertices, const std::vector<Triangle>& triangles) {
  Index flaps = 0;
  for (const auto& [a, b, c] : triangles) {
    const Vec3 normal = (vertices[b] - vertices[a]).cross(vertices[c] - vertices[a]).normalized();
    const Vec3 middle = (vertices[a] + vertices[b] + vertices[c]) / 3;
    flaps += std::abs(normal.dot(shape.normal(shape.closestPoint(middle)))) < 0.5 ? 1 : 0;
  }
  return flaps;
}

struct OpenCloud {
  const char* shape;
  bool even;  ///< else uniform at random
  bool reduce;
  double noise;  ///< in spacings
};

void PrintTo(const OpenCloud& cloud, std::ostream* out) {
  *out << cloud.shape << (cloud.even ? ", even" : ", random") << (cloud.reduce ? ", reduced" : "")
       << ", noise " << cloud.noise;
}

class OpenShape : public testing::TestWithParam<OpenCloud> {
 protected:
  Points scan(const shapes::Shape& shape, std::uint64_t seed) const {
    if (GetParam().even) return test::evenSample(shape, GetParam().reduce ? 0.035 : 0.06, seed);
    return test::randomSample(shape, GetParam().reduce ? 5000 : 1500, seed);
  }
};

TEST_P(OpenShape, HasNoFlaps) {
  const auto shape = shapes::makeShape(GetParam().shape);
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Points clean = scan(*shape, seed);
    const Points world = test::noisy(clean, GetParam().noise * test::Cloud(clean).spacing, seed);
    Context context;
    MultiresolutionParameters parameters;
    parameters.reduce = GetParam().reduce;
    parameters.refinement.levels = 0;
    const Reconstruction result =
        reconstruct(makePointSet(world, StoredAs::Double, nullptr, context), nullptr, parameters, context);
    Points vertices = result.mesh.position;
    for (Vec3& p : vertices) p = result.points.world(p);
    EXPECT_EQ(flapsOf(*shape, vertices, result.mesh.level_triangles[0]), 0) << "seed " << seed;
  }
}

// Noise only where reduction smooths it away: else triangles are as steep as their points are noisy.
INSTANTIATE_TEST_SUITE_P(
    Shapes, OpenShape,
    testing::Values(OpenCloud{"saddle", true, false, 0}, OpenCloud{"saddle", false, false, 0},
                    OpenCloud{"saddle", true, true, 0}, OpenCloud{"saddle", true, true, 0.3},
                    OpenCloud{"saddle", false, true, 0.3}, OpenCloud{"cylinder", true, false, 0},
                    OpenCloud{"cylinder", false, false, 0}, OpenCloud{"cylinder", true, true, 0},
                    OpenCloud{"cylinder", true, true, 0.3}, OpenCloud{"cylinder", false, true, 0.3},
                    OpenCloud{"moebius", true, false, 0}, OpenCloud{"moebius", false, false, 0},
                    OpenCloud{"moebius", false, true, 0}));

}  // namespace
}  // namespace mlsmesh::core
