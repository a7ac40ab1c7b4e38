// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/types.h"

#include <pcl/PolygonMesh.h>

#include <filesystem>

namespace mlsmesh::apps {

/// Writes positions and faces as a binary PLY file, and beside it, under the same name but for ".vtk", as a
/// legacy VTK file, the only meshes that Debian's pcl_viewer takes: moved by `origin`, vertices that are not
/// finite and faces with such a corner left out, and nothing else. Throws AppError.
void writeComparedMesh(const pcl::PolygonMesh& mesh, const core::Vec3& origin,
                       const std::filesystem::path& ply);

}  // namespace mlsmesh::apps
