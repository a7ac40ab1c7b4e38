// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/polygon_soup.h"

#include <filesystem>

namespace mlsmesh::apps {

/// Vertices and faces of a PLY file, by the parser of PCL's reader, which itself knows no double coordinates
/// in meshes and one name of the list of corners only ("vertex_indices"; here "vertex_index", too). Strips of
/// triangles are taken apart. Throws AppError.
PolygonSoup readPlyMesh(const std::filesystem::path& file);

}  // namespace mlsmesh::apps
