// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "compare/method_input.h"
#include "mlsmesh/core/types.h"

#include <filesystem>
#include <vector>

namespace mlsmesh::apps {

/// A cloud as methods are given it, and the way back to the coordinates of its file.
struct LoadedCloud {
  MethodInput input;
  core::Vec3 origin =
      core::Vec3::Zero();  ///< taken off where the file has doubles: PCL's methods take floats
  std::size_t width = 0;
  std::size_t height = 0;
};

/// Throws AppError that names the file; also if no point is finite.
LoadedCloud loadCloud(const std::filesystem::path& file);

/// The finite points of a file, in its coordinates. Throws AppError that names the file.
std::vector<core::Vec3> loadPoints(const std::filesystem::path& file);

}  // namespace mlsmesh::apps
