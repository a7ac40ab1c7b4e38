// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/reconstruction_options.h"

#include <filesystem>
#include <string>

namespace mlsmesh::apps {

inline constexpr const char* kProgram = "mlsmesh_reconstruct";

enum class Action { Reconstruct, Print };

/// What the user asked for.
struct Options : ReconstructionOptions {
  Action action = Action::Reconstruct;
  std::string text;  ///< to print, with Action::Print (help, version, lists)
  std::filesystem::path input;
  std::filesystem::path output;
  std::filesystem::path config;  ///< empty if none
  std::filesystem::path json;    ///< empty if none
  double memory_limit = 0;       ///< megabytes (2^20 bytes); 0 = none
  bool quiet = false;
};

/// Reads the command line and the config file it names. Throws AppError (kExitUsage) that names the option,
/// or file and line, and what is allowed.
Options parseOptions(int argc, const char* const* argv);

}  // namespace mlsmesh::apps
