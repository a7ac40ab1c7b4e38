// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>

namespace mlsmesh::apps {

// What PCL's and VTK's readers take on trust: that a file is of the type its name says, that its header makes
// sense, and that the file is long enough for what the header announces (they allocate by the header, and
// read garbage, or crash). Each throws AppError that names the file, the fault and the remedy.

/// Returns the bytes that its points take in memory.
std::uintmax_t checkPcdHeader(const std::filesystem::path& file);
/// Also refuses the vertex properties that pcl::PLYReader misplaces: lists, and colours not in the order red,
/// green, blue (, alpha). Returns the number of vertices announced.
std::size_t checkPlyHeader(const std::filesystem::path& file);
/// Binary STL must be as long as its count of triangles says; text is only asked to begin and end as such.
void checkStlLength(const std::filesystem::path& file);
/// VTK's XML format (.vtp).
void checkVtpHeader(const std::filesystem::path& file);

}  // namespace mlsmesh::apps
