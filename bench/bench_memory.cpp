// SPDX-License-Identifier: BSD-3-Clause
// bench_memory --cloud FILE.pcd|--points N [--threads N] [--no-reduction] [--flat]: one run of the pipeline
// (level 0, or the points as they are) in a process of its own. Prints as JSON how much memory it took at its
// peak and what it held at its end, above the input cloud (pcl::PointXYZ, 16 bytes a point), and its time.
// --flat: to the core's plain data, before a pcl::PolygonMesh is made.
#include <chrono>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>

#include "clouds.h"
#include "options.h"
#include "ours.h"
#include "peak_memory.h"

namespace {

using namespace mlsmesh::bench;

struct Request {
  Options options;
  PipelineRun run;
  bool flat = false;
};

Request requestOf(int argc, char** argv) {
  Request request;
  request.options = parseOptions(argc, argv, {});
  bool known = request.options.cloud.empty() == (request.options.points.size() == 1);
  for (const std::string& flag : request.options.flags) {
    known = known && (flag == "--no-reduction" || flag == "--flat");
    if (flag == "--no-reduction") request.run.reduce = false;
    if (flag == "--flat") request.flat = true;
  }
  if (!known) {
    throw std::invalid_argument(
        "usage: bench_memory --cloud FILE.pcd|--points N [--threads N] [--no-reduction] [--flat]");
  }
  request.run.threads = request.options.threads[0];
  return request;
}

struct Figures {
  std::size_t triangles = 0;
  std::size_t before = 0;  // bytes resident with the cloud alone
  std::size_t peak = 0;
  std::size_t held = 0;  // with all that the run made
  double cpu_seconds = 0;
  double wall_seconds = 0;
};

// Peak and times are read before memory is given back for the last reading.
Figures measure(const Cloud::ConstPtr& cloud, const Request& request) {
  Figures figures;
  figures.before = residentNow();
  if (!restartResidentPeak()) {
    std::fprintf(stderr, "bench_memory: WARNING: the peak cannot be restarted: it is that since the start\n");
  }
  const double cpu_start = cpuSeconds();
  const auto start = std::chrono::steady_clock::now();
  const auto while_held = [&] {
    figures.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    figures.cpu_seconds = cpuSeconds() - cpu_start;
    figures.peak = residentPeak();
    figures.held = residentNow();
  };
  figures.triangles = request.flat ? makeFlatTriangles(cloud, request.run, while_held)
                                   : makePolygonMesh(cloud, request.run, while_held);
  return figures;
}

void print(const Figures& figures, std::size_t points, int threads) {
  const auto perPoint = [&](std::size_t bytes) {
    return (static_cast<double>(bytes) - static_cast<double>(figures.before)) / static_cast<double>(points);
  };
  std::printf(
      "{\"points\": %zu, \"triangles\": %zu, \"threads\": %d, \"wall_seconds\": %.3f, \"cpu_seconds\": "
      "%.3f,\n"
      " \"resident_before\": %zu, \"peak_bytes_per_point\": %.1f, \"held_bytes_per_point\": %.1f}\n",
      points, figures.triangles, threads, figures.wall_seconds, figures.cpu_seconds, figures.before,
      perPoint(figures.peak), perPoint(figures.held));
}

void run(const Request& request) {
  const Options& options = request.options;
  const Cloud::Ptr cloud = options.cloud.empty() ? bumpySphere(options.points[0]) : readCloud(options.cloud);
  print(measure(cloud, request), cloud->size(), request.run.threads);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run(requestOf(argc, argv));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_memory: %s\n", error.what());
    return 2;
  }
  return 0;
}
