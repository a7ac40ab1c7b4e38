// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "shapes/scan.h"

#include <filesystem>
#include <memory>
#include <string>

namespace mlsmesh::apps {

/// What the command line of mlsmesh_sample asks for.
struct SampleOptions {
  bool help = false;     ///< nothing but the help text
  bool version = false;  ///< nothing but the version
  std::unique_ptr<shapes::Shape> shape;
  std::filesystem::path output;
  shapes::ScanOptions scan;
  bool colors = false;
  bool quiet = false;
};

/// Throws AppError (kExitUsage) that names the option or argument at fault and what is allowed.
SampleOptions readSampleOptions(int argc, const char* const* argv);

std::string sampleHelp();

}  // namespace mlsmesh::apps
