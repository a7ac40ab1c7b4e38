// SPDX-License-Identifier: BSD-3-Clause
// bench_against_pcl CLOUD.pcd|--points N [--threads N,N] [Google Benchmark's options]: our pipeline and our
// projection, and what PCL has for the same work, on the same cloud in one process, file reading left out.
// docs/benchmarks.md says what each name is.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <exception>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "clouds.h"
#include "flann_yardstick.h"
#include "mlsmesh/core/point_set.h"
#include "options.h"
#include "ours.h"
#include "pcl_peers.h"
#include "registration.h"

namespace {

using namespace mlsmesh::bench;

/// The cloud, and what some of the benchmarks need to know of it, found out when the first one asks.
class Subject {
 public:
  explicit Subject(Cloud::ConstPtr cloud) : cloud_(std::move(cloud)) {}

  const Cloud::ConstPtr& cloud() const { return cloud_; }

  double spacing() {
    if (!spacing_) spacing_ = meanSpacing(cloud_);
    return *spacing_;
  }

  double radiusOf20() {
    if (!radius_) radius_ = radiusHolding(20, cloud_);
    return *radius_;
  }

  const std::vector<mlsmesh::core::Vec3>& ordered() {
    mlsmesh::core::Context context;
    context.threads = 1;  // others would still spin while the clock runs
    const auto stored_as = mlsmesh::core::StoredAs::Float;
    if (!set_) set_ = mlsmesh::core::makePointSet(positionsOf(*cloud_), stored_as, nullptr, context);
    return set_->position;
  }

 private:
  Cloud::ConstPtr cloud_;
  std::optional<double> spacing_;
  std::optional<double> radius_;
  std::optional<mlsmesh::core::PointSet> set_;
};

void addOurs(Subject& subject, int threads) {
  const std::string suffix = "/threads:" + std::to_string(threads);
  const Cloud::ConstPtr& cloud = subject.cloud();
  const auto pipeline = [&](const std::string& name, const PipelineRun& run) {
    registerBenchmark("mlsmesh/" + name + suffix, "triangles",
                      [=]() -> Work { return [=] { return makePolygonMesh(cloud, run); }; });
  };
  pipeline("levels_0_to_2", {true, 2, threads});
  pipeline("level_0", {true, 0, threads});
  pipeline("no_reduction", {false, 0, threads});
  registerBenchmark("mlsmesh/no_reduction_flat" + suffix, "triangles", [=]() -> Work {
    return [=] { return makeFlatTriangles(cloud, {false, 0, threads}); };
  });
  registerBenchmark("mlsmesh/projection" + suffix, "points",
                    [=]() -> Work { return [=] { return projectEveryPoint(cloud, threads); }; });
}

void addPeers(Subject& subject) {
  const Cloud::ConstPtr& cloud = subject.cloud();
  registerBenchmark("pcl/normals_and_gp3", "triangles", [&subject, cloud]() -> Work {
    return [cloud, spacing = subject.spacing()] { return normalsAndGreedyProjection(cloud, spacing); };
  });
  registerBenchmark("pcl/normals_and_poisson_8", "triangles",
                    [cloud]() -> Work { return [cloud] { return normalsAndPoisson(cloud, 8); }; });
  registerBenchmark("pcl/moving_least_squares", "points", [&subject, cloud]() -> Work {
    return [cloud, radius = subject.radiusOf20()] { return movingLeastSquares(cloud, radius); };
  });
}

void addYardstick(Subject& subject) {
  registerBenchmark("flann/tree_and_nearest_16", "points", [&subject]() -> Work {
    return [&points = subject.ordered()] {
      benchmark::DoNotOptimize(flannTreeAndNearest(points, 16));
      return points.size();
    };
  });
}

Cloud::Ptr cloudOf(const Options& options) {
  if (!options.flags.empty() || options.cloud.empty() != (options.points.size() == 1)) {
    throw std::invalid_argument(
        "usage: bench_against_pcl CLOUD.pcd|--points N [--threads N,N] [--benchmark_...]");
  }
  return options.cloud.empty() ? bumpySphere(options.points[0]) : readCloud(options.cloud);
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  try {
    const Options options = parseOptions(argc, argv, {});
    Subject subject(cloudOf(options));
    for (const int threads : options.threads) addOurs(subject, threads);
    addPeers(subject);
    addYardstick(subject);
    runRegistered();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_against_pcl: %s\n", error.what());
    return 2;
  }
  return 0;
}
