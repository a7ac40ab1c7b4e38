// SPDX-License-Identifier: BSD-3-Clause
#include "healing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mlsmesh/mesh_report.h"
#include "surfaces.h"
#include "test_shapes.h"

namespace mlsmesh::core {
namespace {

using test::Points;

struct Healed {
  HealingStatistics statistics;
  MeshReport report;
};

Healed heal(HalfEdgeMesh& mesh, const Points& points, const Points& normals, const CloudSupport& support = {},
            const TriangulationParameters& parameters = {}) {
  const Context context;
  Healed healed;
  healed.statistics = healMesh(mesh, {points, normals, support}, parameters, context).statistics;
  healed.report = reportMesh(points, mesh.triangles(), context);
  EXPECT_EQ(mesh.validate(), "");
  EXPECT_EQ(healed.report.self_intersections, healed.statistics.intersections);
  return healed;
}

HalfEdgeMesh meshOf(const test::Soup& soup) {
  HalfEdgeMesh mesh;
  EXPECT_TRUE(buildMesh(soup.vertexCount(), soup.triangles, mesh));
  return mesh;
}

// A round torus of these radii; normals of the true surface.
struct RoundTorus {
  test::Soup soup;
  Points normals;

  RoundTorus(Index columns, Index rows, double large, double small) : soup(test::torus(columns, rows)) {
    for (Index c = 0; c < columns; ++c) {
      for (Index r = 0; r < rows; ++r) {
        const double u = 2 * M_PI * c / columns, v = 2 * M_PI * r / rows;
        normals.emplace_back(std::cos(u) * std::cos(v), std::sin(u) * std::cos(v), std::sin(v));
        soup.vertices[c * rows + r] =
            Vec3(large * std::cos(u), large * std::sin(u), 0) + small * normals.back();
      }
    }
  }
};

TEST(Healing, LeavesASoundMeshAlone) {
  const RoundTorus torus(24, 10, 3, 1);
  HalfEdgeMesh mesh = meshOf(torus.soup);
  const Healed healed = heal(mesh, torus.soup.vertices, torus.normals);
  EXPECT_EQ(mesh.triangles(), torus.soup.triangles);
  EXPECT_EQ(
      healed.statistics.repaired_places + healed.statistics.cut_handles + healed.statistics.filled_loops, 0);
}

TEST(Healing, MakesPlacesAnewWhereTrianglesMeet) {
  // Two vertices of the mesh change their places: the triangles around them cross one another.
  RoundTorus torus(24, 10, 3, 1);
  for (const auto& [a, b] : {std::array<Index, 2>{14, 25}, std::array<Index, 2>{123, 144}}) {
    std::swap(torus.soup.vertices[a], torus.soup.vertices[b]);
    std::swap(torus.normals[a], torus.normals[b]);
  }
  HalfEdgeMesh mesh = meshOf(torus.soup);
  EXPECT_GT(reportMesh(torus.soup.vertices, torus.soup.triangles, Context()).self_intersections, 0);
  const Healed healed = heal(mesh, torus.soup.vertices, torus.normals);
  EXPECT_EQ(healed.report.self_intersections, 0);
  EXPECT_GE(healed.statistics.repaired_places, 2);
  EXPECT_EQ(healed.report.border_loops, 0);
  EXPECT_EQ(healed.report.components, 1);
  EXPECT_EQ(healed.report.genus, 1);
}

TEST(Healing, OpensWhatCannotBeClosed) {
  // Two open sheets that run through one another: neither can be mended, but none may meet the other.
  const Points flat = test::planeLattice(8, 8);
  test::Soup one = test::grid(7, 7), other = one;
  one.vertices = flat;
  other.vertices.clear();
  for (const Vec3& p : flat) other.vertices.emplace_back(3.3, p.y() + 0.21, p.x() - 3.4);
  const test::Soup both = test::together(one, other);
  Points normals(flat.size(), Vec3(0, 0, 1));
  normals.insert(normals.end(), flat.size(), Vec3(1, 0, 0));
  HalfEdgeMesh mesh = meshOf(both);
  const Healed healed = heal(mesh, both.vertices, normals);
  EXPECT_EQ(healed.report.self_intersections, 0);
  EXPECT_GT(healed.statistics.opened_places, 0);
  EXPECT_GT(healed.report.triangles, 98);  // of 196
}

// Two sheets one unit apart, seen from outside, their rims joined so that they are one closed surface.
struct Slab {
  static constexpr Index kSide = 14;
  test::Soup soup;
  Points normals;

  Slab() : soup(test::together(test::grid(kSide, kSide), test::grid(kSide, kSide))) {
    const Index sheet = (kSide + 1) * (kSide + 1);
    for (Index v = 0; v < 2 * sheet; ++v) {
      const Index column = v % sheet / (kSide + 1), row = v % (kSide + 1);
      soup.vertices[v] = Vec3(column, row, v < sheet ? 1 : 0);
      normals.emplace_back(0, 0, 1);
    }
    for (std::size_t t = soup.triangles.size() / 2; t < soup.triangles.size(); ++t)
      std::swap(soup.triangles[t][1], soup.triangles[t][2]);
    std::vector<Index> rim;
    for (Index i = 0; i < kSide; ++i) rim.push_back(at(i, 0));
    for (Index i = 0; i < kSide; ++i) rim.push_back(at(kSide, i));
    for (Index i = kSide; i > 0; --i) rim.push_back(at(i, kSide));
    for (Index i = kSide; i > 0; --i) rim.push_back(at(0, i));
    join(rim, sheet);
  }

  static Index at(Index column, Index row) { return column * (kSide + 1) + row; }

  // Walls between the upper loop, counter-clockwise round the sheet, and the one below it.
  void join(const std::vector<Index>& loop, Index below) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Index a = loop[i], b = loop[(i + 1) % loop.size()];
      soup.triangles.push_back({b, a, a + below});
      soup.triangles.push_back({b, a + below, b + below});
    }
  }

  // A passage from one sheet to the other, in the place of a quad of each.
  void addPassage(Index column, Index row) {
    const Index sheet = (kSide + 1) * (kSide + 1);
    std::vector<Triangle> kept;
    const std::vector<Index> quad = {at(column, row), at(column, row + 1), at(column + 1, row + 1),
                                     at(column + 1, row)};
    for (const Triangle& t : soup.triangles) {
      const bool inside = std::all_of(t.begin(), t.end(), [&](Index v) {
        return std::find(quad.begin(), quad.end(), v % sheet) != quad.end();
      });
      if (!inside) kept.push_back(t);
    }
    soup.triangles = kept;
    join(quad, sheet);
  }
};

TEST(Healing, CutsPassagesBetweenNearSheets) {
  Slab slab;
  HalfEdgeMesh whole = meshOf(slab.soup);
  EXPECT_EQ(heal(whole, slab.soup.vertices, slab.normals).report.genus, 0);
  slab.addPassage(3, 4);
  slab.addPassage(9, 8);
  HalfEdgeMesh mesh = meshOf(slab.soup);
  EXPECT_EQ(reportMesh(slab.soup.vertices, mesh.triangles()).genus, 2);
  const Healed healed = heal(mesh, slab.soup.vertices, slab.normals);
  EXPECT_EQ(healed.statistics.cut_handles, 2);
  EXPECT_EQ(healed.report.genus, 0);
  EXPECT_EQ(healed.report.border_loops, 0);
  EXPECT_EQ(healed.report.components, 1);
  EXPECT_EQ(healed.report.triangles, static_cast<Index>(meshOf(Slab().soup).triangleCount()));
}

TEST(Healing, KeepsThinHandles) {
  for (const Index rows : {4, 5, 8}) {
    const RoundTorus torus(30, rows, 3, 0.3);
    HalfEdgeMesh mesh = meshOf(torus.soup);
    const Healed healed = heal(mesh, torus.soup.vertices, torus.normals);
    EXPECT_EQ(healed.statistics.cut_handles, 0) << rows;
    EXPECT_EQ(healed.report.genus, 1) << rows;
  }
}

TEST(Healing, FillsGapsOnlyOverTheCloud) {
  constexpr Index kSide = 16;
  test::Soup sheet = test::grid(kSide, kSide);
  for (Index v = 0; v < sheet.vertexCount(); ++v)
    sheet.vertices[v] = Vec3(v / (kSide + 1), v % (kSide + 1), 0);
  const Points normals(sheet.vertices.size(), Vec3(0, 0, 1));
  HalfEdgeMesh torn = meshOf(sheet);
  for (Index row = 4; row < 7; ++row) {
    const Index v = 5 * (kSide + 1) + row;
    while (torn.isUsed(v)) torn.removeTriangle(HalfEdgeMesh::triangleOf(torn.firstOutgoing(v)));
  }
  const std::vector<double> spacing(sheet.vertices.size(), 0.25);
  for (const double hole : {0.0, 0.7, 1.2}) {  // radius: none, within the reach of 4 spacings, beyond
    Points cloud;
    for (int x = 0; x <= 64; ++x) {
      for (int y = 0; y <= 64; ++y) {
        const Vec3 p(0.25 * x, 0.25 * y, 0);
        if ((p - Vec3(5, 5, 0)).norm() >= hole) cloud.push_back(p);
      }
    }
    const auto search = makeKdTree(cloud);
    const CloudSupport support(sheet.vertices, spacing, *search, 2.0);
    HalfEdgeMesh mesh = torn;
    const Healed healed = heal(mesh, sheet.vertices, normals, support);
    EXPECT_EQ(healed.report.border_loops, hole < 1 ? 1 : 2) << hole;
    TriangulationParameters small;
    small.fill_supported_edges = 9;  // the loop has ten
    HalfEdgeMesh kept = torn;
    EXPECT_EQ(heal(kept, sheet.vertices, normals, support, small).report.border_loops, 2) << hole;
  }
}

TEST(Healing, DoesNotCoverASmallSheetTwice) {
  // The rim of the sheet has the points of the sheet itself all around.
  constexpr Index kSide = 8;
  test::Soup sheet = test::grid(kSide, kSide);
  Points normals;
  for (Index v = 0; v < sheet.vertexCount(); ++v) {
    const double x = v / (kSide + 1), y = v % (kSide + 1);
    sheet.vertices[v] = Vec3(x, y, 0.02 * (x * x + y * y));
    normals.push_back(Vec3(-0.04 * x, -0.04 * y, 1).normalized());
  }
  const std::vector<double> spacing(sheet.vertices.size(), 1);
  const auto search = makeKdTree(sheet.vertices);
  const CloudSupport support(sheet.vertices, spacing, *search, 2.0);
  HalfEdgeMesh mesh = meshOf(sheet);
  EXPECT_EQ(heal(mesh, sheet.vertices, normals, support).report.border_loops, 1);
}

}  // namespace
}  // namespace mlsmesh::core
