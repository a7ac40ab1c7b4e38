// SPDX-License-Identifier: BSD-3-Clause
#include "compare/task.h"

#include "common/app_error.h"
#include "common/atomic_output.h"
#include "common/mesh_reader.h"
#include "compare/loaded_cloud.h"
#include "compare/mesh_output.h"
#include "compare/methods.h"
#include "compare/our_parameters.h"
#include "compare/pictures.h"
#include "compare/results.h"
#include "inspect/figures.h"
#include "inspect/inspect_options.h"
#include "inspect/report.h"
#include "mlsmesh/core/neighbor_search.h"
#include "mlsmesh/mesh_welding.h"

#include <omp.h>
#include <sys/resource.h>

#include <iostream>
#include <new>

namespace mlsmesh::apps {
namespace {

double cpuSeconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

std::uint64_t peakBytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

/// Median distance of a distinct point to its nearest other; 0 if there is none.
double medianSpacing(std::vector<core::Vec3> points, int threads) {
  std::vector<core::Triangle> none;
  weldVertices(points, none);
  if (points.size() < 2) return 0;
  core::Context context;
  context.threads = threads;
  return core::medianSpacing(points, *core::makeKdTree(points), context);
}

Json survey(const Json& task) {
  const std::string file = task.at("cloud");
  const LoadedCloud loaded = loadCloud(file);
  const std::vector<core::Vec3> points = loadPoints(file);
  Eigen::AlignedBox3d box;
  for (const core::Vec3& point : points) box.extend(point);
  const std::string truth = task.at("truth");
  if (!truth.empty() && readTriangles(truth).triangles.empty())
    throw fileError(truth, "holds no faces; the true surface must be a mesh");
  return {{"points", loaded.input.cloud->size()},
          {"finite", points.size()},
          {"width", loaded.width},
          {"height", loaded.height},
          {"spacing", medianSpacing(points, task.at("threads"))},
          {"diagonal", box.diagonal().norm()}};
}

/// Runs a method; what it throws is its own, and becomes a status.
RowStatus attempt(const Method& method, const MethodInput& input, StageClock& clock, pcl::PolygonMesh& mesh,
                  std::string& reason) {
  try {
    mesh = method.run(input, clock);
    return mesh.polygons.empty() ? RowStatus::Empty : RowStatus::Done;
  } catch (const Refusal& refusal) {
    reason = refusal.what();
    return RowStatus::Refused;
  } catch (const std::bad_alloc&) {
    return RowStatus::OverMemory;
  } catch (const std::exception& error) {
    reason = oneLine(error.what());
    return RowStatus::Failed;
  }
}

Json stagesJson(const std::vector<StageSeconds>& stages) {
  Json list = Json::array();
  for (const StageSeconds& stage : stages) list.push_back({{"name", stage.name}, {"seconds", stage.seconds}});
  return list;
}

Json reconstruct(const Json& task) {
  LoadedCloud loaded = loadCloud(task.at("cloud").get<std::string>());
  loaded.input.threads = task.at("threads");
  loaded.input.parameters = parametersOf(task.at("parameters"));
  if (loaded.input.threads > 0) omp_set_num_threads(loaded.input.threads);
  StageClock clock;
  pcl::PolygonMesh mesh;
  std::string reason;
  const double begin = cpuSeconds();
  const RowStatus status = attempt(*findMethod(task.at("method")), loaded.input, clock, mesh, reason);
  const double cpu_seconds = cpuSeconds() - begin;
  const std::uint64_t peak = peakBytes();
  clock.end();
  if (status == RowStatus::Done) writeComparedMesh(mesh, loaded.origin, task.at("mesh").get<std::string>());
  return {{"status", nameOf(status)},
          {"reason", reason},
          {"stages", stagesJson(clock.stages())},
          {"cpu_seconds", cpu_seconds},
          {"peak_bytes", peak}};
}

Json measure(const Json& task) {
  InspectOptions options;
  options.mesh = task.at("mesh").get<std::string>();
  options.cloud = task.at("cloud").get<std::string>();
  options.truth = task.at("truth").get<std::string>();
  options.threads = task.at("threads");
  const Inspection inspection = inspect(options);
  Json report = Json::parse(reportJson(options, inspection, figuresOf(inspection)));
  report.erase("mesh");  // a temporary name
  return report;
}

Json resultOf(const Json& task) {
  const std::string kind = task.at("kind");
  if (kind == "survey") return survey(task);
  if (kind == "reconstruct") return reconstruct(task);
  if (kind == "measure") return measure(task);
  if (kind == "draw") return drawPictures(task);
  throw AppError(kExitUsage, kWorkerOption + std::string(": unknown task ") + kind);
}

void writeResult(const Json& task, const Json& result) {
  const std::string file = task.at("result");
  writeFile(file, result.dump(2, ' ', false, Json::error_handler_t::replace), file);
}

}  // namespace

int runWorker(const std::string& text) {
  return runProgram("mlsmesh_compare", [&] {
    const Json task = Json::parse(text);
    try {
      writeResult(task, resultOf(task));
    } catch (const AppError& error) {
      writeResult(task, {{"error", error.what()}, {"exit_code", error.exitCode()}});
    }
    return kExitOk;
  });
}

}  // namespace mlsmesh::apps
