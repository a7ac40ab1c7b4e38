// SPDX-License-Identifier: BSD-3-Clause
#include "mlsmesh/core/mls_refinement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "mlsmesh/core/failure.h"
#include "mlsmesh/core/multiresolution.h"
#include "surfaces.h"
#include "test_shapes.h"

namespace mlsmesh::core {
namespace {

using test::Cloud;
using test::Points;

RefinedMesh levelZero(const Points& vertices, const std::vector<Triangle>& triangles) {
  RefinedMesh mesh;
  const auto count = static_cast<Index>(vertices.size());
  mesh.position = vertices;
  mesh.normal = vertexNormals(triangles, vertices);
  mesh.kind.assign(vertices.size(), VertexKind::Projected);
  mesh.nearest.assign(vertices.size(), 0);
  for (Index v = 0; v < count; ++v) mesh.parents.push_back({v, v});
  mesh.level_vertices = {count};
  mesh.level_triangles = {triangles};
  return mesh;
}

/// A cloud with the mesh over its representatives.
struct Coarse {
  const Cloud cloud;
  const RefinedMesh mesh;

  explicit Coarse(const Points& world, StoredAs stored_as = StoredAs::Double)
      : cloud(world, stored_as), mesh(coarsest(cloud)) {}

  RefinedMesh refined(const RefinementParameters& parameters, int threads = 0) const {
    RefinedMesh result = mesh;
    refineMesh(cloud.points, cloud.surface(), cloud.spacing, parameters, test::withThreads(threads), result);
    return result;
  }

 private:
  static RefinedMesh coarsest(const Cloud& cloud) {
    MultiresolutionParameters parameters;
    parameters.refinement.levels = 0;
    Context context;
    return reconstruct(cloud.points, nullptr, parameters, context).mesh;
  }
};

RefinementParameters everyEdge(int levels = 2) {
  RefinementParameters parameters;
  parameters.levels = levels;
  parameters.threshold = 0;
  return parameters;
}

std::vector<RefinementParameters> variants() {
  std::vector<RefinementParameters> all(5);
  all[0] = everyEdge();
  all[1].threshold = 0.02;
  all[2] = paperPreset().refinement;
  all[3] = printedPreset().refinement;
  all[4].flips = FlipRule::NoFlips;
  all[4].split_mode = SplitMode::Sequential;
  for (RefinementParameters& parameters : all) parameters.levels = 2;
  return all;
}

MeshReport reportOf(const RefinedMesh& mesh, Index level) {
  const Points vertices(mesh.position.begin(), mesh.position.begin() + mesh.level_vertices[level]);
  return reportMesh(vertices, mesh.level_triangles[level]);
}

HalfEdgeMesh halfEdges(const RefinedMesh& mesh, Index level) {
  HalfEdgeMesh result;
  EXPECT_TRUE(buildMesh(mesh.level_vertices[level], mesh.level_triangles[level], result));
  return result;
}

class RefinedShape : public testing::TestWithParam<const char*> {
 protected:
  const std::unique_ptr<shapes::Shape> shape_ = shapes::makeShape(GetParam());
  const Coarse coarse_{test::evenSample(*shape_, 0.05)};
};

TEST_P(RefinedShape, KeepsItsTopologyAtEveryLevel) {
  for (const RefinementParameters& parameters : variants()) {
    const RefinedMesh mesh = coarse_.refined(parameters);
    ASSERT_EQ(mesh.levelCount(), 3);
    for (Index level = 0; level < mesh.levelCount(); ++level) {
      const MeshReport report = reportOf(mesh, level);
      test::expectTopologyOf(*shape_, report);
      EXPECT_EQ(report.isolated_vertices, 0);
    }
    EXPECT_GT(mesh.level_vertices[1], mesh.level_vertices[0]);
  }
}

TEST_P(RefinedShape, LeavesEarlierVerticesWhereTheyAre) {
  for (const RefinementParameters& parameters : variants()) {
    RefinedMesh mesh = coarse_.mesh;
    for (int level = 0; level < 2; ++level) {
      const RefinedMesh before = mesh;
      addLevel(coarse_.cloud.points, coarse_.cloud.surface(), coarse_.cloud.spacing, parameters, {}, mesh);
      ASSERT_EQ(mesh.levelCount(), before.levelCount() + 1);
      ASSERT_EQ(mesh.level_vertices.back(), static_cast<Index>(mesh.position.size()));
      const auto is_prefix = [](const auto& longer, const auto& shorter) {
        return std::equal(shorter.begin(), shorter.end(), longer.begin());
      };
      EXPECT_TRUE(is_prefix(mesh.position, before.position));
      EXPECT_TRUE(is_prefix(mesh.normal, before.normal));
      EXPECT_TRUE(is_prefix(mesh.kind, before.kind));
      EXPECT_TRUE(is_prefix(mesh.parents, before.parents));
      EXPECT_TRUE(is_prefix(mesh.level_vertices, before.level_vertices));
      EXPECT_TRUE(is_prefix(mesh.level_triangles, before.level_triangles));
      EXPECT_EQ(mesh.normal.size(), mesh.position.size());
      EXPECT_EQ(mesh.kind.size(), mesh.position.size());
      EXPECT_EQ(mesh.nearest.size(), mesh.position.size());
      EXPECT_EQ(mesh.parents.size(), mesh.position.size());
    }
  }
}

TEST_P(RefinedShape, PlacesVerticesNearTheMiddleOfTheirEdges) {
  for (const RefinementParameters& parameters : variants()) {
    const RefinedMesh mesh = coarse_.refined(parameters);
    for (Index level = 1; level < mesh.levelCount(); ++level) {
      const HalfEdgeMesh before = halfEdges(mesh, level - 1);
      for (Index v = mesh.level_vertices[level - 1]; v < mesh.level_vertices[level]; ++v) {
        const auto [a, b] = mesh.parents[v];
        ASSERT_TRUE(before.find(a, b) != kNone || before.find(b, a) != kNone);
        const Index h = before.find(a, b) != kNone ? before.find(a, b) : before.find(b, a);
        const double edge = (mesh.position[a] - mesh.position[b]).norm();
        const double moved = (mesh.position[v] - 0.5 * (mesh.position[a] + mesh.position[b])).norm();
        EXPECT_LE(moved, (before.isBorder(h) ? 0.25 : 0.5) * edge * (1 + 1e-9));
        EXPECT_TRUE(mesh.kind[v] != VertexKind::Border || before.isBorder(h));
      }
    }
  }
}

TEST_P(RefinedShape, KeepsTheCornersOfBorders) {
  for (const RefinementParameters& parameters : variants()) {
    const RefinedMesh mesh = coarse_.refined(parameters);
    for (Index level = 1; level < mesh.levelCount(); ++level) {
      const HalfEdgeMesh before = halfEdges(mesh, level - 1), after = halfEdges(mesh, level);
      for (Index v = 0; v < before.vertexCount(); ++v)
        EXPECT_EQ(before.isBorderVertex(v), after.isBorderVertex(v));
    }
  }
}

TEST_P(RefinedShape, ComesNearerToTheTruth) {
  const RefinedMesh mesh = coarse_.refined(everyEdge());
  std::vector<double> errors;  // of the triangles' middles, away from borders, level by level
  for (Index level = 0; level < mesh.levelCount(); ++level) {
    std::vector<double> distances;
    for (const auto& [a, b, c] : mesh.level_triangles[level]) {
      const Vec3 middle = (mesh.position[a] + mesh.position[b] + mesh.position[c]) / 3;
      const Vec3 world = coarse_.cloud.points.world(middle);
      if (shape_->borderDistanceBound(shape_->closestPoint(world)) > 0.2)
        distances.push_back(shape_->distance(world));
    }
    errors.push_back(test::rootMeanSquare(distances));
  }
  // Halving the edges divides the sagitta of a triangle by four.
  EXPECT_LT(errors[1], errors[0] / 3);
  EXPECT_LT(errors[2], errors[1] / 3);
}

TEST_P(RefinedShape, HasNormalsOnTheSideOfItsTriangles) {
  const RefinedMesh mesh = coarse_.refined(everyEdge());
  const Points of_triangles = vertexNormals(mesh.level_triangles.back(), mesh.position);
  for (std::size_t v = 0; v < mesh.position.size(); ++v) {
    EXPECT_NEAR(mesh.normal[v].norm(), 1, 1e-9);
    const Vec3 truth = shape_->closestPoint(coarse_.cloud.points.world(mesh.position[v]));
    if (shape_->borderDistanceBound(truth) < 0.1) continue;  // triangles along a border may be steep
    EXPECT_GT(mesh.normal[v].dot(of_triangles[v]), 0.9);
    EXPECT_GT(std::abs(mesh.normal[v].dot(shape_->normal(truth))), 0.99);
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, RefinedShape, testing::Values("sphere", "torus", "saddle", "cylinder"),
                         [](const auto& tested) { return std::string(tested.param); });

TEST(MlsRefinement, SplitsExactlyTheEdgesThatTheSurfaceLiesOff) {
  const Coarse coarse(test::evenSample("torus", 0.06));
  RefinementParameters parameters;
  parameters.levels = 1;
  parameters.threshold = 0.3;
  parameters.min_edge_ratio = 0;
  parameters.fold_guard = false;
  const RefinedMesh mesh = coarse.refined(parameters);
  std::map<std::pair<Index, Index>, bool> is_split;
  for (Index v = mesh.level_vertices[0]; v < mesh.level_vertices[1]; ++v)
    is_split[std::minmax(mesh.parents[v][0], mesh.parents[v][1])] = true;
  const MlsSurface surface = coarse.cloud.surface();
  const Points normals = vertexNormals(mesh.level_triangles[0], mesh.position);
  int split = 0, whole = 0;
  for (const Triangle& t : mesh.level_triangles[0]) {
    for (int i = 0; i < 3; ++i) {
      const auto edge = std::minmax(t[i], t[(i + 1) % 3]);
      const Vec3 middle = 0.5 * (mesh.position[edge.first] + mesh.position[edge.second]);
      const Vec3 normal = (normals[edge.first] + normals[edge.second]).normalized();
      const Projection projection = surface.project(middle);
      const double off = std::abs((projection.position - middle).dot(normal)) / projection.spacing;
      if (std::abs(off - 0.3) < 1e-9) continue;
      EXPECT_EQ(is_split.count(edge) > 0, off > 0.3);
      ++(off > 0.3 ? split : whole);
    }
  }
  EXPECT_GT(split, 50);
  EXPECT_GT(whole, 50);
}

TEST(MlsRefinement, LeavesAFlatCloudAsItIs) {
  const Coarse coarse(test::planeLattice(40, 40));
  for (const RefinementParameters& parameters : {RefinementParameters(), paperPreset().refinement}) {
    RefinementParameters tested = parameters;
    tested.flips = FlipRule::NoFlips;
    tested.smooth_borders = false;
    const RefinedMesh mesh = coarse.refined(tested);
    EXPECT_EQ(mesh.level_vertices, std::vector<Index>(3, mesh.level_vertices[0]));
    EXPECT_EQ(mesh.level_triangles[1], mesh.level_triangles[0]);
    EXPECT_EQ(mesh.level_triangles[2], mesh.level_triangles[0]);
  }
}

TEST(MlsRefinement, LeavesThinTrianglesWhole) {
  const Cloud cloud(test::evenSample("sphere", 0.05));
  const auto onSphere = [](double x, double y) { return Vec3(x, y, std::sqrt(1 - x * x - y * y)); };
  // A needle on the edge from vertex 0 to 1, and a stout triangle on its other side.
  const Points vertices = {onSphere(0, 0), onSphere(0.4, 0), onSphere(0.4, 0.02), onSphere(0.2, -0.35)};
  const std::vector<Triangle> triangles = {{0, 1, 2}, {1, 0, 3}};
  RefinementParameters parameters = everyEdge(1);
  parameters.flips = FlipRule::NoFlips;
  for (const double ratio : {0.1, 0.0}) {
    parameters.min_edge_ratio = ratio;
    RefinedMesh mesh = levelZero(vertices, triangles);
    for (Vec3& p : mesh.position) p -= cloud.points.origin;
    refineMesh(cloud.points, cloud.surface(), cloud.spacing, parameters, {}, mesh);
    const std::vector<Triangle>& finer = mesh.level_triangles[1];
    const bool kept = std::find(finer.begin(), finer.end(), triangles[0]) != finer.end();
    EXPECT_EQ(kept, ratio > 0);
    EXPECT_EQ(finer.size(), ratio > 0 ? 1u + 3u : 4u + 4u);
  }
}

TEST(MlsRefinement, KeepsNewVerticesWithinTheirLimits) {
  // So noisy that many projections lead away from their edges.
  const Coarse coarse(test::noisy(test::evenSample("cylinder", 0.05), 0.06));
  RefinementParameters parameters = everyEdge(1);
  parameters.fold_guard = false;
  parameters.max_displacement = 0.2;
  parameters.border_displacement = 0.05;
  const RefinedMesh mesh = coarse.refined(parameters);
  const HalfEdgeMesh before = halfEdges(mesh, 0);
  int clamped = 0, clamped_on_border = 0;
  for (Index v = mesh.level_vertices[0]; v < mesh.level_vertices[1]; ++v) {
    const auto [a, b] = mesh.parents[v];
    const Index h = before.find(a, b) != kNone ? before.find(a, b) : before.find(b, a);
    ASSERT_NE(h, kNone);
    const double edge = (mesh.position[a] - mesh.position[b]).norm();
    const double moved = (mesh.position[v] - 0.5 * (mesh.position[a] + mesh.position[b])).norm();
    EXPECT_LE(moved, (before.isBorder(h) ? 0.05 : 0.2) * edge * (1 + 1e-9));
    if (mesh.kind[v] == VertexKind::Clamped) ++(before.isBorder(h) ? clamped_on_border : clamped);
  }
  EXPECT_GT(clamped, 0);
  EXPECT_GT(clamped_on_border, 0);
}

TEST(MlsRefinement, MovesBordersAlongTheSurfaceNormalAloneWhereTheyAreNotSmoothed) {
  // The mesh ends half a spacing inside the lattice: the projections of its border stay in the plane, and
  // their tangential part, which would move the loop, is taken off.
  Points bowl = test::planeLattice(40, 40);
  for (Vec3& p : bowl) p.z() = 0.01 * (p.x() * p.x() + p.y() * p.y());
  const Coarse coarse(bowl);
  RefinementParameters parameters = everyEdge(1);
  parameters.fold_guard = false;
  parameters.smooth_borders = false;
  const RefinedMesh mesh = coarse.refined(parameters);
  const HalfEdgeMesh before = halfEdges(mesh, 0);
  const Points normals = vertexNormals(mesh.level_triangles[0], mesh.position);
  int checked = 0;
  for (Index v = mesh.level_vertices[0]; v < mesh.level_vertices[1]; ++v) {
    if (mesh.kind[v] != VertexKind::Border) continue;
    const auto [a, b] = mesh.parents[v];
    const Vec3 moved = mesh.position[v] - 0.5 * (mesh.position[a] + mesh.position[b]);
    EXPECT_LT(moved.cross((normals[a] + normals[b]).normalized()).norm(), 1e-9);
    ++checked;
  }
  EXPECT_GT(checked, 10);
}

TEST(MlsRefinement, GuardsFolds) {
  // A mesh far coarser than the noise of its cloud: many projections turn children over.
  const Coarse coarse(test::noisy(test::evenSample("sphere", 0.05), 0.06));
  const auto turned = [&](bool guard) {
    RefinementParameters parameters = everyEdge(1);
    parameters.flips = FlipRule::NoFlips;
    parameters.max_displacement = 2;
    parameters.fold_guard = guard;
    const RefinedMesh mesh = coarse.refined(parameters);
    const HalfEdgeMesh before = halfEdges(mesh, 0);
    int count = 0;
    for (const Triangle& child : mesh.level_triangles[1]) {
      std::vector<Index>
          corners;  // the ends of the edges its new vertices were made on: its parent's corners
      for (const Index v : child)
        for (const Index p : mesh.parents[v])
          if (std::find(corners.begin(), corners.end(), p) == corners.end()) corners.push_back(p);
      if (corners.size() != 3) continue;
      Index h = before.find(corners[0], corners[1]);
      if (h == kNone || before.opposite(h) != corners[2]) h = before.find(corners[1], corners[0]);
      if (h == kNone || before.opposite(h) != corners[2]) continue;
      const auto normal = [&](const Triangle& t) {
        const Vec3& a = mesh.position[t[0]];
        return (mesh.position[t[1]] - a).cross(mesh.position[t[2]] - a).normalized();
      };
      count += normal(child).dot(normal(before.corners(HalfEdgeMesh::triangleOf(h)))) < 0.5 - 1e-9;
    }
    return count;
  };
  EXPECT_GT(turned(false), 5);
  EXPECT_EQ(turned(true), 0);
}

TEST(MlsRefinement, RoundsToTheTypeThatIsStored) {
  test::Similarity motion;
  motion.shift = Vec3(431000.25, 5240000.5, 300);  // as in a map; floats are 0.03 to 0.5 apart there
  motion.scale = 500;
  const Coarse coarse(motion(test::evenSample("torus", 0.06)), StoredAs::Float);
  const RefinedMesh mesh = coarse.refined(everyEdge());
  for (const Vec3& p : mesh.position) EXPECT_EQ(coarse.cloud.points.stored(p), p);
  for (Index level = 0; level < 3; ++level) test::expectSound(reportOf(mesh, level));
}

TEST(MlsRefinement, NamesThePointNearestToEachVertex) {
  const Coarse coarse(test::evenSample("torus", 0.06));
  const RefinedMesh mesh = coarse.refined(everyEdge());
  for (std::size_t v = 0; v < mesh.position.size(); ++v) {
    Index nearest;
    double squared;
    coarse.cloud.search->nearest(mesh.position[v], 1, &nearest, &squared);
    EXPECT_LE((coarse.cloud.points.position[mesh.nearest[v]] - mesh.position[v]).norm(),
              std::sqrt(squared) + 1e-9);
  }
}

TEST(MlsRefinement, DoesNotDependOnThreads) {
  const Coarse coarse(test::randomSample(*shapes::makeShape("torus"), 4000));
  for (const RefinementParameters& parameters : variants()) {
    const RefinedMesh one = coarse.refined(parameters, 1), four = coarse.refined(parameters, 4);
    EXPECT_EQ(one.position, four.position);
    EXPECT_EQ(one.normal, four.normal);
    EXPECT_EQ(one.level_vertices, four.level_vertices);
    EXPECT_EQ(one.level_triangles, four.level_triangles);
  }
}

StatusCode refusalOf(const std::vector<Triangle>& triangles, const Context& context = {}) {
  const Cloud cloud(test::evenSample("sphere", 0.2));
  const Points vertices(cloud.points.position.begin(), cloud.points.position.begin() + 6);
  RefinedMesh mesh = levelZero(vertices, {});
  mesh.level_triangles = {triangles};
  try {
    refineMesh(cloud.points, cloud.surface(), cloud.spacing, {}, context, mesh);
  } catch (const Failure& failure) {
    return failure.code();
  }
  return StatusCode::Ok;
}

TEST(MlsRefinement, RefusesMeshesThatAreNoOrientedManifold) {
  EXPECT_EQ(refusalOf({{0, 1, 2}, {1, 0, 3}}), StatusCode::Ok);
  EXPECT_EQ(refusalOf({{0, 1, 2}, {0, 1, 3}}), StatusCode::InvalidMesh);             // misoriented
  EXPECT_EQ(refusalOf({{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}), StatusCode::InvalidMesh);  // three at an edge
  EXPECT_EQ(refusalOf({{0, 1, 1}}), StatusCode::InvalidMesh);
  EXPECT_EQ(refusalOf({{0, 1, 6}}), StatusCode::InvalidMesh);
  EXPECT_EQ(refusalOf({{0, -1, 2}}), StatusCode::InvalidMesh);
  EXPECT_EQ(refusalOf({{0, 1, 2}, {0, 3, 4}}), StatusCode::InvalidMesh);  // two fans at vertex 0
}

TEST(MlsRefinement, CanBeCancelled) {
  Context context;
  context.progress.cancel();
  EXPECT_EQ(refusalOf({{0, 1, 2}, {1, 0, 3}}, context), StatusCode::Cancelled);
}

TEST(VertexNormals, AreTheMeanOfTheTrianglesAround) {
  const test::Soup ball = test::octahedron();
  Points vertices = ball.vertices;
  vertices.emplace_back(5, 5, 5);  // in no triangle
  const Points normals = vertexNormals(ball.triangles, vertices);
  for (Index v = 0; v < ball.vertexCount(); ++v) EXPECT_LT((normals[v] - vertices[v]).norm(), 1e-12);
  EXPECT_EQ(normals.back(), Vec3(0, 0, 0));
}

}  // namespace
}  // namespace mlsmesh::core
