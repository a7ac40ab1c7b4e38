// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/polygon_soup.h"

#include <filesystem>

namespace mlsmesh::apps {

// Polygons, and strips of triangles taken apart, of VTK's formats; the second through its own reader. Each
// throws AppError.

/// A legacy file whose data set is polygons.
PolygonSoup readVtkMesh(const std::filesystem::path& file);
PolygonSoup readVtpMesh(const std::filesystem::path& file);

}  // namespace mlsmesh::apps
