// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/PolygonMesh.h>

#include <filesystem>
#include <string>
#include <vector>

namespace mlsmesh::apps {

/// The extensions, "ply, obj, ...": for help and errors.
std::string writableMeshFormats();

/// Throws AppError (kExitUsage) unless the extension is one of a format that writeMesh knows.
void checkWritableMeshFormat(const std::filesystem::path& file);

/// Writes a mesh to `file` (a temporary one) in the format of `target`'s extension; `target` is named in
/// errors. PLY and VTK (both binary) and VTP keep every field to the bit; OBJ positions, normals (both in
/// digits that read back exactly) and colour; STL positions as float32. Throws AppError where the file cannot
/// be written whole.
void writeMesh(const std::filesystem::path& file, const std::filesystem::path& target,
               const pcl::PolygonMesh& mesh);

/// What a user would miss of `mesh` in the format of `target`: one text a loss (colour, double coordinates),
/// that names the format and one that keeps it.
std::vector<std::string> lossesOf(const std::filesystem::path& target, const pcl::PCLPointCloud2& vertices);

}  // namespace mlsmesh::apps
