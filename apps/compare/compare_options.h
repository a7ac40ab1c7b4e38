// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "compare/methods.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace mlsmesh::apps {

inline constexpr const char* kCompareProgram = "mlsmesh_compare";

/// A cloud of the command line, and what belongs to it.
struct CompareInput {
  std::filesystem::path cloud;
  std::filesystem::path truth;  ///< empty if none
  std::string view = "iso";
};

/// What the command line of mlsmesh_compare asks for.
struct CompareOptions {
  bool help = false;     ///< nothing but the help text
  bool version = false;  ///< nothing but the version
  std::vector<CompareInput> inputs;
  std::filesystem::path output;
  std::vector<const Method*> methods;
  double limit_seconds = 300;      ///< of each method on each cloud
  std::uint64_t memory_bytes = 0;  ///< of each method
  int threads = 1;                 ///< 0 = all
  std::string up = "y";
  bool pictures = true;
  bool quiet = false;
};

/// Throws AppError (kExitUsage) that names the option or argument at fault and what is allowed.
CompareOptions readCompareOptions(int argc, const char* const* argv);

std::string compareHelp();

}  // namespace mlsmesh::apps
