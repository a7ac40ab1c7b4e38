// SPDX-License-Identifier: BSD-3-Clause
// bench_cancel --cloud FILE.pcd|--points N [--threads N] [--moments=N] [--only=NAME]: how long cancel()
// takes. Runs each step and the whole reconstruction once to its end, then again and again, cancelled by
// another thread at moments spread evenly over that time. Prints for each the slowest return of the verb
// since cancel(), by the clock and by the processor time that the run still took, and the stage it was in.
#include <time.h>

#include <algorithm>

#include <chrono>
#include <cstdio>
#include <exception>
#include <functional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "clouds.h"
#include "mlsmesh/advancing_front_triangulation.h"
#include "mlsmesh/bsp_clustering.h"
#include "mlsmesh/mls_multiresolution.h"
#include "mlsmesh/mls_reduction.h"
#include "mlsmesh/mls_refinement.h"
#include "options.h"

namespace {

using namespace mlsmesh;
using bench::Cloud;
using Clock = std::chrono::steady_clock;
using Verb = std::function<Status(const Progress&)>;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double cpuSeconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

struct Latency {
  double seconds = 0;
  double cpu_seconds = 0;
  std::string stage;
};

// One run, cancelled `delay` seconds after its start. Nothing if it was done before that.
Latency cancelledAfter(double delay, const Verb& verb) {
  std::string stage = "before any";
  const Progress progress([&](const std::string& name, double) { stage = name; });
  Progress handle = progress;
  Latency latency;
  Clock::time_point asked;
  double cpu_asked = 0;
  std::thread other([&] {
    std::this_thread::sleep_for(std::chrono::duration<double>(delay));
    cpu_asked = cpuSeconds();
    asked = Clock::now();
    handle.cancel();
  });
  const Status status = verb(progress);
  const Clock::time_point returned = Clock::now();
  const double cpu_returned = cpuSeconds();
  other.join();
  if (status.code != StatusCode::Cancelled) return latency;
  latency.seconds = std::chrono::duration<double>(returned - asked).count();
  latency.cpu_seconds = cpu_returned - cpu_asked;
  latency.stage = stage;
  return latency;
}

void measure(const std::string& name, int moments, const Verb& verb) {
  const Clock::time_point start = Clock::now();
  const Status status = verb(Progress());
  const double whole = secondsSince(start);
  if (!status.ok()) throw std::runtime_error(name + ": " + status.message);
  std::vector<Latency> worst;  // one a stage
  for (int i = 0; i < moments; ++i) {
    const Latency latency = cancelledAfter((i + 0.5) / moments * whole, verb);
    if (latency.stage.empty()) continue;
    auto place =
        std::find_if(worst.begin(), worst.end(), [&](const Latency& l) { return l.stage == latency.stage; });
    if (place == worst.end()) place = worst.insert(worst.end(), {0, 0, latency.stage});
    place->seconds = std::max(place->seconds, latency.seconds);
    place->cpu_seconds = std::max(place->cpu_seconds, latency.cpu_seconds);
  }
  for (const Latency& latency : worst) {
    std::printf("| %s | %.2f | %s | %.0f | %.0f |\n", name.c_str(), whole, latency.stage.c_str(),
                1e3 * latency.seconds, 1e3 * latency.cpu_seconds);
  }
  std::fflush(stdout);
}

Verb wholeRun(const Cloud::ConstPtr& cloud, int threads, int levels,
              const std::function<void(MultiresolutionParameters&)>& change) {
  return [=](const Progress& progress) {
    MlsMultiresolution<pcl::PointXYZ> pipeline;
    pipeline.setInputCloud(cloud);
    pipeline.setNumberOfThreads(threads);
    pipeline.setProgress(progress);
    pipeline.setLevels(levels);
    change(pipeline.parameters());
    pcl::PolygonMesh mesh;
    pipeline.reconstruct(mesh);
    return pipeline.status();
  };
}

template <typename Step, typename Output>
Verb stepRun(const Cloud::ConstPtr& cloud, int threads) {
  return [=](const Progress& progress) {
    Step step;
    step.setInputCloud(cloud);
    step.setNumberOfThreads(threads);
    step.setProgress(progress);
    Output output;
    step.compute(output);
    return step.status();
  };
}

Verb refinementRun(const Cloud::ConstPtr& cloud, int threads) {
  MlsMultiresolution<pcl::PointXYZ> pipeline;
  pipeline.setInputCloud(cloud);
  pipeline.setLevels(0);
  const pcl::PolygonMesh::Ptr mesh(new pcl::PolygonMesh);
  pipeline.reconstruct(*mesh);
  if (!pipeline.status().ok()) throw std::runtime_error(pipeline.status().message);
  return [=](const Progress& progress) {
    MlsRefinement<pcl::PointXYZ> step;
    step.setInputCloud(cloud);
    step.setInputMesh(mesh);
    step.setLevels(2);
    step.setNumberOfThreads(threads);
    step.setProgress(progress);
    pcl::PolygonMesh output;
    step.process(output);
    return step.status();
  };
}

struct Request {
  bench::Options options;
  int moments = 50;
  std::string only;
};

Request requestOf(int argc, char** argv) {
  Request request;
  request.options = bench::parseOptions(argc, argv, {});
  for (const std::string& flag : request.options.flags) {
    if (flag.rfind("--moments=", 0) == 0) {
      request.moments = std::stoi(flag.substr(10));
    } else if (flag.rfind("--only=", 0) == 0) {
      request.only = flag.substr(7);
    } else {
      throw std::invalid_argument("unknown option " + flag);
    }
  }
  if (request.options.cloud.empty() != (request.options.points.size() == 1)) {
    throw std::invalid_argument(
        "usage: bench_cancel --cloud FILE.pcd|--points N [--threads N] [--moments=N] [--only=NAME]");
  }
  return request;
}

void run(const Request& request) {
  const bench::Options& options = request.options;
  const Cloud::ConstPtr cloud =
      options.cloud.empty() ? bench::bumpySphere(options.points[0]) : bench::readCloud(options.cloud);
  const int threads = options.threads[0];
  const auto as_it_is = [](MultiresolutionParameters&) {};
  const std::vector<std::pair<std::string, std::function<Verb()>>> cases = {
      {"level-0", [&] { return wholeRun(cloud, threads, 0, as_it_is); }},
      {"levels-0-2", [&] { return wholeRun(cloud, threads, 2, as_it_is); }},
      {"watertight",
       [&] {
         return wholeRun(cloud, threads, 0, [](MultiresolutionParameters& p) { p.watertight = true; });
       }},
      {"no-reduction",
       [&] { return wholeRun(cloud, threads, 0, [](MultiresolutionParameters& p) { p.reduce = false; }); }},
      {"clustering",
       [&] { return stepRun<BspClustering<pcl::PointXYZ>, std::vector<pcl::PointIndices>>(cloud, threads); }},
      {"reduction",
       [&] {
         return stepRun<MlsReduction<pcl::PointXYZ, pcl::PointNormal>, pcl::PointCloud<pcl::PointNormal>>(
             cloud, threads);
       }},
      {"triangulation",
       [&] { return stepRun<AdvancingFrontTriangulation<pcl::PointXYZ>, pcl::PolygonMesh>(cloud, threads); }},
      {"refinement", [&] { return refinementRun(cloud, threads); }},
  };
  std::printf("| run | seconds | stage | latency ms | processor ms |\n|---|---|---|---|---|\n");
  for (const auto& [name, make] : cases) {
    if (request.only.empty() || request.only == name) measure(name, request.moments, make());
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run(requestOf(argc, argv));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_cancel: %s\n", error.what());
    return 2;
  }
  return 0;
}
