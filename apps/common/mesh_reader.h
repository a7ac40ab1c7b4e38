// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/types.h"

#include <filesystem>
#include <string>
#include <vector>

namespace mlsmesh::apps {

/// The triangles of a file, and what was done to get them.
struct TriangleFile {
  std::vector<core::Vec3> vertices;  ///< in doubles as far as the file has them; those not finite are 0
  std::vector<core::Triangle>
      triangles;  ///< whose corners are vertices, and finite; else as the file has them
  core::Index non_finite_vertices = 0;
  core::Index dropped_faces = 0;    ///< with fewer than three corners, one that is no vertex, or not finite
  core::Index polygons = 0;         ///< with more than three corners: cut into a fan from the first
  core::Index welded_vertices = 0;  ///< STL has no shared corners: those at exactly one position are merged
};

/// The extensions, "ply, obj, ...": for help and errors.
std::string readableMeshFormats();

/// Throws AppError (kExitUsage) unless the extension is one of a format that readTriangles knows.
void checkReadableMeshFormat(const std::filesystem::path& file);

/// Reads the faces of a file, of the format its extension names; a file without faces has none. Nothing is
/// printed, also not by PCL or VTK. Throws AppError that names the file, what is wrong and the remedy.
TriangleFile readTriangles(const std::filesystem::path& file);

}  // namespace mlsmesh::apps
