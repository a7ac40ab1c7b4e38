// SPDX-License-Identifier: BSD-3-Clause
#include "mlsmesh/core/advancing_front.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "mlsmesh/core/failure.h"
#include "surfaces.h"
#include "test_shapes.h"

namespace mlsmesh::core {
namespace {

using test::Points;

/// A cloud with the mesh over it.
struct Meshed {
  PointSet set;
  Triangulation mesh;
  Points vertices;  ///< the points and the copies of split ones
  MeshReport report;
};

struct Options {
  TriangulationParameters parameters;
  bool may_split = false;
  int threads = 0;
};

Meshed meshOf(const Points& world, const Options& options = {}) {
  Context context = test::withThreads(options.threads);
  Meshed result;
  result.set = makePointSet(world, StoredAs::Double, nullptr, context);
  const auto search = makeKdTree(result.set.position);
  TriangulationInput input{result.set.position};
  input.search = search.get();
  input.spacing = medianSpacing(result.set.position, *search, context);
  input.may_split = options.may_split;
  result.mesh = triangulate(input, options.parameters, context);
  result.vertices = result.set.position;
  for (const Index original : result.mesh.duplicate_of)
    result.vertices.push_back(result.vertices.at(original));
  result.report = reportMesh(result.vertices, result.mesh.triangles);
  return result;
}

Points nearDuplicates(Points points) {
  const std::size_t count = points.size();
  for (std::size_t i = 0; i < count; i += 10) points.push_back(points[i] + Vec3(3e-5, -2e-5, 1e-5));
  return points;
}

Points twoSheets() {
  Points points = test::randomCloud(2000, 5);
  for (std::size_t i = 0; i < points.size(); ++i) points[i].z() = i % 2 == 0 ? 0 : 0.03;
  return points;
}

/// Clouds that have no right answer: only the promises hold.
std::vector<Points> hardClouds() {
  return {test::randomCloud(1500, 1),
          test::noisy(test::evenSample("sphere", 0.08), 0.03),
          test::randomSample(*shapes::makeShape("figure"), 3000),
          twoSheets(),
          test::lattice(9),
          nearDuplicates(test::randomSample(*shapes::makeShape("torus"), 1500)),
          test::evenSample("moebius", 0.08)};
}

std::vector<TriangulationParameters> presets() {
  return {defaultPreset().triangulation, paperPreset().triangulation, printedPreset().triangulation};
}

Points capped(const Points& sphere, double radius) {
  Points points;
  for (const Vec3& p : sphere)
    if ((p - Vec3::UnitY()).norm() >= radius) points.push_back(p);
  return points;
}

class CleanShape : public testing::TestWithParam<const char*> {
 protected:
  const std::unique_ptr<shapes::Shape> shape_ = shapes::makeShape(GetParam());
  const Points world_ = test::evenSample(*shape_, 0.07);
};

TEST_P(CleanShape, HasItsTopology) {
  const Meshed result = meshOf(world_);
  test::expectTopologyOf(*shape_, result.report);
  EXPECT_EQ(result.mesh.statistics.unused_points, 0);
  EXPECT_EQ(result.report.isolated_vertices, 0);
  // Euler: a closed mesh of V vertices has 2 (V - euler) triangles, and each border edge takes one away.
  EXPECT_EQ(result.report.triangles,
            2 * (result.set.size() - result.report.euler) - result.report.border_edges);
}

TEST_P(CleanShape, HasItsTopologyAsThePaperSeedsIt) {
  const Meshed result = meshOf(world_, {paperPreset().triangulation});
  test::expectTopologyOf(*shape_, result.report);
}

TEST_P(CleanShape, KeepsItUnderMotionAndScale) {
  const Meshed result = meshOf(world_);
  for (const double scale : {1e-3, 1.0, 1e4}) {
    test::Similarity motion;
    motion.scale = scale;
    const Meshed moved = meshOf(motion(world_));
    test::expectTopologyOf(*shape_, moved.report);
    EXPECT_NEAR(moved.report.border_edges, result.report.border_edges, 0.02 * result.report.border_edges);
  }
}

TEST_P(CleanShape, AddsUp) {
  const Meshed result = meshOf(world_);
  const FrontStatistics& counts = result.mesh.statistics;
  EXPECT_EQ(
      counts.seed_triangles + counts.front_triangles + counts.filled_triangles - counts.dropped_triangles,
      result.report.triangles);
  EXPECT_GT(counts.seed_triangles, 9 * counts.front_triangles);  // stars agree nearly everywhere
}

INSTANTIATE_TEST_SUITE_P(Shapes, CleanShape, testing::Values("sphere", "torus", "saddle", "cylinder"),
                         [](const auto& tested) { return std::string(tested.param); });

TEST(AdvancingFront, TurnsClosedSurfacesOutward) {
  constexpr double kPi = 3.14159265358979323846;
  const Points sphere = test::evenSample("sphere", 0.1), torus = test::evenSample("torus", 0.1);
  const auto volumeOf = [](const Points& world, const Eigen::Matrix3d& rotation) {
    Points rotated = world;
    for (Vec3& p : rotated) p = rotation * p;
    const Meshed result = meshOf(rotated);
    return test::signedVolume(result.vertices, result.mesh.triangles) / 6;
  };
  for (int turn = 0; turn < 8; ++turn) {  // the first triangle, and with it the side it shows, differs
    const Eigen::Matrix3d rotation = Eigen::AngleAxisd(0.8 * turn, Vec3(0.6, -0.48, 0.64)).toRotationMatrix();
    EXPECT_NEAR(volumeOf(sphere, rotation), 4 * kPi / 3, 0.05);
    EXPECT_NEAR(volumeOf(torus, rotation), 2 * kPi * kPi * 0.16, 0.1);
  }
}

TEST(AdvancingFront, MeshesEveryComponent) {
  const Points ball = test::evenSample("sphere", 0.1);
  Points two = ball;
  for (const Vec3& p : ball) two.push_back(0.7 * p + Vec3(2.2, 0, 0));
  const Meshed result = meshOf(two);
  test::expectSound(result.report);
  EXPECT_EQ(result.report.components, 2);
  EXPECT_EQ(result.report.euler, 4);
  EXPECT_EQ(result.report.border_loops, 0);
  EXPECT_EQ(result.mesh.statistics.unused_points, 0);
  // Both outward: the volumes add up.
  EXPECT_NEAR(test::signedVolume(result.vertices, result.mesh.triangles) / 6, 4.18879 * (1 + 0.343), 0.1);

  Options once;
  once.parameters.restart = false;
  EXPECT_EQ(meshOf(two, once).report.components, 1);
}

TEST(AdvancingFront, MeshesAnExactLatticeCompletely) {
  const Meshed result = meshOf(test::planeLattice(200, 200));
  test::expectSound(result.report);
  EXPECT_EQ(result.report.triangles, 2 * 199 * 199);
  EXPECT_EQ(result.report.border_loops, 1);
  EXPECT_EQ(result.report.border_edges, 4 * 199);
}

TEST(AdvancingFront, MeshesAMoebiusBandAsAnOrientedStrip) {
  const Points world = test::evenSample("moebius", 0.07);
  for (const TriangulationParameters& parameters : presets()) {
    const Meshed result = meshOf(world, {parameters});
    test::expectSound(result.report);
  }
  const Meshed result = meshOf(world);
  EXPECT_EQ(result.report.components, 1);
  // Nearly all of it: only along one cut across the band triangles are missing.
  EXPECT_GT(result.report.triangles, 1.8 * result.set.size());
}

TEST(AdvancingFront, IsSoundWhateverThePoints) {
  std::size_t all_copies = 0;
  Index all_dropped = 0;
  for (const Points& world : hardClouds()) {
    for (const TriangulationParameters& parameters : presets()) {
      for (const bool may_split : {false, true}) {
        const Meshed result = meshOf(world, {parameters, may_split});
        test::expectSound(result.report);
        const std::size_t copies = result.mesh.duplicate_of.size();
        EXPECT_EQ(copies, static_cast<std::size_t>(result.mesh.statistics.split_vertices));
        EXPECT_TRUE(may_split || copies == 0);
        for (const Index original : result.mesh.duplicate_of) EXPECT_LT(original, result.set.size());
        all_copies += copies;
        all_dropped += result.mesh.statistics.dropped_triangles;
      }
    }
  }
  EXPECT_GT(all_copies, 0u);  // the clouds are meant to pinch
  EXPECT_GT(all_dropped, 0);
}

TEST(AdvancingFront, IsSoundWithEveryRuleAlone) {
  const TriangulationParameters printed = printedPreset().triangulation;
  std::vector<TriangulationParameters> variants(7);
  variants[0].order = printed.order;
  variants[1].candidates = printed.candidates;
  variants[2].apex_choice = printed.apex_choice;
  variants[3].length_rule = printed.length_rule;
  variants[4].overlap_test = printed.overlap_test;
  variants[5].neighbors = 4;
  variants[6].bend_first = 180;
  variants[6].bend_max = 180;
  for (const TriangulationParameters& parameters : variants)
    for (const Points& world : {test::randomCloud(800, 1), twoSheets()})
      test::expectSound(meshOf(world, {parameters}).report);
}

TEST(AdvancingFront, ClosesOverNearDuplicates) {
  const Meshed result = meshOf(nearDuplicates(test::evenSample("sphere", 0.08)));
  test::expectTopologyOf(*shapes::makeShape("sphere"), result.report);
}

TEST(AdvancingFront, ClosesANoisySphere) {
  const Meshed result = meshOf(test::noisy(test::evenSample("sphere", 0.08), 0.004));
  test::expectTopologyOf(*shapes::makeShape("sphere"), result.report);
}

TEST(AdvancingFront, KeepsALargeHole) {
  const Meshed result = meshOf(capped(test::evenSample("sphere", 0.07), 0.5));
  test::expectSound(result.report);
  EXPECT_EQ(result.report.components, 1);
  EXPECT_EQ(result.report.border_loops, 1);
  EXPECT_EQ(result.report.euler, 1);
}

TEST(AdvancingFront, ClosesASmallHole) {
  const Meshed result = meshOf(capped(test::evenSample("sphere", 0.07), 0.08));
  test::expectTopologyOf(*shapes::makeShape("sphere"), result.report);
}

TEST(AdvancingFront, KeepsEdgesWithinTheirLimit) {
  Options options;
  options.parameters.fill_small_loops = false;
  const Meshed result = meshOf(test::randomSample(*shapes::makeShape("torus"), 3000), options);
  const NeighborTable neighbors =
      nearestOfAll(result.set.position, *makeKdTree(result.set.position), options.parameters.neighbors, {});
  const std::vector<double> spacing = localSpacings(result.set.position, neighbors, {});
  for (const Triangle& t : result.mesh.triangles) {
    const double widest = std::max({spacing[t[0]], spacing[t[1]], spacing[t[2]]});
    for (int i = 0; i < 3; ++i) {
      const double length = (result.vertices[t[i]] - result.vertices[t[(i + 1) % 3]]).norm();
      EXPECT_LE(length, options.parameters.length_factor * widest * (1 + 1e-12));
    }
  }
}

TEST(AdvancingFront, BendsNoFartherThanItMay) {
  Options options;
  options.parameters.seeds = SeedRule::SingleTriangle;
  options.parameters.restart = false;
  options.parameters.fill_small_loops = false;
  options.parameters.bend_first = options.parameters.bend_max = 12;
  const Meshed result = meshOf(test::evenSample("sphere", 0.2), options);
  HalfEdgeMesh mesh;
  ASSERT_TRUE(buildMesh(result.set.size(), result.mesh.triangles, mesh));
  const auto normal = [&](Index h) {
    const Vec3& u = result.vertices[mesh.origin(h)];
    return (result.vertices[mesh.target(h)] - u).cross(result.vertices[mesh.opposite(h)] - u).normalized();
  };
  // Every triangle but the first was attached across an edge that bends by no more than that.
  std::vector<Index> reached = {0};
  std::vector<char> seen(result.mesh.triangles.size(), 0);
  seen[0] = 1;
  int sharper = 0;
  for (std::size_t next = 0; next < reached.size(); ++next) {
    for (Index h = 3 * reached[next]; h < 3 * reached[next] + 3; ++h) {
      if (mesh.isBorder(h)) continue;
      const Index other = HalfEdgeMesh::triangleOf(mesh.twin(h));
      const bool flat = normal(h).dot(normal(mesh.twin(h))) >= std::cos(12.0001 * 0.0174532925199433);
      sharper += flat ? 0 : 1;
      if (!flat || seen[other]) continue;
      seen[other] = 1;
      reached.push_back(other);
    }
  }
  EXPECT_EQ(reached.size(), result.mesh.triangles.size());
  EXPECT_GT(reached.size(), 50u);
  EXPECT_GT(sharper, 0);
}

/// Lattices over a square with a round opening in the middle.
Points holedLattice(double step, double hole_radius) {
  Points points;
  for (double x = 0; x <= 20; x += step)
    for (double y = 0; y <= 20; y += step)
      if (std::hypot(x - 10.5, y - 10.5) >= hole_radius) points.emplace_back(x, y, 0);
  return points;
}

TEST(AdvancingFront, LeavesOpenWhereTheCloudHasNoPoints) {
  const Points representatives = holedLattice(1, 1.2);  // without four of them
  const auto loops = [&](const Points* cloud) {
    const std::vector<double> cloud_spacing(representatives.size(), 0.25);
    TriangulationInput input{representatives};
    input.spacing = 0.25;
    const auto search = cloud ? makeKdTree(*cloud) : nullptr;
    if (cloud) {
      input.cloud = search.get();
      input.cloud_spacing = &cloud_spacing;
    }
    TriangulationParameters parameters;
    parameters.fill_max_perimeter = 10;  // shorter than any loop of the representatives
    const Triangulation mesh = triangulate(input, parameters, {});
    const MeshReport report = reportMesh(representatives, mesh.triangles);
    test::expectSound(report);
    return report.border_loops;
  };
  const Points open = holedLattice(0.25, 1.4), closed = holedLattice(0.25, 0);
  EXPECT_EQ(loops(&open), 2);
  EXPECT_EQ(loops(&closed), 1);
  EXPECT_EQ(loops(nullptr), 1);
}

TEST(AdvancingFront, DoesNotDependOnThreadsOrOrder) {
  for (const Points& world : {test::randomSample(*shapes::makeShape("figure"), 5000), twoSheets()}) {
    const Points other = test::shuffled(world, 3);
    for (const TriangulationParameters& parameters : presets()) {
      const Meshed one = meshOf(world, {parameters, true, 1}), four = meshOf(other, {parameters, true, 4});
      ASSERT_EQ(one.mesh.triangles.size(), four.mesh.triangles.size());
      EXPECT_EQ(one.mesh.duplicate_of.size(), four.mesh.duplicate_of.size());
      const auto input = [](const Meshed& m, const Points& cloud, Index v) {
        const Index n = m.set.size();
        return cloud[m.set.source[v < n ? v : m.mesh.duplicate_of[v - n]]];
      };
      for (std::size_t t = 0; t < one.mesh.triangles.size(); ++t)
        for (int i = 0; i < 3; ++i)
          ASSERT_EQ(input(one, world, one.mesh.triangles[t][i]),
                    input(four, other, four.mesh.triangles[t][i]));
    }
  }
}

TEST(AdvancingFront, UsesTheSearchItIsGivenOrItsOwn) {
  const Meshed given = meshOf(test::evenSample("torus", 0.1));
  TriangulationInput input{given.set.position};
  input.spacing = medianSpacing(given.set.position, *makeKdTree(given.set.position), {});
  EXPECT_EQ(triangulate(input, {}, {}).triangles, given.mesh.triangles);
}

StatusCode refusalOf(const Points& points, const Context& context) {
  TriangulationInput input{points};
  input.spacing = 1;
  try {
    triangulate(input, {}, context);
  } catch (const Failure& failure) {
    return failure.code();
  }
  return StatusCode::Ok;
}

TEST(AdvancingFront, SaysWhenNoTriangleFits) {
  Points line;
  for (int i = 0; i < 30; ++i) line.emplace_back(i, 2 * i, 0);
  EXPECT_EQ(refusalOf(line, {}), StatusCode::NoTriangles);
}

TEST(AdvancingFront, CanBeCancelled) {
  Context context;
  context.progress.cancel();
  EXPECT_EQ(refusalOf(test::lattice(5), context), StatusCode::Cancelled);
}

TEST(AdvancingFront, MeshesTheFewestPoints) {
  EXPECT_EQ(meshOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}).report.triangles, 1);
  const Meshed tetrahedron = meshOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  test::expectSound(tetrahedron.report);
}

}  // namespace
}  // namespace mlsmesh::core
