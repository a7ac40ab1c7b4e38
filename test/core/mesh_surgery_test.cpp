// SPDX-License-Identifier: BSD-3-Clause
#include "mesh_surgery.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "mlsmesh/mesh_report.h"
#include "test_shapes.h"

namespace mlsmesh::core {
namespace {

struct Snapshot {
  std::vector<Triangle> triangles;  // by slot
  std::set<TrianglePair> pairs;
  Index euler, border, used;

  explicit Snapshot(const MeshSurgery& surgery)
      : pairs(surgery.pairs()),
        euler(surgery.euler()),
        border(surgery.borderEdges()),
        used(surgery.usedVertices()) {
    for (Index t = 0; t < surgery.mesh().slotCount(); ++t) {
      if (surgery.mesh().alive(t)) triangles.push_back(surgery.mesh().corners(t));
    }
  }
  bool operator==(const Snapshot& other) const {
    return triangles == other.triangles && pairs == other.pairs && euler == other.euler &&
           border == other.border && used == other.used;
  }
};

// A torus whose vertices are shaken so much that it meets itself in many places.
test::Soup shakenTorus(unsigned seed) {
  test::Soup soup = test::torus(16, 8);
  std::mt19937 random(seed);
  std::normal_distribution<double> shake(0, 0.5);
  for (Vec3& p : soup.vertices) p += Vec3(shake(random), shake(random), shake(random));
  return soup;
}

std::vector<Index> someAlive(const HalfEdgeMesh& mesh, std::size_t count, std::mt19937& random) {
  std::vector<Index> alive;
  for (Index t = 0; t < mesh.slotCount(); ++t) {
    if (mesh.alive(t)) alive.push_back(t);
  }
  std::shuffle(alive.begin(), alive.end(), random);
  alive.resize(std::min(count, alive.size()));
  return alive;
}

// Counts anew what the surgery keeps.
void expectCounted(const MeshSurgery& surgery) {
  const std::vector<Triangle> triangles = surgery.mesh().triangles();
  const MeshReport report = reportMesh(surgery.points(), triangles, Context());
  EXPECT_EQ(surgery.euler(), report.euler);
  EXPECT_EQ(surgery.borderEdges(), report.border_edges);
  EXPECT_EQ(static_cast<std::int64_t>(surgery.pairs().size()), report.self_intersections);
  EXPECT_EQ(surgery.mesh().validate(true), "");
  for (Index t = 0; t < surgery.mesh().slotCount(); ++t) {
    std::vector<Index> partners;
    for (const auto& [a, b] : surgery.pairs()) {
      if (a == t || b == t) partners.push_back(a == t ? b : a);
    }
    std::sort(partners.begin(), partners.end());
    EXPECT_EQ(surgery.partnersOf(t), partners);
  }
}

TEST(MeshSurgery, CountsWhatIsThereAfterEveryChange) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    const test::Soup soup = shakenTorus(seed);
    HalfEdgeMesh mesh;
    ASSERT_TRUE(buildMesh(soup.vertexCount(), soup.triangles, mesh));
    const Context context;
    MeshSurgery surgery(mesh, soup.vertices, context);
    EXPECT_GT(surgery.pairs().size(), 0u);
    std::mt19937 random(seed);
    for (int step = 0; step < 12; ++step) {
      const std::vector<Index> region = someAlive(mesh, 9, random);
      std::vector<Triangle> corners;
      for (const Index t : region) corners.push_back(mesh.corners(t));
      surgery.remove(region);
      expectCounted(surgery);
      corners.resize(4);
      EXPECT_TRUE(surgery.add(corners));
      expectCounted(surgery);
    }
  }
}

TEST(MeshSurgery, UndoesToTheBit) {
  const test::Soup soup = shakenTorus(7);
  HalfEdgeMesh mesh;
  ASSERT_TRUE(buildMesh(soup.vertexCount(), soup.triangles, mesh));
  const Context context;
  MeshSurgery surgery(mesh, soup.vertices, context);
  std::mt19937 random(5);
  surgery.remove(someAlive(mesh, 20, random));
  const Snapshot before(surgery);
  for (int round = 0; round < 20; ++round) {
    const std::size_t mark = surgery.mark();
    for (int step = 0; step < 3; ++step) {
      const std::vector<Index> region = someAlive(mesh, 12, random);
      const Triangle first = mesh.corners(region[0]);
      surgery.remove(region);
      EXPECT_TRUE(surgery.add({first}));
    }
    surgery.undo(mark);
    EXPECT_TRUE(Snapshot(surgery) == before) << round;
  }
  expectCounted(surgery);
}

TEST(MeshSurgery, AddsAllOrNothing) {
  const test::Soup ball = test::octahedron();
  HalfEdgeMesh mesh;
  ASSERT_TRUE(buildMesh(ball.vertexCount(), ball.triangles, mesh));
  const Context context;
  MeshSurgery surgery(mesh, ball.vertices, context);
  surgery.remove({0, 1});
  const Snapshot before(surgery);
  EXPECT_FALSE(surgery.add({ball.triangles[0], ball.triangles[2]}));  // the second is there
  EXPECT_TRUE(Snapshot(surgery) == before);
}

TEST(MeshSurgery, TellsWhatItAddedAndOpened) {
  const test::Soup ball = test::octahedron();
  HalfEdgeMesh mesh;
  ASSERT_TRUE(buildMesh(ball.vertexCount(), ball.triangles, mesh));
  const Context context;
  MeshSurgery surgery(mesh, ball.vertices, context);
  const std::size_t mark = surgery.mark();
  surgery.remove({0, 1});  // two neighbours: a quad opens
  EXPECT_EQ(surgery.openedSince(mark).size(), 4u);
  EXPECT_TRUE(surgery.add({ball.triangles[0]}));
  EXPECT_EQ(surgery.openedSince(mark).size(), 3u);  // the other's two, and the one between them
  EXPECT_EQ(surgery.addedSince(mark).size(), 1u);
}

}  // namespace
}  // namespace mlsmesh::core
