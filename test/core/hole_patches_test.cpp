// SPDX-License-Identifier: BSD-3-Clause
#include "mlsmesh/core/hole_patches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "mlsmesh/core/multiresolution.h"
#include "surfaces.h"
#include "test_shapes.h"

namespace mlsmesh::core {
namespace {

using test::Points;

constexpr double kEndless = std::numeric_limits<double>::infinity();

MultiresolutionParameters watertight() {
  MultiresolutionParameters parameters;
  parameters.watertight = true;
  return parameters;
}

Reconstruction meshOf(const Points& world, const MultiresolutionParameters& parameters, Context context = {},
                      StoredAs stored_as = StoredAs::Float) {
  return reconstruct(makePointSet(world, stored_as, nullptr, context), nullptr, parameters, context);
}

template <typename Keep>
Points keptOf(Points points, const Keep& keep) {
  points.erase(std::remove_if(points.begin(), points.end(), [&](const Vec3& p) { return !keep(p); }),
               points.end());
  return points;
}

Points sphereBelow(double height) {
  return keptOf(test::evenSample("sphere", 0.045), [&](const Vec3& p) { return p.z() < height; });
}

Points flatDisc() {
  Points points;
  for (int x = -20; x <= 20; ++x) {
    for (int y = -20; y <= 20; ++y) {
      if (x * x + y * y <= 400) points.emplace_back(x, y, 0);
    }
  }
  return points;
}

/// Sound, in one closed piece without handles, that turns its outer side outward and nowhere meets itself, at
/// every level.
void expectClosed(const Reconstruction& result) {
  EXPECT_EQ(result.patches.open_loops, 0);
  for (Index level = 0; level < result.mesh.levelCount(); ++level) {
    SCOPED_TRACE(level);
    const MeshReport& report = result.reports[level];
    test::expectSound(report);
    EXPECT_EQ(report.isolated_vertices, 0);
    EXPECT_EQ(report.components, 1);
    EXPECT_EQ(report.border_loops, 0);
    EXPECT_EQ(report.euler, 2);
    EXPECT_EQ(report.self_intersections, 0);
    EXPECT_GT(test::signedVolume(result.mesh.position, result.mesh.level_triangles[level]), 0);
  }
}

std::vector<Index> patchVertices(const RefinedMesh& mesh) {
  std::vector<Index> found;
  for (Index v = 0; v < static_cast<Index>(mesh.kind.size()); ++v) {
    if (mesh.kind[v] == VertexKind::Patch) found.push_back(v);
  }
  return found;
}

/// A mesh that is not refined, in its own points.
struct Sheet {
  test::Cloud cloud;
  RefinedMesh mesh;

  explicit Sheet(const test::Soup& soup) : cloud(soup.vertices) {
    mesh.position = soup.vertices;
    for (Vec3& p : mesh.position) p -= cloud.points.origin;
    const std::size_t count = soup.vertices.size();
    mesh.normal = vertexNormals(soup.triangles, mesh.position);
    mesh.kind.assign(count, VertexKind::Projected);
    mesh.nearest.assign(count, 0);
    for (Index v = 0; v < soup.vertexCount(); ++v) mesh.parents.push_back({v, v});
    mesh.level_vertices = {soup.vertexCount()};
    mesh.level_triangles = {soup.triangles};
  }

  PatchCount close(double longest = kEndless) {
    const Points before = mesh.position;
    std::vector<Index> source;
    const PatchCount count = closeHoles(cloud.points, *cloud.search, longest, {}, mesh, source);
    EXPECT_TRUE(std::equal(before.begin(), before.end(), mesh.position.begin()));
    EXPECT_EQ(mesh.position.size(), before.size() + static_cast<std::size_t>(count.vertices));
    EXPECT_EQ(source.size(), static_cast<std::size_t>(count.vertices));
    for (const Index v : source) EXPECT_LT(v, static_cast<Index>(before.size()));
    return count;
  }

  MeshReport report() const { return reportMesh(mesh.position, mesh.level_triangles[0], Context()); }
};

/// A tube about the z axis of radius 1; the quads are as high as they are wide.
test::Soup tube(Index columns, Index rows) {
  test::Soup soup = test::openCylinder(columns, rows);
  const double turn = 2 * M_PI / columns;
  for (Index c = 0; c < columns; ++c) {
    for (Index r = 0; r <= rows; ++r)
      soup.vertices[c * (rows + 1) + r] = {std::cos(turn * c), std::sin(turn * c), turn * r};
  }
  return soup;
}

TEST(HolePatches, GoOnAsTheSphereDoes) {
  const Points world = keptOf(test::evenSample("sphere", 0.03), [](const Vec3& p) { return p.z() < 0.8; });
  const Reconstruction result = meshOf(world, watertight());
  expectClosed(result);
  EXPECT_EQ(result.patches.closed_loops, 1);
  const std::vector<Index> patch = patchVertices(result.mesh);
  EXPECT_EQ(static_cast<Index>(patch.size()), result.patches.vertices);
  EXPECT_GT(patch.size(), 20u);
  double highest = 0;
  for (const Index v : patch) {
    const Vec3 x = result.points.world(result.mesh.position[v]);
    highest = std::max(highest, x.z());
    // The cap rises by a fifth over the plane of its rim; half-way down a patch would be as well called flat.
    EXPECT_NEAR(x.norm(), 1, 0.5 * 0.2);
    EXPECT_GT(result.mesh.normal[v].dot(x), 0.8);
  }
  EXPECT_GT(highest, 1 - 0.5 * 0.2);
}

TEST(HolePatches, HaveTheEdgesOfTheirSurroundings) {
  const Reconstruction result = meshOf(sphereBelow(0.6), watertight());
  const Points& x = result.mesh.position;
  std::vector<double> inside, outside;
  for (const Triangle& t : result.mesh.level_triangles[0]) {
    for (int i = 0; i < 3; ++i) {
      const Index u = t[i], v = t[(i + 1) % 3];
      const bool patch = result.mesh.kind[u] == VertexKind::Patch && result.mesh.kind[v] == VertexKind::Patch;
      (patch ? inside : outside).push_back((x[u] - x[v]).norm());
    }
  }
  const double ratio = test::quantile(inside, 0.5) / test::quantile(outside, 0.5);
  EXPECT_GT(ratio, 0.5);
  EXPECT_LT(ratio, 2);
}

TEST(HolePatches, LeaveTheRestAsItIs) {
  const Points world = sphereBelow(0.8);
  MultiresolutionParameters as_they_are;
  as_they_are.refinement.smooth_borders = false;
  const Reconstruction open = meshOf(world, as_they_are), closed = meshOf(world, watertight());
  EXPECT_TRUE(patchVertices(open.mesh).empty());
  EXPECT_EQ(open.patches.closed_loops, 0);
  const std::vector<Triangle>&a = open.mesh.level_triangles[0], &b = closed.mesh.level_triangles[0];
  ASSERT_EQ(b.size(), a.size() + static_cast<std::size_t>(closed.patches.triangles));
  EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin()));
  const auto count = static_cast<std::size_t>(open.mesh.level_vertices[0]);
  ASSERT_EQ(closed.representative_of.size(), count + static_cast<std::size_t>(closed.patches.vertices));
  EXPECT_EQ(closed.clusters.count(), closed.mesh.level_vertices[0]);
  for (std::size_t v = 0; v < count; ++v) EXPECT_EQ(open.mesh.position[v], closed.mesh.position[v]);
  for (Index v = static_cast<Index>(count); v < closed.mesh.level_vertices[0]; ++v) {
    EXPECT_EQ(closed.mesh.kind[v], VertexKind::Patch);
    EXPECT_EQ(closed.mesh.parents[v], (std::array<Index, 2>{v, v}));
    EXPECT_EQ(closed.clusters.size(v), 0);
  }
}

TEST(HolePatches, AreNotRefined) {
  const Reconstruction result = meshOf(sphereBelow(0.8), watertight());
  const RefinedMesh& mesh = result.mesh;
  ASSERT_GT(mesh.level_vertices[2], mesh.level_vertices[0]);
  for (Index v = mesh.level_vertices[0]; v < mesh.level_vertices[2]; ++v) {
    EXPECT_NE(mesh.kind[v], VertexKind::Patch);
    for (const Index parent : mesh.parents[v]) EXPECT_NE(mesh.kind[parent], VertexKind::Patch);
  }
}

TEST(HolePatches, CloseBothEndsOfATube) {
  const Reconstruction result = meshOf(test::evenSample("cylinder", 0.05), watertight());
  expectClosed(result);
  EXPECT_EQ(result.patches.closed_loops, 2);
}

TEST(HolePatches, CloseSheetsByABack) {
  for (const Points& world : {flatDisc(), test::planeLattice(30, 30), test::evenSample("saddle", 0.06)}) {
    const Reconstruction result = meshOf(world, watertight());
    expectClosed(result);
    EXPECT_EQ(result.patches.closed_loops, 1);
  }
}

TEST(HolePatches, CloseWhatWasNotReduced) {
  MultiresolutionParameters parameters = watertight();
  parameters.reduce = false;
  parameters.refinement.levels = 1;
  const Points world = keptOf(test::evenSample("sphere", 0.08), [](const Vec3& p) { return p.z() < 0.8; });
  expectClosed(meshOf(world, parameters));
}

TEST(HolePatches, CloseHolesUpToASize) {
  const Points world =
      keptOf(test::evenSample("sphere", 0.045), [](const Vec3& p) { return p.z() < 0.9 && p.z() > -0.6; });
  const Reconstruction open = meshOf(world, {});
  ASSERT_EQ(open.reports[0].border_loops, 2);
  // Around the holes it is 2 pi sin(angle) = 2.7 and 5.0.
  for (const auto& [size, left] : {std::pair<double, Index>{2, 2}, {4, 1}, {8, 0}}) {
    MultiresolutionParameters parameters;
    parameters.hole_size = size / open.spacing;
    const Reconstruction result = meshOf(world, parameters);
    for (const MeshReport& report : result.reports) EXPECT_EQ(report.border_loops, left) << size;
    EXPECT_EQ(result.patches.closed_loops, 2 - left);
  }
}

TEST(HolePatches, CloseEveryPiece) {
  Points world = sphereBelow(0.8);
  for (const Vec3& p : sphereBelow(0.5)) world.push_back(p + Vec3(5, 0, 0));
  const Reconstruction result = meshOf(world, watertight());
  for (const MeshReport& report : result.reports) {
    test::expectSound(report);
    EXPECT_EQ(report.components, 2);
    EXPECT_EQ(report.border_loops, 0);
    EXPECT_EQ(report.genus, 0);
    EXPECT_EQ(report.self_intersections, 0);
  }
}

TEST(HolePatches, CloseLongLoops) {
  Sheet sheet(tube(1500, 2));
  EXPECT_EQ(sheet.close().closed_loops, 2);
  const MeshReport report = sheet.report();
  test::expectSound(report);
  EXPECT_EQ(report.euler, 2);
  EXPECT_EQ(report.border_loops, 0);
  EXPECT_EQ(report.self_intersections, 0);
}

TEST(HolePatches, CloseLoopsWhoseEdgesAreTaken) {
  test::Soup one = test::tetrahedron(), two = one, triangle = one;
  one.triangles.pop_back();
  two.triangles.resize(2);  // one diagonal of the hole is an edge of the mesh
  triangle.triangles.resize(1);
  triangle.vertices.pop_back();
  for (const test::Soup& soup : {one, two, triangle}) {
    Sheet sheet(soup);
    EXPECT_EQ(sheet.close().closed_loops, 1) << soup.triangles.size();
    const MeshReport report = sheet.report();
    test::expectSound(report);
    EXPECT_EQ(report.euler, 2);
    EXPECT_EQ(report.self_intersections, 0);
  }
}

TEST(HolePatches, LeaveALoopThatNothingFits) {
  // Whatever closes the tube meets the long triangle that runs through it.
  const test::Soup soup = tube(12, 3);
  test::Soup spike;
  spike.vertices = {{0.5, -0.1, -1000}, {0.5, 0.1, -1000}, {0.5, 0, 1000}};
  spike.triangles = {{0, 1, 2}};
  Sheet sheet(test::together(soup, spike));
  const PatchCount count = sheet.close();
  EXPECT_EQ(count.closed_loops + count.open_loops, 3);
  EXPECT_GE(count.open_loops, 2);
  EXPECT_EQ(sheet.report().border_loops, count.open_loops);
  test::expectSound(sheet.report());
  EXPECT_EQ(sheet.report().self_intersections, 0);
}

TEST(HolePatches, DoNotDependOnThreadsOrOrder) {
  const Points world = test::noisy(sphereBelow(0.8), 0.002);
  const Reconstruction a = meshOf(world, watertight(), test::withThreads(1));
  const Reconstruction b = meshOf(test::shuffled(world, 3), watertight(), test::withThreads(4));
  EXPECT_GT(a.patches.vertices, 0);
  EXPECT_EQ(a.mesh.position, b.mesh.position);
  EXPECT_EQ(a.mesh.normal, b.mesh.normal);
  EXPECT_EQ(a.mesh.nearest, b.mesh.nearest);
  EXPECT_EQ(a.mesh.level_triangles, b.mesh.level_triangles);
  EXPECT_EQ(a.representative_of, b.representative_of);
}

}  // namespace
}  // namespace mlsmesh::core
