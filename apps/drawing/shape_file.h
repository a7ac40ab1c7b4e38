// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "drawing/shape.h"

#include <pcl/PCLPointCloud2.h>

#include <filesystem>
#include <string>
#include <vector>

namespace mlsmesh::apps {

/// A file made ready to be drawn.
struct ShapeFile {
  Shape shape;
  pcl::PCLPointCloud2 cloud;          ///< of a cloud: all its fields
  std::vector<std::string> warnings;  ///< what was left out, "FILE: ..."
};

/// Reads a mesh (PLY, OBJ, STL, VTK, VTP with faces) or else the points of a cloud, with colours and normals
/// if the file has them; a mesh without normals is given them. Coordinates stay doubles. Throws AppError that
/// names the file.
ShapeFile readShape(const std::filesystem::path& file);

/// The finite points of a cloud, with their colours and normals. Throws AppError that names `file`, if there
/// are none.
Shape cloudShape(const pcl::PCLPointCloud2& cloud, const std::filesystem::path& file);

}  // namespace mlsmesh::apps
