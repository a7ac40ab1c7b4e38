// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/polygon_soup.h"

#include <filesystem>

namespace mlsmesh::apps {

/// Triangles of an STL file, corner by corner, degenerate ones too. Binary if its length is what its count of
/// triangles says, else text, as far as 'endsolid'. By hand: VTK's reader guesses the kind from the first
/// bytes, and makes arrays for the count that it takes text for. Throws AppError.
PolygonSoup readStlMesh(const std::filesystem::path& file);

}  // namespace mlsmesh::apps
