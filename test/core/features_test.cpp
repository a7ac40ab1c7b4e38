// SPDX-License-Identifier: BSD-3-Clause
#include "mlsmesh/core/features.h"

#include "mlsmesh/core/bsp_clustering.h"
#include "mlsmesh/core/multiresolution.h"
#include "side_flips.h"
#include "surfaces.h"

namespace mlsmesh::core {
namespace {

using test::Cloud;
using test::Points;
using test::Similarity;

constexpr double kDegree = 3.14159265358979323846 / 180;

// A solid with sharp edges: samples of it and its distance functions.
struct Solid {
  std::string name;
  std::function<Points(std::size_t)> sample;
  std::function<double(const Vec3&)> edge_distance;
  Points on_edges;  // some places of its edges
};

Vec3 onCubeFace(int face, double u, double v) {
  Vec3 p;
  p[face % 3] = face < 3 ? 1 : -1;
  p[(face + 1) % 3] = u;
  p[(face + 2) % 3] = v;
  return p;
}

// [-1, 1]^3.
Solid cube() {
  Solid solid{"cube", {}, {}, {}};
  solid.sample = [](std::size_t count) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> side(-1, 1);
    Points points;
    for (std::size_t i = 0; i < count; ++i) {
      const double u = side(random), v = side(random);
      points.push_back(onCubeFace(static_cast<int>(i % 6), u, v));
    }
    return points;
  };
  solid.edge_distance = [](const Vec3& p) {
    Vec3 off = (p.cwiseAbs() - Vec3::Ones()).cwiseAbs();
    std::sort(off.data(), off.data() + 3);
    return std::hypot(off[0], off[1]);
  };
  for (double t = -1; t <= 1; t += 0.05) {
    for (const double a : {-1.0, 1.0}) {
      for (const double b : {-1.0, 1.0}) {
        solid.on_edges.emplace_back(t, a, b);
        solid.on_edges.emplace_back(a, t, b);
        solid.on_edges.emplace_back(a, b, t);
      }
    }
  }
  return solid;
}

// Two squares of side 2 that meet in the z axis, `bend` degrees off flat.
Solid wedge(double bend) {
  Solid solid{"wedge of " + std::to_string(bend), {}, {}, {}};
  solid.sample = [bend](std::size_t count) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> along(-1, 1), off(0, 2);
    const Vec3 second(-std::cos(bend * kDegree), std::sin(bend * kDegree), 0);
    Points points;
    for (std::size_t i = 0; i < count; ++i) {
      const double z = along(random), r = off(random);
      points.push_back(Vec3(0, 0, z) + r * (i % 2 == 0 ? Vec3(Vec3::UnitX()) : second));
    }
    return points;
  };
  solid.edge_distance = [](const Vec3& p) { return std::hypot(p.x(), p.y()); };
  for (double z = -0.9; z <= 0.9; z += 0.05) solid.on_edges.emplace_back(0, 0, z);
  return solid;
}

// Radius 1, height 2, closed by caps.
Solid can() {
  Solid solid{"can", {}, {}, {}};
  solid.sample = [](std::size_t count) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0, 1);
    Points points;
    for (std::size_t i = 0; i < count; ++i) {
      const double angle = 360 * kDegree * unit(random), t = unit(random);
      const bool on_cap = i % 3 == 0;
      const double r = on_cap ? std::sqrt(t) : 1;
      const double z = !on_cap ? 2 * t - 1 : i % 2 == 0 ? 1 : -1;
      points.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
    }
    return points;
  };
  solid.edge_distance = [](const Vec3& p) {
    return std::hypot(std::hypot(p.x(), p.y()) - 1, std::abs(p.z()) - 1);
  };
  for (double angle = 0; angle < 360; angle += 5) {
    for (const double z : {-1.0, 1.0})
      solid.on_edges.emplace_back(std::cos(angle * kDegree), std::sin(angle * kDegree), z);
  }
  return solid;
}

struct Found {
  Cloud cloud;
  IndexLists clusters;
  Features features;

  explicit Found(const Points& world, const FeatureParameters& parameters = {})
      : cloud(world), clusters(clusterPoints(cloud.points.position, {}, {})) {
    const Representatives all = reducePoints(cloud.points, cloud.surface(), clusters, {}, {});
    features = detectFeatures(cloud.points, *cloud.search, clusters, all.variation, parameters, {});
  }
  Vec3 vertex(std::size_t i) const { return cloud.points.world(features.vertices[i].position); }
};

double distanceToNearest(const Points& points, const Vec3& x) {
  double least = std::numeric_limits<double>::max();
  for (const Vec3& p : points) least = std::min(least, (p - x).norm());
  return least;
}

TEST(Features, VerticesLieOnTheSharpEdgesAndCoverThem) {
  constexpr std::size_t kPoints = 10000;
  for (const Solid& solid : {cube(), wedge(60), wedge(90), wedge(120), can()}) {
    SCOPED_TRACE(solid.name);
    const Found found(solid.sample(kPoints));
    ASSERT_TRUE(found.features.any());
    std::vector<double> off;
    Points vertices;
    for (std::size_t i = 0; i < found.features.vertices.size(); ++i) {
      vertices.push_back(found.vertex(i));
      off.push_back(solid.edge_distance(vertices.back()) / found.features.vertices[i].spacing);
    }
    EXPECT_LT(test::quantile(off, 0.9), 0.02);
    EXPECT_LT(test::quantile(off, 1), 0.3);
    std::vector<double> gap;
    for (const Vec3& p : solid.on_edges)
      gap.push_back(distanceToNearest(vertices, p) / found.features.vertices[0].spacing);
    EXPECT_LT(test::quantile(gap, 1), 5);
  }
}

TEST(Features, KnowsTheSidesAndTheCorners) {
  const Solid solid = cube();
  const Found found(solid.sample(12000));
  int corners = 0;
  for (std::size_t i = 0; i < found.features.vertices.size(); ++i) {
    const CreaseVertex& vertex = found.features.vertices[i];
    ASSERT_TRUE(vertex.sides == 2 || vertex.sides == 3);
    for (int s = 0; s < vertex.sides; ++s) {
      EXPECT_GT(vertex.side_normal[static_cast<std::size_t>(s)].cwiseAbs().maxCoeff(), 0.99);
      EXPECT_NEAR(std::abs(vertex.normal.dot(vertex.side_normal[static_cast<std::size_t>(s)])),
                  vertex.sides == 2 ? std::sqrt(0.5) : std::sqrt(1.0 / 3), vertex.sides == 2 ? 0.1 : 0.25);
    }
    if (vertex.sides < 3) continue;
    ++corners;
    EXPECT_LT((found.vertex(i).cwiseAbs() - Vec3::Ones()).norm(), 0.3 * vertex.spacing);
  }
  EXPECT_EQ(corners, 8);
}

TEST(Features, VerticesKeepTheirDistance) {
  for (const double spacing : {1.5, 2.0, 3.0}) {
    FeatureParameters parameters;
    parameters.spacing = spacing;
    const Found found(cube().sample(10000), parameters);
    const auto& vertices = found.features.vertices;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const double local = std::min(vertices[i].spacing, vertices[j].spacing);
        EXPECT_GT((vertices[i].position - vertices[j].position).norm(), 0.5 * spacing * local);
      }
    }
  }
}

TEST(Features, SmoothSurfacesHaveNone) {
  for (const char* name : {"sphere", "torus", "saddle", "cylinder", "moebius", "figure"}) {
    SCOPED_TRACE(name);
    const Points random = test::randomSample(*shapes::makeShape(name), 8000);
    EXPECT_FALSE(Found(random).features.any());
    EXPECT_FALSE(Found(test::evenSample(name, 0.04)).features.any());
  }
}

TEST(Features, AnEdgeMustBendByTheAngle) {
  FeatureParameters blunt;
  blunt.angle = 75;
  EXPECT_FALSE(Found(wedge(60).sample(8000), blunt).features.any());
  EXPECT_FALSE(Found(wedge(15).sample(8000)).features.any());
  blunt.detect = false;
  EXPECT_FALSE(Found(cube().sample(8000), blunt).features.any());
}

TEST(Features, ClustersBySideHoldEveryPointOnce) {
  const Found found(cube().sample(8000));
  const SidedClusters sided = clustersBySide(found.cloud.points, found.clusters, found.features);
  EXPECT_EQ(sided.clusters.count() - sided.first_crease, static_cast<Index>(found.features.vertices.size()));
  std::vector<int> uses(found.cloud.points.position.size(), 0);
  for (Index c = 0; c < sided.clusters.count(); ++c) {
    ASSERT_GT(sided.clusters.size(c), 0);
    EXPECT_TRUE(std::is_sorted(sided.clusters.data(c), sided.clusters.data(c) + sided.clusters.size(c)));
    for (Index i = 0; i < sided.clusters.size(c); ++i) ++uses[sided.clusters.data(c)[i]];
  }
  EXPECT_EQ(std::count(uses.begin(), uses.end(), 1), static_cast<std::ptrdiff_t>(uses.size()));
}

Reconstruction reconstructed(const Points& world, int threads = 0, bool detect = true) {
  Context context = test::withThreads(threads);
  MultiresolutionParameters parameters;
  parameters.features.detect = detect;
  return reconstruct(makePointSet(world, StoredAs::Float, nullptr, context), nullptr, parameters, context);
}

double cubeDistance(const Vec3& p) {
  return std::abs(p.cwiseAbs().maxCoeff() - 1);
}

// Mean distance of the triangles' centroids from the cube.
double meanMiss(const Reconstruction& result, Index level) {
  double sum = 0;
  for (const auto& [a, b, c] : result.mesh.level_triangles[level]) {
    const auto& x = result.mesh.position;
    sum += cubeDistance(result.points.world((x[a] + x[b] + x[c]) / 3));
  }
  return sum / static_cast<double>(result.mesh.level_triangles[level].size());
}

TEST(Features, TheMeshOfACubeIsSharp) {
  const Points points = cube().sample(12000);
  const Reconstruction sharp = reconstructed(points), smooth = reconstructed(points, 0, false);
  for (Index level = 0; level < 3; ++level) {
    test::expectSound(sharp.reports[level]);
    EXPECT_EQ(sharp.reports[level].euler, 2);
    EXPECT_EQ(sharp.reports[level].border_loops, 0);
    EXPECT_LT(meanMiss(sharp, level), 0.15 * meanMiss(smooth, level));
    EXPECT_LE(sharp.reports[level].triangles, 1.3 * smooth.reports[level].triangles);
  }
  for (std::size_t v = 0; v < sharp.mesh.kind.size(); ++v) {
    if (sharp.mesh.kind[v] != VertexKind::Crease) continue;
    EXPECT_LT(cube().edge_distance(sharp.points.world(sharp.mesh.position[v])), 0.7 * sharp.spacing);
  }
}

TEST(Features, NoneInANoisyCloud) {
  const Points points = test::noisy(cube().sample(12000), 0.015);
  EXPECT_FALSE(reconstructed(points).features.any());
}

TEST(Features, SameBitsForAnyThreadsAndOrder) {
  const Points points = Similarity()(can().sample(6000));
  const Reconstruction one = reconstructed(points, 1);
  ASSERT_TRUE(one.features.any());
  const Reconstruction others[] = {reconstructed(points, 3), reconstructed(test::shuffled(points, 9), 2)};
  for (const Reconstruction& other : others) {
    EXPECT_EQ(one.mesh.position, other.mesh.position);
    EXPECT_EQ(one.mesh.normal, other.mesh.normal);
    EXPECT_EQ(one.mesh.kind, other.mesh.kind);
    EXPECT_EQ(one.mesh.level_triangles, other.mesh.level_triangles);
  }
}

TEST(SideFlips, AnEdgeAcrossASharpOneIsTurnedAlongIt) {
  const Points position{{0, 0, 0}, {0, 1, 0}, {-1, 0.5, -1}, {1, 0.5, -1}};  // 0 - 1 is the ridge
  const Vec3 left = Vec3(-1, 0, 1).normalized(), right = Vec3(1, 0, 1).normalized();
  const VertexSides ridge{{left, right}, 2}, on_left{{left}, 1}, on_right{{right}, 1};
  HalfEdgeMesh mesh;
  ASSERT_TRUE(buildMesh(4, {{2, 3, 1}, {3, 2, 0}}, mesh));
  EXPECT_EQ(flipToSides(mesh, position, {ridge, ridge, on_left, VertexSides()}), 0);
  EXPECT_EQ(flipToSides(mesh, position, {ridge, ridge, on_left, on_right}), 1);
  EXPECT_NE(mesh.find(0, 1), kNone);
  EXPECT_EQ(mesh.find(2, 3), kNone);
  EXPECT_EQ(flipToSides(mesh, position, {ridge, ridge, on_left, on_right}), 0);
}

}  // namespace
}  // namespace mlsmesh::core
