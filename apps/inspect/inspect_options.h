// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "inspect/requirements.h"
#include "mlsmesh/mesh_distance.h"

#include <filesystem>
#include <string>
#include <vector>

namespace mlsmesh::apps {

inline constexpr const char* kInspectProgram = "mlsmesh_inspect";

/// What the command line of mlsmesh_inspect asks for.
struct InspectOptions {
  bool help = false;     ///< nothing but the help text
  bool version = false;  ///< nothing but the version
  std::filesystem::path mesh;
  std::filesystem::path cloud;  ///< empty if none
  std::filesystem::path truth;  ///< empty if none
  std::filesystem::path json;   ///< empty if none
  std::vector<Requirement> requirements;
  std::size_t samples = kDefaultSurfaceSamples;
  int threads = 0;  ///< 0 = all
  bool weld = false;
  bool quiet = false;
};

/// Throws AppError (kExitUsage) that names the option, argument or requirement at fault and what is allowed.
InspectOptions readInspectOptions(int argc, const char* const* argv);

std::string inspectHelp();

}  // namespace mlsmesh::apps
