// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruct/run.h"

#include "common/app_error.h"
#include "common/atomic_output.h"
#include "common/cloud_columns.h"
#include "common/cloud_io.h"
#include "common/cloud_reconstruction.h"
#include "common/mesh_io.h"
#include "common/progress_bar.h"
#include "mlsmesh/core/failure.h"
#include "mlsmesh/memory_estimate.h"
#include "mlsmesh/vertex_cloud.h"
#include "reconstruct/summary.h"

#include <chrono>
#include <cmath>
#include <iostream>

namespace mlsmesh::apps {

namespace fs = std::filesystem;

namespace {

class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

/// "mesh.ply" -> "mesh.L0.ply".
fs::path levelFile(const fs::path& output, int level) {
  fs::path file = output;
  return file.replace_filename(output.stem().string() + ".L" + std::to_string(level) +
                               output.extension().string());
}

std::vector<fs::path> outputFiles(const Options& options) {
  std::vector<fs::path> files = {options.output};
  if (!options.json.empty()) files.push_back(options.json);
  const int levels = options.all_levels ? options.parameters.refinement.levels + 1 : 0;
  for (int level = 0; level < levels; ++level) files.push_back(levelFile(options.output, level));
  return files;
}

/// Before any work: every output can be written and is neither an input nor another output.
void checkOutputs(const Options& options) {
  const std::vector<fs::path> files = outputFiles(options);
  for (std::size_t i = 0; i < files.size(); ++i) {
    checkWritable(files[i]);
    for (const fs::path& input : {options.input, options.config}) {
      if (input.empty() || !isSameFile(files[i], input)) continue;
      throw AppError(kExitUsage, files[i].string() + ": would overwrite the input '" + input.string() +
                                     "'; give another name for the output");
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (!isSameFile(files[i], files[j])) continue;
      throw AppError(kExitUsage,
                     files[i].string() + ": is named for two outputs; give another name to one of them");
    }
  }
}

/// The error of a computation that failed, after the name of the input.
AppError failureOf(const Options& options, const Status& status) {
  const int exit_code = status.code == StatusCode::InvalidParameter ? kExitUsage : kExitFailure;
  return {exit_code, options.input.string() + ": " + status.message};
}

void writeLevels(const pcl::PCLPointCloud2& cloud, const Options& options, RunReport& report,
                 std::vector<AtomicOutput>& outputs) {
  const Stopwatch stopwatch;
  const core::RefinedMesh& mesh = report.result.mesh;
  const core::Index finest = mesh.levelCount() - 1;
  report.level_files.assign(static_cast<std::size_t>(mesh.levelCount()), "");
  pcl::PCLPointCloud2 vertices;
  makeLevelCloud(report.result, finest, cloud, vertices);
  for (const std::string& loss : lossesOf(options.output, vertices)) report.warnings.push_back(loss);
  const auto write = [&](const pcl::PolygonMesh& level_mesh, const fs::path& target) {
    outputs.emplace_back(target);
    writeMesh(outputs.back().temporary(), target, level_mesh);
  };
  pcl::PolygonMesh level_mesh;
  for (core::Index level = options.all_levels ? 0 : finest; level <= finest; ++level) {
    makePolygonMesh(mesh, level, vertices, level_mesh);
    const fs::path target = options.all_levels ? levelFile(options.output, level) : options.output;
    report.level_files[level] = target.string();
    write(level_mesh, target);
  }
  if (options.all_levels) write(level_mesh, options.output);
  report.stages.push_back({"write", stopwatch.seconds()});
}

void writeJson(const Options& options, const RunReport& report, std::vector<AtomicOutput>& outputs) {
  if (options.json.empty()) return;
  outputs.emplace_back(options.json);
  writeFile(outputs.back().temporary(), jsonText(options, report), options.json);
}

/// Points of such a cloud that fit into so many bytes.
std::size_t pointsThatFit(double bytes, const pcl::PCLPointCloud2& cloud, const Options& options) {
  std::size_t fit = 0;
  for (std::size_t step = pointCount(cloud); step > 0; step /= 2) {
    const std::uint64_t needed = peakMemoryEstimate(fit + step, cloud.point_step, options.parameters);
    if (static_cast<double>(needed) <= bytes) fit += step;
  }
  return fit;
}

/// Refuses a cloud that may need more than --memory-limit.
void checkMemory(const pcl::PCLPointCloud2& cloud, const Options& options) {
  constexpr double kMegabyte = 1 << 20;
  if (options.memory_limit <= 0) return;
  const auto taken = static_cast<double>(peakMemoryBytes());
  const double limit = options.memory_limit * kMegabyte;
  const double needed = taken + static_cast<double>(peakMemoryEstimate(pointCount(cloud), cloud.point_step,
                                                                       options.parameters));
  if (needed <= limit) return;
  const auto megabytes = static_cast<std::uint64_t>(std::ceil(needed / kMegabyte));
  const std::size_t fit = pointsThatFit(limit - taken, cloud, options);
  throw fileError(
      options.input.string(),
      "may need " + std::to_string(megabytes) + " MB, more than --memory-limit allows; " +
          (fit > 0 ? "thin it out to " + std::to_string(fit) + " points, or " : "") +
          "ask for fewer --levels or larger clusters (--clustering.max_size), or raise the limit");
}

/// All the work; the progress bar is on the screen while it runs.
RunReport run(const Options& options) {
  ProgressBar bar(!options.quiet);
  core::Context context;
  context.threads = options.threads;
  context.progress = Progress([&](const std::string& stage, double fraction) { bar.draw(stage, fraction); });
  RunReport report;
  bar.draw("read", 0);
  const Stopwatch reading;
  pcl::PCLPointCloud2 cloud;
  readCloud(options.input, cloud);
  report.input_points = pointCount(cloud);
  checkMemory(cloud, options);
  report.stages.push_back({"read", reading.seconds()});

  const Status status =
      core::guarded([&] { report.result = reconstructCloud(cloud, options.parameters, context); });
  report.stages.insert(report.stages.end(), report.result.stages.begin(), report.result.stages.end());
  if (!status.ok()) throw failureOf(options, status);
  for (const std::string& warning : context.warnings) {
    report.warnings.push_back(options.input.string() + ": " + warning);
  }

  bar.draw("write", 1);
  std::vector<AtomicOutput> outputs;
  writeLevels(cloud, options, report, outputs);
  writeJson(options, report, outputs);
  commitAll(outputs);
  return report;
}

}  // namespace

void reconstructFile(const Options& options) {
  checkOutputs(options);
  const RunReport report = run(options);
  for (const std::string& warning : report.warnings) printWarning(kProgram, warning);
  if (!options.quiet) std::cout << summaryText(options, report) << std::flush;
}

}  // namespace mlsmesh::apps
