// SPDX-License-Identifier: BSD-3-Clause
// That loops and builders on one thread look at the handle.
#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "edge_flips.h"
#include "handle_loops.h"
#include "mlsmesh/core/failure.h"
#include "mlsmesh/core/half_edge_mesh.h"
#include "mlsmesh/core/neighbor_search.h"
#include "mlsmesh/core/self_intersections.h"
#include "outward.h"
#include "pinches.h"
#include "radix_sort.h"
#include "seams.h"
#include "surfaces.h"
#include "test_shapes.h"

namespace mlsmesh::core {
namespace {

StatusCode codeOf(const std::function<void()>& work) {
  return guarded(work).code;
}

Context cancelledContext() {
  Context context;
  context.progress.cancel();
  return context;
}

TEST(CancelCheck, LooksOnceInManyRounds) {
  const Context context = cancelledContext();
  CancelCheck check(context);
  int rounds = 0;
  EXPECT_EQ(codeOf([&] {
              for (; rounds < 1000000; ++rounds) check();
            }),
            StatusCode::Cancelled);
  EXPECT_GT(rounds, 0);
  EXPECT_LT(rounds, 10000);
  const Context goes_on;
  CancelCheck passes(goes_on);
  EXPECT_EQ(codeOf([&] {
              for (int i = 0; i < 100000; ++i) passes();
            }),
            StatusCode::Ok);
}

TEST(Cancel, EndsTheBuildingOfASearch) {
  const test::Points points = test::randomSample(*shapes::makeShape("sphere"), 150000);
  const Context context = cancelledContext();
  EXPECT_EQ(codeOf([&] { makeKdTree(points, context); }), StatusCode::Cancelled);
  EXPECT_EQ(codeOf([&] { makeKdTreeOver(points, context); }), StatusCode::Cancelled);
}

TEST(Cancel, EndsASort) {
  std::vector<unsigned> items(10, 1);
  EXPECT_EQ(codeOf([&] {
              radixSort(
                  items, 32, [](unsigned item) { return item; }, cancelledContext());
            }),
            StatusCode::Cancelled);
}

/// A grid with a border, of some ten thousand triangles: more than a loop goes without looking.
class CancelOnMesh : public testing::Test {
 protected:
  CancelOnMesh() : soup_(test::grid(90, 90)), normals_(soup_.vertices.size(), Vec3::UnitZ()) {
    EXPECT_TRUE(buildMesh(soup_.vertexCount(), soup_.triangles, mesh_));
  }

  test::Soup soup_;
  std::vector<Vec3> normals_;
  HalfEdgeMesh mesh_;
  Context context_ = cancelledContext();
};

TEST_F(CancelOnMesh, EndsItsBuilding) {
  HalfEdgeMesh other;
  EXPECT_EQ(codeOf([&] { buildMesh(soup_.vertexCount(), soup_.triangles, other, nullptr, context_); }),
            StatusCode::Cancelled);
  EXPECT_EQ(other.vertexCount(), 0);
}

TEST_F(CancelOnMesh, EndsItsQuestions) {
  EXPECT_EQ(codeOf([&] { mesh_.components(nullptr, context_); }), StatusCode::Cancelled);
  EXPECT_EQ(codeOf([&] { mesh_.borderLoopEdges(context_); }), StatusCode::Cancelled);
  EXPECT_EQ(codeOf([&] { mesh_.validate(false, context_); }), StatusCode::Cancelled);
  EXPECT_EQ(codeOf([&] { countSeams(mesh_, soup_.vertices, normals_, context_); }), StatusCode::Cancelled);
  EXPECT_EQ(codeOf([&] { shortHandleLoops(mesh_, soup_.vertices, 10, context_); }), StatusCode::Cancelled);
  EXPECT_EQ(codeOf([&] { SelfIntersections(soup_.vertices, soup_.triangles, context_); }),
            StatusCode::Cancelled);
}

TEST_F(CancelOnMesh, EndsItsChanges) {
  EXPECT_EQ(codeOf([&] { orientOutward(soup_.vertices, mesh_, context_); }), StatusCode::Cancelled);
  EXPECT_EQ(codeOf([&] { resolvePinches(mesh_, 3, nullptr, context_); }), StatusCode::Cancelled);
  EXPECT_EQ(codeOf([&] { flipEdges(mesh_, soup_.vertices, FlipRule::Length, true, context_); }),
            StatusCode::Cancelled);
}

}  // namespace
}  // namespace mlsmesh::core
