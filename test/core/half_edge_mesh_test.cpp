// SPDX-License-Identifier: BSD-3-Clause
#include "mlsmesh/core/half_edge_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "mlsmesh/mesh_report.h"
#include "test_shapes.h"

namespace mlsmesh::core {
namespace {

using Edge = std::pair<Index, Index>;

/// The same mesh as a plain list of triangles by slot; every answer is found by looking at all of them.
class Oracle {
 public:
  std::vector<Triangle> slots;  ///< removed ones hold kNone

  static bool alive(const Triangle& t) { return t[0] != kNone; }

  /// Slot of the triangle that runs u -> v, or kNone.
  Index owner(Index u, Index v) const {
    for (std::size_t i = 0; i < slots.size(); ++i)
      for (int c = 0; c < 3; ++c)
        if (alive(slots[i]) && slots[i][c] == u && slots[i][(c + 1) % 3] == v) return static_cast<Index>(i);
    return kNone;
  }

  bool canAdd(Index a, Index b, Index c) const {
    if (a == b || b == c || c == a) return false;
    return owner(a, b) == kNone && owner(b, c) == kNone && owner(c, a) == kNone;
  }

  /// Slots at a vertex, grouped into fans by shared edges at the vertex.
  std::vector<std::set<Index>> fans(Index vertex) const {
    std::vector<std::set<Index>> result;
    for (std::size_t i = 0; i < slots.size(); ++i) {
      if (std::find(slots[i].begin(), slots[i].end(), vertex) == slots[i].end()) continue;
      std::set<Index> fan = {static_cast<Index>(i)};
      for (auto other = result.begin(); other != result.end();) {
        if (!touches(*other, static_cast<Index>(i), vertex)) {
          ++other;
          continue;
        }
        fan.insert(other->begin(), other->end());
        other = result.erase(other);
      }
      result.push_back(fan);
    }
    return result;
  }

  /// Number of fan members whose edge out of the vertex has no other side.
  int borders(const std::set<Index>& fan, Index vertex) const {
    int count = 0;
    for (const Index slot : fan) count += owner(after(slot, vertex), vertex) == kNone;
    return count;
  }

  std::multiset<std::set<Index>> cornerSets() const {
    std::multiset<std::set<Index>> result;
    for (const Triangle& t : slots)
      if (alive(t)) result.insert({t[0], t[1], t[2]});
    return result;
  }

 private:
  Index after(Index slot, Index vertex) const {
    const Triangle& t = slots[slot];
    return t[(std::find(t.begin(), t.end(), vertex) - t.begin() + 1) % 3];
  }

  bool touches(const std::set<Index>& fan, Index slot, Index vertex) const {
    return std::any_of(fan.begin(), fan.end(), [&](Index member) {
      const Index end = after(slot, vertex);
      const Index start = after(member, vertex);
      return owner(end, vertex) == member || owner(start, vertex) == slot;
    });
  }
};

MeshReport reportOf(const HalfEdgeMesh& mesh) {
  return reportMesh(test::randomCloud(mesh.vertexCount(), 1), mesh.triangles());
}

/// Every border half-edge in exactly one loop; each loop a closed walk that stays within one fan at each
/// vertex.
void expectSoundLoops(const HalfEdgeMesh& mesh) {
  const std::vector<std::vector<Index>> loops = mesh.borderLoopEdges();
  std::set<Index> seen;
  for (const std::vector<Index>& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Index h = loop[i], following = loop[(i + 1) % loop.size()];
      EXPECT_TRUE(mesh.isBorder(h));
      EXPECT_TRUE(seen.insert(h).second);
      ASSERT_EQ(mesh.target(h), mesh.origin(following));
      Index turned = HalfEdgeMesh::next(h);
      while (!mesh.isBorder(turned)) turned = mesh.turn(turned);
      EXPECT_EQ(turned, following);
    }
  }
  const MeshReport report = reportOf(mesh);
  EXPECT_EQ(static_cast<Index>(seen.size()), report.border_edges);
  EXPECT_EQ(static_cast<Index>(loops.size()), report.border_loops);
}

void expectSameVertices(const HalfEdgeMesh& mesh, const Oracle& oracle) {
  for (Index v = 0; v < mesh.vertexCount(); ++v) {
    const std::vector<std::set<Index>> fans = oracle.fans(v);
    std::size_t degree = 0;
    int borders = 0;
    for (const std::set<Index>& fan : fans) {
      degree += fan.size();
      borders += oracle.borders(fan, v);
    }
    ASSERT_EQ(mesh.fanCount(v), static_cast<Index>(fans.size()));
    ASSERT_EQ(mesh.degree(v), static_cast<Index>(degree));
    ASSERT_EQ(mesh.isUsed(v), degree > 0);
    ASSERT_EQ(mesh.isBorderVertex(v), borders > 0);
    ASSERT_EQ(mesh.isInterior(v), fans.size() == 1 && borders == 0);
  }
}

void expectSame(const HalfEdgeMesh& mesh, const Oracle& oracle) {
  ASSERT_EQ(mesh.validate(true), "");
  ASSERT_EQ(mesh.slotCount(), static_cast<Index>(oracle.slots.size()));
  for (Index t = 0; t < mesh.slotCount(); ++t) {
    ASSERT_EQ(mesh.alive(t), Oracle::alive(oracle.slots[t]));
    Triangle have = mesh.corners(t), want = oracle.slots[t];
    std::rotate(have.begin(), std::min_element(have.begin(), have.end()), have.end());
    std::rotate(want.begin(), std::min_element(want.begin(), want.end()), want.end());
    ASSERT_EQ(have, want);
  }
  expectSameVertices(mesh, oracle);
  expectSoundLoops(mesh);
  Index components = 0;
  mesh.components(&components);
  EXPECT_EQ(components, reportOf(mesh).components);
}

/// Random changes to a small mesh, each done to the oracle, too.
class RandomWalk {
 public:
  /// Starts from a torus, so that closed fans occur, and a few vertices to spare.
  explicit RandomWalk(unsigned seed) : mesh_(12), random_(seed) {
    for (const auto& [a, b, c] : test::torus(3, 3).triangles) {
      mesh_.addTriangle(a, b, c);
      oracle_.slots.push_back({a, b, c});
    }
  }

  void step() {
    const int choice = below(100);
    if (choice < 50) {
      for (int tries = 0; tries < 6; ++tries) add();
    } else if (choice < 70) {
      remove();
    } else if (choice < 92) {
      flip();
    } else if (choice < 94) {
      split();
    } else {
      reverse();
    }
  }
  const HalfEdgeMesh& mesh() const { return mesh_; }
  const Oracle& oracle() const { return oracle_; }

 private:
  Index below(Index end) { return std::uniform_int_distribution<Index>(0, end - 1)(random_); }

  Index liveTriangle() {
    if (mesh_.triangleCount() == 0) return kNone;
    for (;;) {
      const Index t = below(mesh_.slotCount());
      if (mesh_.alive(t)) return t;
    }
  }

  void add() {
    const Index n = mesh_.vertexCount();
    const Index a = below(n), b = below(n), c = below(n);
    const bool legal = oracle_.canAdd(a, b, c);
    ASSERT_EQ(mesh_.canAdd(a, b, c), legal);
    ASSERT_EQ(mesh_.addTriangle(a, b, c), legal ? static_cast<Index>(oracle_.slots.size()) : kNone);
    if (legal) oracle_.slots.push_back({a, b, c});
  }

  void remove() {
    const Index t = liveTriangle();
    if (t == kNone) return;
    mesh_.removeTriangle(t);
    oracle_.slots[t] = {kNone, kNone, kNone};
  }

  void flip() {
    const Index t = liveTriangle();
    if (t == kNone) return;
    const Index h = 3 * t + below(3), g = mesh_.twin(h);
    const Index u = mesh_.origin(h), v = mesh_.target(h), w = mesh_.opposite(h);
    const Index x = g == kNone ? kNone : mesh_.opposite(g);
    const bool legal = g != kNone && w != x && oracle_.owner(w, x) == kNone && oracle_.owner(x, w) == kNone;
    ASSERT_EQ(mesh_.flip(h), legal);
    if (!legal) return;
    EXPECT_EQ(Edge(mesh_.origin(h), mesh_.target(h)), Edge(x, w)) << "h is the new diagonal";
    EXPECT_EQ(mesh_.twin(h), g);
    oracle_.slots[t] = {u, x, w};
    oracle_.slots[g / 3] = {v, w, x};
  }

  void split() {
    const Index v = below(mesh_.vertexCount());
    std::vector<std::set<Index>> fans = oracle_.fans(v);
    std::sort(fans.begin(), fans.end(), [](const auto& a, const auto& b) { return *a.begin() < *b.begin(); });
    const auto kept = std::max_element(fans.begin(), fans.end(),
                                       [](const auto& a, const auto& b) { return a.size() < b.size(); });
    Index created = mesh_.vertexCount();
    std::vector<Index> expected;
    for (auto fan = fans.begin(); fan != fans.end(); ++fan) {
      if (fan == kept) continue;
      for (const Index slot : *fan)
        std::replace(oracle_.slots[slot].begin(), oracle_.slots[slot].end(), v, created);
      expected.push_back(created++);
    }
    ASSERT_EQ(mesh_.splitFans(v), expected);
    EXPECT_LE(mesh_.fanCount(v), 1);
  }

  void reverse() {
    const Index t = liveTriangle();
    if (t == kNone) return;
    const std::vector<Index> component = mesh_.components();
    std::vector<Index> chosen;
    for (Index other = 0; other < mesh_.slotCount(); ++other)
      if (component[other] == component[t]) chosen.push_back(other);
    mesh_.reverse(chosen);
    for (const Index other : chosen) std::swap(oracle_.slots[other][1], oracle_.slots[other][2]);
  }

  HalfEdgeMesh mesh_;
  Oracle oracle_;
  std::mt19937 random_;
};

TEST(HalfEdgeMesh, AgreesWithAPlainListUnderRandomChanges) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    RandomWalk walk(seed);
    for (int i = 0; i < 100; ++i) {
      walk.step();
      expectSame(walk.mesh(), walk.oracle());
      if (testing::Test::HasFailure()) FAIL() << "seed " << seed << ", step " << i;
    }
  }
}

HalfEdgeMesh built(const test::Soup& soup) {
  HalfEdgeMesh mesh;
  std::string why;
  EXPECT_TRUE(buildMesh(soup.vertexCount(), soup.triangles, mesh, &why)) << why;
  EXPECT_EQ(mesh.triangles(), soup.triangles);
  return mesh;
}

TEST(HalfEdgeMesh, OfAClosedSurfaceHasNoBorder) {
  for (const test::Soup& soup : {test::octahedron(), test::torus(9, 4)}) {
    const HalfEdgeMesh mesh = built(soup);
    EXPECT_EQ(mesh.validate(), "");
    EXPECT_TRUE(mesh.borderLoops().empty());
    for (Index v = 0; v < mesh.vertexCount(); ++v) EXPECT_TRUE(mesh.isInterior(v));
  }
}

TEST(HalfEdgeMesh, OfAGridHasItsRimAsBorder) {
  const HalfEdgeMesh mesh = built(test::grid(5, 3));
  EXPECT_EQ(mesh.validate(), "");
  const auto loops = mesh.borderLoops();
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_EQ(loops[0].size(), 16u);
  EXPECT_EQ(std::set<Index>(loops[0].begin(), loops[0].end()).size(), 16u);
  for (Index v = 0; v < mesh.vertexCount(); ++v) {
    const Index column = v / 4, row = v % 4;
    const bool on_rim = column == 0 || column == 5 || row == 0 || row == 3;
    EXPECT_EQ(mesh.isBorderVertex(v), on_rim);
    EXPECT_EQ(mesh.isInterior(v), !on_rim);
  }
}

TEST(HalfEdgeMesh, KeepsTheBordersOfABowTieApart) {
  HalfEdgeMesh mesh(5);
  mesh.addTriangle(0, 1, 2);
  mesh.addTriangle(0, 3, 4);
  EXPECT_EQ(mesh.validate(true), "");
  EXPECT_EQ(mesh.validate(), "vertex 0 has several fans");
  EXPECT_EQ(mesh.fanCount(0), 2);
  EXPECT_EQ(mesh.borderLoops().size(), 2u);
  EXPECT_EQ(mesh.splitFans(0), std::vector<Index>{5});
  EXPECT_EQ(mesh.validate(), "");
  EXPECT_EQ(mesh.corners(0), (Triangle{0, 1, 2}))
      << "of equal fans the one with the first triangle keeps the vertex";
  EXPECT_EQ(mesh.corners(1), (Triangle{5, 3, 4}));
}

TEST(HalfEdgeMesh, SplitLeavesTheVertexToTheLargestFan) {
  HalfEdgeMesh mesh(7);
  mesh.addTriangle(0, 1, 2);
  mesh.addTriangle(0, 3, 4);
  mesh.addTriangle(0, 4, 5);
  EXPECT_EQ(mesh.splitFans(0), std::vector<Index>{7});
  EXPECT_EQ(mesh.corners(0), (Triangle{7, 1, 2}));
  EXPECT_EQ(mesh.degree(0), 2);
  EXPECT_TRUE(mesh.splitFans(0).empty());
  EXPECT_TRUE(mesh.splitFans(6).empty()) << "no triangle uses it";
}

TEST(HalfEdgeMesh, FlipsBackAfterFourFlips) {
  HalfEdgeMesh mesh = built(test::grid(4, 4));
  const std::vector<Triangle> before = mesh.triangles();
  const Index h = mesh.find(6, 12);
  ASSERT_NE(h, kNone);
  ASSERT_FALSE(mesh.isBorder(h));
  for (int turn = 0; turn < 4; ++turn) {
    ASSERT_TRUE(mesh.flip(h));
    ASSERT_EQ(mesh.validate(), "");
  }
  EXPECT_EQ(mesh.triangles(), before) << "two flips run the edge backwards, four restore every corner";
}

TEST(HalfEdgeMesh, DoesNotFlipIntoAnEdgeThatExists) {
  HalfEdgeMesh mesh = built(test::tetrahedron());
  for (Index h = 0; h < 12; ++h) EXPECT_FALSE(mesh.flip(h)) << "every pair of its corners is an edge already";
  EXPECT_EQ(mesh.triangles(), test::tetrahedron().triangles);
}

TEST(HalfEdgeMesh, AddsVerticesOneByOne) {
  HalfEdgeMesh mesh;
  for (Index v = 0; v < 3; ++v) EXPECT_EQ(mesh.addVertex(), v);
  mesh.reserveTriangles(1);
  EXPECT_EQ(mesh.addTriangle(0, 1, 2), 0);
  EXPECT_EQ(mesh.addTriangle(0, 1, 2), kNone);
  EXPECT_EQ(mesh.addTriangle(2, 1, 0), 1) << "the other side of the same corners is legal";
  EXPECT_TRUE(mesh.borderLoops().empty());
}

TEST(HalfEdgeMesh, NumbersComponentsInSlotOrder) {
  HalfEdgeMesh mesh = built(together(test::grid(1, 1), together(test::tetrahedron(), test::grid(1, 1))));
  mesh.removeTriangle(3);
  Index count = 0;
  EXPECT_EQ(mesh.components(&count), (std::vector<Index>{0, 0, 1, kNone, 1, 1, 2, 2}));
  EXPECT_EQ(count, 3);
}

std::string whyNot(Index vertices, const std::vector<Triangle>& triangles) {
  HalfEdgeMesh mesh = built(test::octahedron());
  std::string why;
  EXPECT_FALSE(buildMesh(vertices, triangles, mesh, &why));
  EXPECT_EQ(mesh.triangleCount(), 8) << "a mesh that could not be built leaves the old one";
  return why;
}

// Everything that the order of links shows in.
void expectSameLinks(const HalfEdgeMesh& a, const HalfEdgeMesh& b) {
  ASSERT_EQ(a.triangles(), b.triangles());
  ASSERT_EQ(a.vertexCount(), b.vertexCount());
  for (Index v = 0; v < a.vertexCount(); ++v) ASSERT_EQ(a.firstOutgoing(v), b.firstOutgoing(v)) << v;
  for (Index h = 0; h < 3 * a.slotCount(); ++h) {
    ASSERT_EQ(a.twin(h), b.twin(h)) << h;
    ASSERT_EQ(a.nextOutgoing(h), b.nextOutgoing(h)) << h;
  }
}

TEST(AssignTriangles, LinksAsAddingOneByOneDoes) {
  for (const test::Soup& soup :
       {test::torus(90, 70), test::grid(60, 50), together(test::tetrahedron(), test::grid(3, 2))}) {
    HalfEdgeMesh added(soup.vertexCount());
    for (const auto& [a, b, c] : soup.triangles) ASSERT_NE(added.addTriangle(a, b, c), kNone);
    for (const int threads : {1, 2, 7}) {
      Context context;
      context.threads = threads;
      HalfEdgeMesh assigned(soup.vertexCount());
      assigned.addTriangle(0, 2, 1);  // goes
      ASSERT_TRUE(assigned.assignTriangles(soup.triangles, context));
      expectSameLinks(assigned, added);
      EXPECT_EQ(assigned.validate(), "");
    }
  }
}

TEST(AssignTriangles, RefusesAnEdgeThatIsRunTwice) {
  test::Soup soup = test::torus(30, 20);
  for (const std::size_t place : {std::size_t{0}, soup.triangles.size() / 2, soup.triangles.size()}) {
    std::vector<Triangle> triangles = soup.triangles;
    triangles.insert(triangles.begin() + static_cast<std::ptrdiff_t>(place), soup.triangles[7]);
    HalfEdgeMesh mesh(soup.vertexCount());
    EXPECT_FALSE(mesh.assignTriangles(triangles, {}));
    EXPECT_EQ(mesh.triangleCount(), 0);
    EXPECT_EQ(mesh.vertexCount(), soup.vertexCount());
    EXPECT_EQ(mesh.validate(), "");
    EXPECT_TRUE(mesh.assignTriangles(soup.triangles, {})) << "and takes others afterwards";
  }
}

TEST(BuildMesh, NamesTheFirstOffender) {
  EXPECT_EQ(whyNot(3, {{0, 1, 3}}), "triangle 0 names vertex 3, which does not exist");
  EXPECT_EQ(whyNot(3, {{0, 1, -1}}), "triangle 0 names vertex -1, which does not exist");
  EXPECT_EQ(whyNot(4, {{0, 1, 2}, {3, 1, 3}}), "triangle 1 names a vertex twice");
  EXPECT_EQ(whyNot(4, {{0, 1, 2}, {0, 1, 3}}), "triangle 1 runs edge 0 -> 1, which another triangle runs");
  EXPECT_EQ(whyNot(4, {{0, 1, 2}, {1, 0, 3}, {2, 1, 0}}),
            "triangle 2 runs edge 1 -> 0, which another triangle runs");
}

TEST(BuildMesh, TakesNothingForAMesh) {
  HalfEdgeMesh mesh;
  EXPECT_TRUE(buildMesh(0, {}, mesh));
  EXPECT_EQ(mesh.validate(), "");
  EXPECT_TRUE(mesh.triangles().empty());
}

}  // namespace
}  // namespace mlsmesh::core
