// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "compare/methods.h"
#include "compare/stage_clock.h"
#include "compare/task.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace mlsmesh::apps {

/// What became of a method on a cloud.
enum class RowStatus { Done, Empty, Refused, OverTime, OverMemory, Crashed, Failed };

/// "done", "empty", "refused", "over_time", "over_memory", "crashed", "failed": as in JSON and CSV.
std::string nameOf(RowStatus status);
/// Throws std::invalid_argument.
RowStatus statusFromName(const std::string& name);
/// For people: "no faces", "over the time limit".
std::string wordsOf(RowStatus status);

/// Pictures of a mesh, as JPEG files; empty if there is none.
struct Pictures {
  std::filesystem::path surface;
  std::filesystem::path mesh_to_cloud;
  std::filesystem::path cloud_to_mesh;
};

/// One method on one cloud.
struct Row {
  const Method* method = nullptr;
  std::string parameters;  ///< how the method is called, in words
  RowStatus status = RowStatus::Failed;
  std::string reason;  ///< why there is no mesh, or why it was not measured; else empty
  std::vector<StageSeconds> stages;
  double cpu_seconds = 0;   ///< of all stages and threads
  double wall_seconds = 0;  ///< of the whole process, reading and writing included, as are the next two
  double user_seconds = 0;
  double system_seconds = 0;
  std::uint64_t peak_bytes = 0;
  std::string mesh_file;  ///< below the output folder; empty if there is none
  Json report;            ///< that of mlsmesh_inspect; null if there is none
  Pictures pictures;

  /// Estimation and orientation of normals.
  double normalSeconds() const;
  /// All other stages.
  double methodSeconds() const;
  double totalSeconds() const { return normalSeconds() + methodSeconds(); }
  /// A figure of the report by group and name; not a number if there is none.
  double figure(const std::string& group, const std::string& name) const;
};

/// One cloud, and all methods on it.
struct CloudResult {
  std::string name;  ///< unlike all others, and fit for a file name
  std::filesystem::path file;
  std::filesystem::path truth;  ///< empty if none
  std::size_t points = 0;
  std::size_t finite = 0;
  std::size_t width = 0;
  std::size_t height = 0;
  double spacing = 0;   ///< median distance to the nearest other point
  double diagonal = 0;  ///< of the box around the points
  std::filesystem::path cloud_picture;
  std::filesystem::path truth_picture;
  std::vector<Row> rows;
};

struct Comparison {
  double limit_seconds = 0;
  std::uint64_t memory_bytes = 0;
  int threads = 1;
  std::string when;  ///< local date and time at the begin
  std::vector<CloudResult> clouds;
};

}  // namespace mlsmesh::apps
