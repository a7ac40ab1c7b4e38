// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/PCLPointCloud2.h>

#include <filesystem>

namespace mlsmesh::apps {

/// The vertices of a PLY file with all their scalars, each of the type it has there: colour bytes (red,
/// green, blue, also diffuse_red, ...) as rgb, with alpha as rgba, and nx, ny, nz as normal_x, normal_y,
/// normal_z. The cloud is organised where the file says how (obj_info num_cols and num_rows, or the viewport
/// of its camera) and has a vertex for every place. By the parser of pcl::PLYReader, which itself makes the
/// cloud as large as those numbers say, misplaces colours in another order, and writes lists of vertices over
/// other fields. Throws AppError.
void readPlyCloud(const std::filesystem::path& file, pcl::PCLPointCloud2& cloud);

}  // namespace mlsmesh::apps
