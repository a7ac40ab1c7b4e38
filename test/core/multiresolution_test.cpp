// SPDX-License-Identifier: BSD-3-Clause
#include "mlsmesh/core/multiresolution.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "mlsmesh/core/failure.h"
#include "surfaces.h"
#include "test_shapes.h"

namespace mlsmesh::core {
namespace {

using test::Points;

Reconstruction meshOf(const Points& world, const MultiresolutionParameters& parameters, Context& context,
                      StoredAs stored_as = StoredAs::Double) {
  return reconstruct(makePointSet(world, stored_as, nullptr, context), nullptr, parameters, context);
}

Reconstruction meshOf(const Points& world, const MultiresolutionParameters& parameters = {}) {
  Context context;
  return meshOf(world, parameters, context);
}

/// All that the header promises of any result.
void expectConsistent(const Reconstruction& result) {
  const RefinedMesh& mesh = result.mesh;
  const std::size_t vertices = mesh.position.size();
  ASSERT_GT(mesh.levelCount(), 0);
  EXPECT_EQ(mesh.normal.size(), vertices);
  EXPECT_EQ(mesh.kind.size(), vertices);
  EXPECT_EQ(mesh.nearest.size(), vertices);
  EXPECT_EQ(mesh.parents.size(), vertices);
  EXPECT_EQ(mesh.level_triangles.size(), mesh.level_vertices.size());
  EXPECT_EQ(static_cast<std::size_t>(mesh.level_vertices.back()), vertices);
  EXPECT_TRUE(std::is_sorted(mesh.level_vertices.begin(), mesh.level_vertices.end()));
  ASSERT_EQ(result.reports.size(), mesh.level_triangles.size());
  for (Index level = 0; level < mesh.levelCount(); ++level) {
    const Points used(mesh.position.begin(), mesh.position.begin() + mesh.level_vertices[level]);
    const MeshReport report = reportMesh(used, mesh.level_triangles[level]);
    test::expectSound(report);
    EXPECT_EQ(report.isolated_vertices, 0);
    const MeshReport& given = result.reports[level];
    EXPECT_EQ(given.vertices, report.vertices);
    EXPECT_EQ(given.triangles, report.triangles);
    EXPECT_EQ(given.components, report.components);
    EXPECT_EQ(given.border_loops, report.border_loops);
    EXPECT_EQ(given.euler, report.euler);
    EXPECT_EQ(given.genus, report.genus);
    // Refinement changes no topology.
    EXPECT_EQ(report.components, result.reports[0].components);
    EXPECT_EQ(report.border_loops, result.reports[0].border_loops);
    EXPECT_EQ(report.euler, result.reports[0].euler);
  }
  for (std::size_t v = 0; v < vertices; ++v) {
    EXPECT_TRUE(mesh.position[v].allFinite());
    EXPECT_TRUE(mesh.nearest[v] >= 0 && mesh.nearest[v] < result.points.size());
    EXPECT_EQ(result.points.stored(mesh.position[v]), mesh.position[v]);
  }
}

/// The clusters are those of the vertices of level 0, which are their representatives unless a border was
/// moved to the rim of the cloud, and no two of them share a point but for split
/// vertices.
void expectClustersOfLevelZero(const Reconstruction& result) {
  const Index count = result.mesh.level_vertices[0];
  ASSERT_EQ(result.clusters.count(), count);
  ASSERT_EQ(static_cast<Index>(result.representative_of.size()), count);
  std::vector<Index> owner(static_cast<std::size_t>(result.points.size()), kNone);
  for (Index v = 0; v < count; ++v) {
    const Index representative = result.representative_of[v];
    if (result.mesh.kind[v] != VertexKind::Border) {
      EXPECT_EQ(result.mesh.position[v], result.representatives.position[representative]);
    }
    EXPECT_GT(result.clusters.size(v), 0);
    for (Index i = 0; i < result.clusters.size(v); ++i) {
      Index& point = owner[result.clusters.data(v)[i]];
      EXPECT_TRUE(point == kNone || point == representative);
      point = representative;
    }
  }
}

class WholeShape : public testing::TestWithParam<const char*> {
 protected:
  const std::unique_ptr<shapes::Shape> shape_ = shapes::makeShape(GetParam());
};

TEST_P(WholeShape, ComesOutWithItsTopology) {
  const Points world = test::evenSample(*shape_, 0.045);
  for (const MultiresolutionParameters& parameters : {defaultPreset(), paperPreset()}) {
    const Reconstruction result = meshOf(world, parameters);
    expectConsistent(result);
    expectClustersOfLevelZero(result);
    test::expectTopologyOf(*shape_, result.reports.front());
    EXPECT_EQ(result.mesh.levelCount(), parameters.refinement.levels + 1);
  }
}

TEST_P(WholeShape, ComesOutSoundAsPrinted) {
  expectConsistent(meshOf(test::evenSample(*shape_, 0.045), printedPreset()));
}

TEST_P(WholeShape, ComesOutOfItsOwnPoints) {
  MultiresolutionParameters parameters;
  parameters.reduce = false;
  parameters.refinement.levels = 0;
  const Points world = test::evenSample(*shape_, 0.06);
  const Reconstruction result = meshOf(world, parameters);
  expectConsistent(result);
  expectClustersOfLevelZero(result);
  test::expectTopologyOf(*shape_, result.reports[0]);
  EXPECT_EQ(result.mesh.level_vertices[0], static_cast<Index>(world.size()));
  for (Index v = 0; v < result.mesh.level_vertices[0]; ++v) {
    EXPECT_EQ(result.mesh.kind[v], VertexKind::InputPoint);
    EXPECT_EQ(result.mesh.position[v], result.points.position[result.mesh.nearest[v]]);
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, WholeShape, testing::Values("sphere", "torus", "saddle", "cylinder"),
                         [](const auto& tested) { return std::string(tested.param); });

TEST(Multiresolution, IsSoundOnScansThatAreNotClean) {
  const auto figure = shapes::makeShape("figure");
  Points outliers = test::randomSample(*figure, 6000);
  for (const Vec3& p : test::randomCloud(60, 3)) outliers.push_back(2 * p);
  for (const Points& world :
       {outliers, test::noisy(test::randomSample(*figure, 6000), 0.01), test::randomCloud(1500, 4),
        test::evenSample("moebius", 0.06), test::planeLattice(50, 30), test::lattice(12)}) {
    for (const MultiresolutionParameters& parameters : {defaultPreset(), paperPreset(), printedPreset()})
      expectConsistent(meshOf(world, parameters));
  }
}

TEST(Multiresolution, MayUseAPointTwice) {
  MultiresolutionParameters parameters;
  parameters.reduce = false;  // a front among points in a box meets itself all the time
  const Reconstruction result = meshOf(test::randomCloud(1500, 1), parameters);
  expectConsistent(result);
  expectClustersOfLevelZero(result);
  EXPECT_GT(result.front.split_vertices, 0);
}

TEST(Multiresolution, IsSoundFarFromTheOrigin) {
  test::Similarity motion;
  motion.shift = Vec3(431000.25, 5240000.5, 300);  // as in a map; floats are 0.03 to 0.5 apart there
  motion.scale = 300;
  Context context;
  expectConsistent(meshOf(motion(test::evenSample("torus", 0.05)), {}, context, StoredAs::Float));
}

TEST(Multiresolution, CopesWithFewPoints) {
  for (const int count : {3, 4, 5, 6, 10, 20, 49, 60, 100}) {
    // Spread evenly over a sphere: a spiral.
    Points world;
    for (int i = 0; i < count; ++i) {
      const double z = 1 - (2.0 * i + 1) / count, radius = std::sqrt(1 - z * z);
      world.emplace_back(radius * std::cos(2.39996 * i), radius * std::sin(2.39996 * i), z);
    }
    for (const MultiresolutionParameters& parameters : {defaultPreset(), paperPreset()}) {
      Context context;
      try {
        const Reconstruction result = meshOf(world, parameters, context);
        expectConsistent(result);
        EXPECT_EQ(context.warnings.size(), 1u) << count;
        if (count == 100) {
          test::expectTopologyOf(*shapes::makeShape("sphere"), result.reports[0]);
        }
      } catch (const Failure& failure) {
        EXPECT_EQ(failure.code(), StatusCode::NoTriangles) << count << ": " << failure.what();
        EXPECT_LT(count, 49) << failure.what();
      }
    }
  }
}

TEST(Multiresolution, WarnsOfNothingWhenThereIsEnough) {
  Context context;
  meshOf(test::evenSample("sphere", 0.05), {}, context);
  EXPECT_TRUE(context.warnings.empty());
}

TEST(Multiresolution, TellsItsStagesInOrder) {
  std::vector<std::string> told;
  std::vector<double> fractions;
  Context context;
  context.threads = 1;
  context.progress = Progress([&](const std::string& stage, double fraction) {
    if (told.empty() || told.back() != stage) told.push_back(stage);
    fractions.push_back(fraction);
  });
  const Reconstruction result = meshOf(test::evenSample("sphere", 0.05), {}, context);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_EQ(context.progress.fraction(), 1);
  std::vector<std::string> listed;
  for (const StageTime& stage : result.stages) {
    EXPECT_GE(stage.seconds, 0);
    listed.push_back(stage.name);
  }
  auto next = listed.begin();
  for (const char* step :
       {"search", "reduction", "triangulation", "refinement 1", "refinement 2", "report"}) {
    next = std::find(next, listed.end(), step);
    ASSERT_NE(next, listed.end()) << step;
  }
  told.erase(std::remove(told.begin(), told.end(), ""), told.end());  // making the point set names no stage
  EXPECT_EQ(told, listed);
}

StatusCode refusalOf(const Points& world, const MultiresolutionParameters& parameters, Context& context) {
  try {
    meshOf(world, parameters, context);
  } catch (const Failure& failure) {
    return failure.code();
  }
  return StatusCode::Ok;
}

TEST(Multiresolution, CanBeCancelledFromAnotherThread) {
  const Points world = test::randomSample(*shapes::makeShape("torus"), 60000);
  for (const char* stage : {"reduction", "triangulation", "refinement 1", "refinement 2"}) {
    Context context;
    context.threads = 1;
    std::thread other;
    context.progress = Progress([&](const std::string& reached, double) {
      if (reached != stage || other.joinable()) return;
      other = std::thread([handle = context.progress]() mutable { handle.cancel(); });
      other.join();
      other = std::thread([] {});
    });
    EXPECT_EQ(refusalOf(world, {}, context), StatusCode::Cancelled) << stage;
    ASSERT_TRUE(other.joinable()) << stage;
    other.join();
  }
}

TEST(Multiresolution, RefusesParametersOutOfRange) {
  Context context;
  MultiresolutionParameters parameters;
  parameters.projection.neighbors = 3;
  EXPECT_EQ(refusalOf(test::lattice(5), parameters, context), StatusCode::InvalidParameter);
}

TEST(Multiresolution, DoesNotDependOnThreadsOrOrder) {
  const Points world = test::noisy(test::randomSample(*shapes::makeShape("figure"), 8000), 0.003);
  for (const MultiresolutionParameters& parameters : {defaultPreset(), paperPreset(), printedPreset()}) {
    Context one = test::withThreads(1), four = test::withThreads(4);
    const Reconstruction a = meshOf(world, parameters, one, StoredAs::Float);
    const Reconstruction b = meshOf(test::shuffled(world, 5), parameters, four, StoredAs::Float);
    EXPECT_EQ(a.mesh.position, b.mesh.position);
    EXPECT_EQ(a.mesh.normal, b.mesh.normal);
    EXPECT_EQ(a.mesh.kind, b.mesh.kind);
    EXPECT_EQ(a.mesh.nearest, b.mesh.nearest);
    EXPECT_EQ(a.mesh.level_vertices, b.mesh.level_vertices);
    EXPECT_EQ(a.mesh.level_triangles, b.mesh.level_triangles);
    EXPECT_EQ(a.clusters.items, b.clusters.items);
  }
}

TEST(Multiresolution, AsksForASearchOverTheOrderedPoints) {
  const Points world = test::evenSample("torus", 0.08);
  Context context;
  const PointSet set = makePointSet(world, StoredAs::Double, nullptr, context);
  int asked = 0;
  const SearchFactory factory = [&](const PointSet& points) {
    ++asked;
    EXPECT_EQ(points.position, set.position);
    return makeKdTree(points.position);
  };
  const Reconstruction result = reconstruct(set, factory, {}, context);
  EXPECT_EQ(asked, 1);
  EXPECT_EQ(result.mesh.level_triangles, meshOf(world).mesh.level_triangles);
}

}  // namespace
}  // namespace mlsmesh::core
