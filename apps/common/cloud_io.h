// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/PCLPointCloud2.h>

#include <filesystem>
#include <string>

namespace mlsmesh::apps {

/// The extensions, "pcd, ply, ...": for help and errors.
std::string readableFormats();

/// Throws AppError (kExitUsage) unless the extension is one of a format that readCloud knows.
void checkReadableFormat(const std::filesystem::path& file);

/// Reads the points of a file, of the format its extension names, with all their fields; coordinates that are
/// doubles stay so. The cloud has numeric fields x, y, z and at least one point. Nothing is printed, also not
/// by PCL or VTK. Throws AppError that names the file, what is wrong (absent, empty, cut off, of another
/// type, no x, y, z, ...) and the remedy.
void readCloud(const std::filesystem::path& file, pcl::PCLPointCloud2& cloud);

}  // namespace mlsmesh::apps
