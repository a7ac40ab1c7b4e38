// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <filesystem>
#include <string>

namespace mlsmesh::apps {

/// A file made ready to be drawn.
struct Drawing {
  vtkSmartPointer<vtkPolyData> data;  ///< scalars are colours (bytes), if any; a mesh has point normals
  bool is_mesh = false;               ///< else a cloud: a vertex a point
  std::string title;                  ///< file name and counts
};

/// Reads a mesh (PLY, OBJ, STL, VTK, VTP with polygons) or else the points of a cloud. Throws AppError that
/// names the file.
Drawing readDrawing(const std::filesystem::path& file);

}  // namespace mlsmesh::apps
