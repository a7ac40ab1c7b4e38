// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/PCLPointCloud2.h>
#include <pcl/PolygonMesh.h>

#include <filesystem>

namespace mlsmesh::apps {

// Clouds and meshes through VTK's own readers and writers: PCL's conversions between its clouds and VTK's
// data round coordinates to float32, and its writer of .vtk text gives five digits and no colour. What VTK
// prints is kept off stderr.

/// Points and point data of a legacy file (any data set with points). Throws AppError.
void readVtk(const std::filesystem::path& file, pcl::PCLPointCloud2& cloud);
/// The same of an XML file of polygons.
void readVtp(const std::filesystem::path& file, pcl::PCLPointCloud2& cloud);

/// Legacy (binary, version 4.2, which older programs read as well), XML, and binary STL. The triangles, and
/// for the first two all fields of the vertices: colour as "Colors", normals as "Normals", others by name.
/// False if the disk is full or the like.
bool writeVtk(const std::filesystem::path& file, const pcl::PolygonMesh& mesh);
bool writeVtp(const std::filesystem::path& file, const pcl::PolygonMesh& mesh);
bool writeStl(const std::filesystem::path& file, const pcl::PolygonMesh& mesh);

}  // namespace mlsmesh::apps
