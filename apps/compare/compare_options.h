// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/reconstruction_options.h"
#include "compare/methods.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace mlsmesh::apps {

inline constexpr const char* kCompareProgram = "mlsmesh_compare";

/// A cloud, and what belongs to it.
struct CompareInput {
  std::filesystem::path cloud;
  std::filesystem::path truth;  ///< empty if none
  std::string view = "iso";
};

/// What the command line of mlsmesh_compare and its config file ask for.
struct CompareOptions {
  bool help = false;     ///< nothing but the help text
  bool version = false;  ///< nothing but the version
  std::vector<CompareInput> inputs;
  std::filesystem::path output;
  std::vector<const Method*> methods;
  double limit_seconds = 300;      ///< of each method on each cloud
  std::uint64_t memory_bytes = 0;  ///< of each method
  int threads = 1;                 ///< 0 = all
  ReconstructionOptions ours;      ///< preset and parameters of our methods
  std::string up = "y";
  bool pictures = true;
  bool quiet = false;
};

/// Throws AppError (kExitUsage) that names the option, the argument or the line of the config file at fault
/// and what is allowed.
CompareOptions readCompareOptions(int argc, const char* const* argv);

std::string compareHelp();

}  // namespace mlsmesh::apps
