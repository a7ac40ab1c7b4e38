// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/viewpoint.h"

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace mlsmesh::apps {

/// What the command line of mlsmesh_view asks for.
struct ViewOptions {
  bool help = false;     ///< nothing but the help text
  bool version = false;  ///< nothing but the version
  std::vector<std::filesystem::path> files;
  std::filesystem::path screenshot;  ///< empty: a window
  std::array<int, 2> size{0, 0};     ///< pixels; 0: by the number of files
  Viewpoint viewpoint;
  double zoom = 1.0;
  bool flat = false;
  bool edges = false;
  bool wireframe = false;
  bool borders = false;
  bool labels = true;
};

/// Columns and rows of the panes in which so many files, at least one, are shown.
std::array<int, 2> paneGrid(std::size_t files);

/// Throws AppError (kExitUsage) that names the option or argument at fault and what is allowed.
ViewOptions readViewOptions(int argc, const char* const* argv);

std::string viewHelp();

}  // namespace mlsmesh::apps
