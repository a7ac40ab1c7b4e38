// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruct/summary.h"

#include "common/parameter_table.h"
#include "mlsmesh/version.h"

#include <sys/resource.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cstdarg>
#include <cstdio>

namespace mlsmesh::apps {

namespace {

using Json = nlohmann::ordered_json;

/// In the order of core::VertexKind.
constexpr std::array<const char*, 8> kKindNames = {"projected",    "lower_degree", "input_point", "clamped",
                                                   "fold_guarded", "border",       "crease",      "patch"};

Json parameterJson(const MultiresolutionParameters& parameters) {
  Json json;
  for (const Parameter& parameter : parameterTable()) {
    const double value = parameter.get(parameters);
    switch (parameter.kind) {
      case ParameterKind::Whole:
        json[parameter.name] = static_cast<int>(value);
        break;
      case ParameterKind::Real:
        json[parameter.name] = value;
        break;
      case ParameterKind::Boolean:
        json[parameter.name] = value != 0;
        break;
      case ParameterKind::Choice:
        json[parameter.name] = valueText(parameter, parameters);
        break;
    }
  }
  return json;
}

/// How the vertices of a level came about.
Json kindJson(const core::RefinedMesh& mesh, core::Index level) {
  std::array<int, kKindNames.size()> counts = {};
  for (core::Index v = 0; v < mesh.level_vertices[level]; ++v)
    ++counts[static_cast<std::size_t>(mesh.kind[v])];
  Json json;
  for (std::size_t kind = 0; kind < counts.size(); ++kind) json[kKindNames[kind]] = counts[kind];
  return json;
}

Json levelJson(const RunReport& report, core::Index level) {
  const MeshReport& mesh = report.result.reports[level];
  Json json;
  json["level"] = level;
  json["file"] = report.level_files[level].empty() ? Json() : Json(report.level_files[level]);
  json["vertices"] = mesh.vertices;
  json["triangles"] = mesh.triangles;
  json["components"] = mesh.components;
  json["border_loops"] = mesh.border_loops;
  json["border_edges"] = mesh.border_edges;
  json["genus"] = mesh.genus ? Json(*mesh.genus) : Json();
  json["euler"] = mesh.euler;
  json["nonmanifold_edges"] = mesh.nonmanifold_edges;
  json["nonmanifold_vertices"] = mesh.nonmanifold_vertices;
  json["orientation_conflicts"] = mesh.orientation_conflicts;
  json["degenerate_faces"] = mesh.degenerate_faces;
  json["duplicate_faces"] = mesh.duplicate_faces;
  json["isolated_vertices"] = mesh.isolated_vertices;
  json["self_intersections"] = mesh.self_intersections ? Json(*mesh.self_intersections) : Json();
  json["vertex_kinds"] = kindJson(report.result.mesh, level);
  return json;
}

Json inputJson(const Options& options, const RunReport& report) {
  const core::PointSet& points = report.result.points;
  Json json;
  json["file"] = options.input.string();
  json["points"] = report.input_points;
  json["used"] = points.size();
  json["non_finite"] = points.non_finite;
  json["duplicates"] = points.duplicates;
  json["outliers"] = report.result.outliers;
  json["spacing"] = report.result.spacing;
  return json;
}

/// What was estimated of the noise, and what it made of the parameters.
Json noiseJson(const core::NoiseAdaptation& noise) {
  Json json;
  json["sigma"] = noise.estimate.sigma;
  json["relative"] = noise.estimate.relative;
  json["denoising_passes"] = noise.passes;
  json["neighbors"] = noise.parameters.projection.neighbors;
  json["support_factor"] = noise.parameters.projection.support_factor;
  json["threshold"] = noise.parameters.refinement.threshold;
  return json;
}

/// What became of the front's mesh before it was level 0.
Json frontJson(const core::FrontStatistics& front) {
  Json json;
  json["unused_representatives"] = front.unused_points;
  json["split_vertices"] = front.split_vertices;
  json["seams"] = front.seams;
  json["seam_edges"] = front.seam_edges;
  if (!front.healing) return json;
  json["repaired_places"] = front.healing->repaired_places;
  json["opened_places"] = front.healing->opened_places;
  json["cut_handles"] = front.healing->cut_handles;
  json["filled_loops"] = front.filled_loops + front.healing->filled_loops;
  return json;
}

Json holesJson(const core::PatchCount& patches) {
  Json json;
  json["closed"] = patches.closed_loops;
  json["open"] = patches.open_loops;
  json["patch_triangles"] = patches.triangles;
  json["patch_vertices"] = patches.vertices;
  return json;
}

double totalSeconds(const std::vector<core::StageTime>& stages) {
  double sum = 0;
  for (const core::StageTime& stage : stages) sum += stage.seconds;
  return sum;
}

std::string formatted(const char* format, ...) __attribute__((format(printf, 1, 2)));

std::string formatted(const char* format, ...) {
  std::array<char, 256> line = {};
  std::va_list values;
  va_start(values, format);
  std::vsnprintf(line.data(), line.size(), format, values);
  va_end(values);
  return line.data();
}

std::string healingText(const core::FrontStatistics& front) {
  if (!front.healing) return {};
  const core::HealingStatistics& healing = *front.healing;
  const core::Index mended = healing.repaired_places + healing.opened_places;
  if (mended + healing.cut_handles + healing.filled_loops == 0) return {};
  return formatted("mended: %d places where triangles met (%d left a hole), %d false handles, %d gaps\n",
                   mended, healing.opened_places, healing.cut_handles, healing.filled_loops);
}

std::string seamText(const core::FrontStatistics& front) {
  if (front.seams == 0) return {};
  return formatted("seams, where the orientation does not go on and the mesh is cut open: %d (%d edges)\n",
                   front.seams, front.seam_edges);
}

std::string levelRow(const RunReport& report, core::Index level) {
  const MeshReport& mesh = report.result.reports[level];
  const std::string genus = mesh.genus ? std::to_string(*mesh.genus) : "-";
  const std::string crossings = mesh.self_intersections ? std::to_string(*mesh.self_intersections) : "-";
  std::string row = formatted("%5d %10d %10d %11d %13d %6s %18s", level, mesh.vertices, mesh.triangles,
                              mesh.components, mesh.border_loops, genus.c_str(), crossings.c_str());
  if (!report.level_files[level].empty()) row += "  " + report.level_files[level];
  return row + "\n";
}

}  // namespace

std::uint64_t peakMemoryBytes() {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

std::string jsonText(const Options& options, const RunReport& report) {
  Json json;
  json["program"] = kProgram;
  json["version"] = MLSMESH_VERSION;
  json["input"] = inputJson(options, report);
  json["output"] = options.output.string();
  json["preset"] = options.preset;
  json["parameters"] = parameterJson(options.parameters);
  json["threads"] = options.threads;
  json["noise"] = noiseJson(report.result.noise);
  json["representatives"] = report.result.representatives.size();
  json["triangulation"] = frontJson(report.result.front);
  json["holes"] = holesJson(report.result.patches);
  json["stages"] = Json::array();
  for (const core::StageTime& stage : report.stages) {
    json["stages"].push_back({{"name", stage.name}, {"seconds", stage.seconds}});
  }
  json["levels"] = Json::array();
  for (core::Index level = 0; level < report.result.mesh.levelCount(); ++level) {
    json["levels"].push_back(levelJson(report, level));
  }
  json["warnings"] = report.warnings;
  json["peak_rss_bytes"] = peakMemoryBytes();
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string summaryText(const Options& options, const RunReport& report) {
  const core::PointSet& points = report.result.points;
  std::string text = options.input.string() + ": " + std::to_string(report.input_points) + " points";
  text += formatted(", %d used (%d not finite, %d duplicates, %d outliers), spacing %.6g", points.size(),
                    points.non_finite, points.duplicates, report.result.outliers, report.result.spacing);
  const core::NoiseAdaptation& noise = report.result.noise;
  if (options.parameters.noise.adapt && options.parameters.reduce) {
    text += formatted(", noise %.2g local spacings", noise.estimate.relative);
    if (noise.passes > 0) text += formatted(" (denoised in %d passes)", noise.passes);
  }
  text += formatted(", %d representatives\n", report.result.representatives.size());
  text += healingText(report.result.front) + seamText(report.result.front) + "\n";
  text += formatted("%-16s %9s\n", "stage", "seconds");
  for (const core::StageTime& stage : report.stages) {
    text += formatted("%-16s %9.3f\n", stage.name.c_str(), stage.seconds);
  }
  text += formatted("%-16s %9.3f\n\n", "total", totalSeconds(report.stages));
  text += formatted("%5s %10s %10s %11s %13s %6s %18s  %s\n", "level", "vertices", "triangles", "components",
                    "border loops", "genus", "self-intersections", "file");
  for (core::Index level = 0; level < report.result.mesh.levelCount(); ++level)
    text += levelRow(report, level);
  if (options.parameters.watertight || options.parameters.hole_size > 0) {
    const core::PatchCount& patches = report.result.patches;
    text += formatted("\nholes: %d closed by patches of %d triangles in all, %d stay open\n",
                      patches.closed_loops, patches.triangles, patches.open_loops);
  }
  text += formatted("\npeak memory %.0f MB\n", static_cast<double>(peakMemoryBytes()) / (1024 * 1024));
  return text;
}

}  // namespace mlsmesh::apps
