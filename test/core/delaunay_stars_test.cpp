// SPDX-License-Identifier: BSD-3-Clause
#include "delaunay_stars.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "mlsmesh/core/half_edge_mesh.h"
#include "surfaces.h"
#include "test_shapes.h"

namespace mlsmesh::core {
namespace {

using test::Points;

constexpr double kLengthFactor = 4;
constexpr double kTwoPi = 2 * 3.14159265358979323846;

/// The points in canonical order, with their stars and what those agree on.
struct Stars {
  Points points;
  NeighborTable neighbors;
  std::vector<double> spacing;
  Points normals;
  StarRings rings;
  Islands islands;

  explicit Stars(const Points& world, const Context& context = {}) {
    Context build;
    points = makePointSet(world, StoredAs::Double, nullptr, build).position;
    neighbors = nearestOfAll(points, *makeKdTree(points), 16, context);
    spacing = localSpacings(points, neighbors, context);
    normals = tangentNormals(points, neighbors, context);
    rings = localStars(points, normals, neighbors, spacing, kLengthFactor, context);
    islands = agreedIslands(rings, context);
  }

  Index count() const { return static_cast<Index>(points.size()); }
};

/// Clumps of eight points, ten times farther from each other than their points.
Points clumps() {
  const Points offsets = test::randomCloud(8 * 400, 8);
  Points points;
  for (const Vec3& center : test::planeLattice(20, 20))
    for (int i = 0; i < 8; ++i) points.push_back(center + 0.15 * offsets[points.size()]);
  return points;
}

/// Clean samples, a lattice with ties everywhere, and clouds that are no surface at all.
std::vector<Points> clouds() {
  return {test::evenSample("sphere", 0.08),
          test::evenSample("moebius", 0.08),
          test::randomSample(*shapes::makeShape("torus"), 3000),
          test::planeLattice(30, 30),
          test::lattice(9),
          clumps(),
          test::randomCloud(2000, 3)};
}

TEST(TangentNormals, FollowTheSurface) {
  const auto torus = shapes::makeShape("torus");
  const Stars stars(test::evenSample(*torus, 0.06));
  for (Index i = 0; i < stars.count(); ++i) {
    EXPECT_NEAR(stars.normals[i].norm(), 1, 1e-9);
    // The origin of the set is not that of the shape, which the tube about the z axis does not notice by
    // much.
    const Vec3 truth = torus->normal(torus->closestPoint(stars.points[i]));
    EXPECT_GT(std::abs(stars.normals[i].dot(truth)), 0.95);
  }
}

TEST(DelaunayStars, GoOnceAroundThePoint) {
  for (const Points& world : clouds()) {
    const Stars stars(world);
    ASSERT_EQ(stars.rings.count(), stars.count());
    for (Index p = 0; p < stars.count(); ++p) {
      const Vec3 u = stars.normals[p].unitOrthogonal(), v = stars.normals[p].cross(u);
      std::vector<double> angles;
      std::set<Index> members;
      for (Index i = 0; i < stars.rings.size(p); ++i) {
        const Index q = stars.rings.data(p)[i];
        if (q == kNone) continue;
        EXPECT_NE(q, p);
        EXPECT_TRUE(members.insert(q).second);
        const Vec3 d = stars.points[q] - stars.points[p];
        angles.push_back(std::atan2(d.dot(v), d.dot(u)));
      }
      double turned = 0;
      for (std::size_t i = 0; i < angles.size(); ++i) {
        const double step = angles[(i + 1) % angles.size()] - angles[i];
        turned += step < 0 ? step + kTwoPi : step;
      }
      if (angles.size() < 2) continue;
      EXPECT_NEAR(turned, kTwoPi, 1e-6);
    }
  }
}

TEST(DelaunayStars, HoldNeighborsThatAreNotTooFar) {
  for (const Points& world : clouds()) {
    const Stars stars(world);
    for (Index p = 0; p < stars.count(); ++p) {
      const Index* row = stars.neighbors.row(p);
      for (Index i = 0; i < stars.rings.size(p); ++i) {
        const Index q = stars.rings.data(p)[i];
        if (q == kNone) continue;
        EXPECT_NE(std::find(row, row + stars.neighbors.k, q), row + stars.neighbors.k);
        EXPECT_LE((stars.points[q] - stars.points[p]).norm(),
                  kLengthFactor * std::max(stars.spacing[p], stars.spacing[q]));
      }
    }
  }
}

TEST(DelaunayStars, AreClosedOnAClosedSurfaceAndOpenOnABorder) {
  const Stars sphere(test::evenSample("sphere", 0.08));
  for (Index p = 0; p < sphere.count(); ++p)
    for (Index i = 0; i < sphere.rings.size(p); ++i) EXPECT_NE(sphere.rings.data(p)[i], kNone);
  const Stars square(test::planeLattice(30, 30));
  for (Index p = 0; p < square.count(); ++p) {
    const bool border = square.points[p].head<2>().cwiseAbs().maxCoeff() > 14.4;
    const Index* ring = square.rings.data(p);
    EXPECT_EQ(std::find(ring, ring + square.rings.size(p), kNone) != ring + square.rings.size(p), border);
  }
}

TEST(AgreedIslands, AreDelaunayInThePlane) {
  Points flat = test::randomCloud(800, 4);
  for (Vec3& p : flat) p.z() = 0;
  const Stars stars(flat);
  int checked = 0;
  for (const auto& [a, b, c] : stars.islands.triangles) {
    const Vec3 ab = stars.points[b] - stars.points[a], ac = stars.points[c] - stars.points[a];
    const Vec3 n = ab.cross(ac);
    const Vec3 center =
        (n.cross(ab) * ac.squaredNorm() + ac.cross(n) * ab.squaredNorm()) / (2 * n.squaredNorm());
    const double radius = center.norm();
    const Index* row = stars.neighbors.row(a);
    if ((stars.points[row[stars.neighbors.k - 1]] - stars.points[a]).norm() < 2 * radius) continue;
    ++checked;  // the star of a knows all points that could lie within the circumcircle
    for (Index i = 0; i < stars.count(); ++i) {
      if (i == a || i == b || i == c) continue;
      // The weights that break ties may move a bisector by 1e-5 squared spacings.
      EXPECT_GT((stars.points[i] - stars.points[a] - center).norm(), radius - 1e-4);
    }
  }
  EXPECT_GT(checked, 1000);
}

TEST(AgreedIslands, AreAnEdgeManifold) {
  for (const Points& world : clouds()) {
    const Stars stars(world);
    std::map<std::pair<Index, Index>, int> triangles_at;
    std::set<std::set<Index>> distinct;
    for (const Triangle& t : stars.islands.triangles) {
      EXPECT_TRUE(distinct.insert({t[0], t[1], t[2]}).second);
      for (int i = 0; i < 3; ++i) ++triangles_at[std::minmax(t[i], t[(i + 1) % 3])];
    }
    for (const auto& edge : triangles_at) EXPECT_LE(edge.second, 2);
  }
}

TEST(AgreedIslands, AgreeOnEveryTriangleOfALattice) {
  const Stars stars(test::planeLattice(40, 25));
  EXPECT_EQ(stars.islands.count(), 1);
  EXPECT_EQ(stars.islands.triangles.size(), 2u * 39 * 24);
}

TEST(AgreedIslands, AgreeOnNearlyAllOfACleanSurface) {
  const Stars stars(test::evenSample("sphere", 0.05));
  const auto complete = 2.0 * (stars.count() - 2);  // triangles of a closed surface of genus 0
  EXPECT_GT(static_cast<double>(stars.islands.triangles.size()), 0.97 * complete);
  EXPECT_LE(static_cast<double>(stars.islands.triangles.size()), complete);
}

TEST(AgreedIslands, AreConnectedAndConsistentlyOriented) {
  for (const Points& world : {test::evenSample("sphere", 0.08), test::planeLattice(30, 30),
                              test::randomSample(*shapes::makeShape("torus"), 3000)}) {
    const Stars stars(world);
    const Islands& islands = stars.islands;
    ASSERT_EQ(islands.begin.back(), static_cast<Index>(islands.triangles.size()));
    for (Index i = 0; i < islands.count(); ++i) {
      HalfEdgeMesh mesh(stars.count());
      for (Index t = islands.begin[i]; t < islands.begin[i + 1]; ++t) {
        const auto& [a, b, c] = islands.triangles[t];
        EXPECT_NE(mesh.addTriangle(a, b, c), kNone);  // refused where an edge runs the same way twice
      }
      Index components = 0;
      mesh.components(&components);
      EXPECT_EQ(components, 1);
      if (i == 0) continue;
      EXPECT_LE(islands.begin[i + 1] - islands.begin[i], islands.begin[i] - islands.begin[i - 1]);
    }
  }
}

TEST(AgreedIslands, OfTwoSpheresAreApart) {
  const Points ball = test::evenSample("sphere", 0.1);
  Points two = ball;
  for (const Vec3& p : ball) two.push_back(p + Vec3(3, 0, 0));
  const Islands islands = Stars(two).islands;
  ASSERT_GE(islands.count(), 2);
  EXPECT_NEAR(islands.begin[1], islands.begin[2] - islands.begin[1], 0.1 * islands.begin[1]);
}

TEST(DelaunayStars, DoNotDependOnThreads) {
  const Points world = test::randomSample(*shapes::makeShape("figure"), 6000);
  const Stars one(world, test::withThreads(1)), four(world, test::withThreads(4));
  EXPECT_EQ(one.normals, four.normals);
  EXPECT_EQ(one.rings.begin, four.rings.begin);
  EXPECT_EQ(one.rings.items, four.rings.items);
  EXPECT_EQ(one.islands.triangles, four.islands.triangles);
  EXPECT_EQ(one.islands.begin, four.islands.begin);
}

}  // namespace
}  // namespace mlsmesh::core
