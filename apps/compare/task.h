// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>

namespace mlsmesh::apps {

using Json = nlohmann::ordered_json;

/// First argument of this program where it is a worker; the second one is a task.
inline constexpr const char* kWorkerOption = "--worker";

/// Does what the task says and writes what came of it to the task's "result" file, a JSON document. Tasks are
/// JSON objects with a "kind":
/// - "survey": reads "cloud" and, unless empty, "truth"; the result has the cloud's sizes;
/// - "reconstruct": runs "method" on "cloud" with "threads" and, ours, "parameters"; writes "mesh" if it has
/// faces. The result has a
///   "status" (one of RowStatus's names), a "reason", "stages", "cpu_seconds", "peak_bytes";
/// - "measure": the document of mlsmesh_inspect on "mesh", with "cloud" and "truth";
/// - "draw": pictures.h.
/// A result with "error" and "exit_code" instead is that of an AppError. Returns the exit code; there is no
/// result after any but 0.
int runWorker(const std::string& task);

}  // namespace mlsmesh::apps
