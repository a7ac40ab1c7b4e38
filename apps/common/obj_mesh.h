// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/polygon_soup.h"

#include <filesystem>

namespace mlsmesh::apps {

/// Vertices and faces of a Wavefront OBJ file. By hand: PCL's reader rounds coordinates to float32, VTK's
/// splits vertices whose corners differ in texture. Throws AppError.
PolygonSoup readObjMesh(const std::filesystem::path& file);

}  // namespace mlsmesh::apps
