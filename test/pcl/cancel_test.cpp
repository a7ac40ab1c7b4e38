// SPDX-License-Identifier: BSD-3-Clause
// Cancelling, progress, and runs that must not disturb one another, through the classes for PCL.
#include "clouds.h"
#include "mlsmesh/advancing_front_triangulation.h"
#include "mlsmesh/bsp_clustering.h"
#include "mlsmesh/mls_multiresolution.h"
#include "mlsmesh/mls_reduction.h"
#include "mlsmesh/mls_refinement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <limits>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace mlsmesh {
namespace {

using Point = pcl::PointXYZRGBNormal;
using testing::cloudOf;

pcl::PointCloud<Point>::Ptr sphere(int count) {
  return cloudOf<Point>(testing::spherePoints(count));
}

/// Runs a verb with this handle; true if its output is empty afterwards.
using Run = std::function<bool(const Progress&, Status&)>;

/// Cancels a run from one callback after the other, of at most about `most` spread over it and the last one.
/// It must use one thread: only then are the callbacks of all runs the same.
void cancelEverywhere(const Run& run, int most = 150) {
  int calls = 0;
  Status status;
  ASSERT_FALSE(run(Progress([&](const std::string&, double) { ++calls; }), status));
  ASSERT_TRUE(status.ok()) << status.message;
  std::set<std::string> stages;
  const int stride = std::max(1, calls / most);
  for (int next = 0; next < calls + stride - 1; next += stride) {
    const int k = std::min(next, calls - 1);
    Progress* handle = nullptr;
    int call = 0;
    Progress progress([&](const std::string& stage, double) {
      if (call++ != k) return;
      stages.insert(stage);
      handle->cancel();
    });
    handle = &progress;
    const bool is_empty = run(progress, status);
    ASSERT_EQ(status.code, StatusCode::Cancelled) << "callback " << k << " of " << calls;
    ASSERT_TRUE(is_empty) << "callback " << k << " of " << calls;
    ASSERT_FALSE(status.message.empty());
  }
  EXPECT_GT(stages.size(), 1u);
}

template <typename Step>
void setUp(const pcl::PointCloud<Point>::Ptr& cloud, const Progress& progress, Step& step) {
  step.setInputCloud(cloud);
  step.setProgress(progress);
  step.setNumberOfThreads(1);
}

Run reconstruction(const pcl::PointCloud<Point>::Ptr& cloud,
                   const std::function<void(MultiresolutionParameters&)>& change) {
  return [=](const Progress& progress, Status& status) {
    MlsMultiresolution<Point> step;
    setUp(cloud, progress, step);
    change(step.parameters());
    pcl::PolygonMesh mesh = testing::usedMesh();
    step.reconstruct(mesh);
    status = step.status();
    return testing::isEmpty(mesh) && step.getLevelCount() == 0 && step.reports().empty();
  };
}

TEST(Cancel, FromAnyCallbackOfAReconstruction) {
  cancelEverywhere(reconstruction(sphere(1500), [](MultiresolutionParameters&) {}));
  cancelEverywhere(reconstruction(sphere(800), [](MultiresolutionParameters& p) { p.reduce = false; }));
  cancelEverywhere(reconstruction(cloudOf<Point>(testing::cylinderPoints(60, 20)),
                                  [](MultiresolutionParameters& p) { p.watertight = true; }));
}

TEST(Cancel, FromAnyCallbackIntoACloud) {
  const auto cloud = sphere(800);
  cancelEverywhere([&](const Progress& progress, Status& status) {
    MlsMultiresolution<Point> step;
    setUp(cloud, progress, step);
    pcl::PointCloud<Point> points;
    std::vector<pcl::Vertices> polygons(2);
    step.reconstruct(points, polygons);
    status = step.status();
    return testing::isEmpty(points) && polygons.empty();
  });
}

TEST(Cancel, FromAnyCallbackOfAStep) {
  const auto cloud = sphere(1500);
  cancelEverywhere([&](const Progress& progress, Status& status) {
    BspClustering<Point> step;
    setUp(cloud, progress, step);
    std::vector<pcl::PointIndices> clusters(3);
    step.extract(clusters);
    status = step.status();
    return clusters.empty();
  });
  cancelEverywhere([&](const Progress& progress, Status& status) {
    MlsReduction<Point, Point> step;
    setUp(cloud, progress, step);
    pcl::PointCloud<Point> output(3, 1);
    step.process(output);
    status = step.status();
    return testing::isEmpty(output) && step.clusterSizes().empty();
  });
  cancelEverywhere([&](const Progress& progress, Status& status) {
    AdvancingFrontTriangulation<Point> step;
    setUp(cloud, progress, step);
    pcl::PolygonMesh mesh = testing::usedMesh();
    step.reconstruct(mesh);
    status = step.status();
    return testing::isEmpty(mesh);
  });
  const pcl::PolygonMesh::Ptr coarse(new pcl::PolygonMesh);
  MlsMultiresolution<Point> first;
  setUp(cloud, Progress(), first);
  first.setLevels(0);
  first.reconstruct(*coarse);
  ASSERT_TRUE(first.status().ok());
  cancelEverywhere([&](const Progress& progress, Status& status) {
    MlsRefinement<Point> step;
    setUp(cloud, progress, step);
    step.setInputMesh(coarse);
    step.setLevels(2);
    pcl::PolygonMesh mesh = testing::usedMesh();
    step.process(mesh);
    status = step.status();
    return testing::isEmpty(mesh) && step.getLevelCount() == 0;
  });
}

TEST(Cancel, ThenResetIsAsNew) {
  const auto cloud = sphere(1000);
  pcl::PolygonMesh expected, mesh;
  MlsMultiresolution<Point> fresh;
  setUp(cloud, Progress(), fresh);
  fresh.reconstruct(expected);
  ASSERT_TRUE(fresh.status().ok());

  MlsMultiresolution<Point> step;
  Progress* handle = nullptr;
  bool cancels = true;
  Progress progress([&](const std::string& stage, double) {
    if (cancels && stage == "triangulation") handle->cancel();
  });
  handle = &progress;
  setUp(cloud, progress, step);
  step.reconstruct(mesh);
  EXPECT_EQ(step.status().code, StatusCode::Cancelled);
  step.reconstruct(mesh);
  EXPECT_EQ(step.status().code, StatusCode::Cancelled) << "stays asked until it is reset";
  EXPECT_TRUE(testing::isEmpty(mesh));
  cancels = false;
  progress.reset();
  EXPECT_EQ(progress.fraction(), 0);
  for (int run = 0; run < 2; ++run) {
    step.reconstruct(mesh);
    ASSERT_TRUE(step.status().ok()) << step.status().message;
    EXPECT_TRUE(testing::sameMesh(mesh, expected)) << "run " << run;
    EXPECT_EQ(progress.fraction(), 1);
  }
}

TEST(Progress, NeverFallsDuringAReconstruction) {
  for (const bool reduces : {true, false}) {
    MlsMultiresolution<Point> step;
    double before = -1;
    bool falls = false, leaves = false;
    const Progress progress([&](const std::string&, double fraction) {
      falls = falls || fraction < before;
      leaves = leaves || fraction < 0 || fraction > 1;
      before = fraction;
    });
    setUp(sphere(2000), progress, step);
    step.setNumberOfThreads(2);
    step.parameters().reduce = reduces;
    step.parameters().watertight = true;
    // Seen from another thread too, which looks as often as it can.
    std::atomic<bool> ends{false}, falls_there{false};
    std::thread other([&] {
      for (double last = 0; !ends;) {
        const double now = progress.fraction();
        if (now < last) falls_there = true;
        last = now;
      }
    });
    pcl::PolygonMesh mesh;
    step.reconstruct(mesh);
    ends = true;
    other.join();
    ASSERT_TRUE(step.status().ok());
    EXPECT_FALSE(falls);
    EXPECT_FALSE(falls_there);
    EXPECT_FALSE(leaves);
    EXPECT_EQ(before, 1);
    EXPECT_EQ(progress.fraction(), 1);
  }
}

TEST(Independence, OfObjectsInThreads) {
  const std::vector<pcl::PointCloud<Point>::Ptr> clouds = {
      sphere(1200), cloudOf<Point>(testing::cylinderPoints(60, 20)), sphere(500)};
  const auto reconstruct = [&](std::size_t i, pcl::PolygonMesh& mesh) {
    MlsMultiresolution<Point> step;
    setUp(clouds[i], Progress(), step);
    step.setNumberOfThreads(2);
    step.reconstruct(mesh);
    return step.status().ok();
  };
  std::vector<pcl::PolygonMesh> expected(clouds.size());
  for (std::size_t i = 0; i < clouds.size(); ++i) ASSERT_TRUE(reconstruct(i, expected[i]));
  constexpr int kRounds = 3;
  std::atomic<int> differences{0};
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    threads.emplace_back([&, i] {
      for (int round = 0; round < kRounds; ++round) {
        pcl::PolygonMesh mesh;
        if (!reconstruct(i, mesh) || !testing::sameMesh(mesh, expected[i])) ++differences;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(differences, 0);
}

TEST(Independence, OfACancelledNeighbour) {
  const auto cloud = sphere(1000);
  pcl::PolygonMesh expected;
  MlsMultiresolution<Point> alone;
  setUp(cloud, Progress(), alone);
  alone.reconstruct(expected);
  ASSERT_TRUE(alone.status().ok());
  std::atomic<bool> ends{false};
  std::thread neighbour([&] {
    while (!ends) {
      Progress* handle = nullptr;
      Progress progress([&](const std::string& stage, double) {
        if (stage == "outliers") handle->cancel();
      });
      handle = &progress;
      MlsMultiresolution<Point> step;
      setUp(cloud, progress, step);
      pcl::PolygonMesh mesh;
      step.reconstruct(mesh);
    }
  });
  for (int round = 0; round < 3; ++round) {
    MlsMultiresolution<Point> step;
    setUp(cloud, Progress(), step);
    pcl::PolygonMesh mesh;
    step.reconstruct(mesh);
    EXPECT_TRUE(step.status().ok());
    EXPECT_TRUE(testing::sameMesh(mesh, expected));
  }
  ends = true;
  neighbour.join();
}

}  // namespace
}  // namespace mlsmesh
