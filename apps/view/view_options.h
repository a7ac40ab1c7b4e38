// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/reconstruction_options.h"
#include "common/viewpoint.h"
#include "drawing/layers.h"
#include "view/modes.h"
#include "view/script.h"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace mlsmesh::apps {

inline constexpr const char* kViewProgram = "mlsmesh_view";

/// What the command line of mlsmesh_view asks for.
struct ViewOptions {
  bool help = false;     ///< nothing but the help text
  bool version = false;  ///< nothing but the version
  std::vector<std::filesystem::path> files;
  std::filesystem::path cloud;       ///< to compare meshes with; empty: the cloud among the files, if one
  std::filesystem::path screenshot;  ///< empty: a window
  std::vector<ScriptStep> script;    ///< keys that press themselves
  std::array<int, 2> size{0, 0};     ///< pixels
  std::string view;                  ///< name of the viewpoint
  std::string up;                    ///< axis that points up
  Viewpoint viewpoint;               ///< what the two stand for
  double zoom = 1.0;
  Mode mode = Mode::Auto;
  std::optional<int> level;  ///< none: the finest
  double scale = 0.0;        ///< spacings at the dark end of the scale of distances; 0: by the meshes
  SurfaceLook look;
  bool borders = false;  ///< also where meshes are shown
  bool labels = true;
  ReconstructionOptions reconstruction;
};

/// Columns and rows of the panes in which so many files, at least one, are shown.
std::array<int, 2> paneGrid(std::size_t files);

/// Throws AppError (kExitUsage) that names the option or argument at fault and what is allowed.
ViewOptions readViewOptions(int argc, const char* const* argv);

std::string viewHelp();

}  // namespace mlsmesh::apps
