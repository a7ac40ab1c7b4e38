// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/PCLPointCloud2.h>

#include <string>

namespace mlsmesh::apps {

// Readers of point clouds in text, from the whole content of a file; `file` is its name for errors. Numbers
// are read as doubles, in the C locale; see coordinateColumns() for the type they are stored as. Both throw
// AppError that names file, line and text of the first line that cannot be read.

/// One point a line, numbers separated by blanks, commas or semicolons, all lines with the same number of
/// columns: x y z, then, with 4 columns, intensity; with 6, red green blue if all are whole numbers 0 .. 255
/// and some exceed 1, otherwise the normal; with 7, intensity red green blue; further columns are kept as
/// column_4, column_5, ... The first line may be a heading or, as in .pts files, the number of points. Lines
/// that start with '#' or '//' are skipped.
void readXyz(const std::string& content, const std::string& file, pcl::PCLPointCloud2& cloud);

/// The "v" lines of a Wavefront OBJ file, with colour if they carry it. PCL's reader rounds coordinates to
/// float32 and drops the colour; normals and faces are not needed, all normals are computed anew.
void readObj(const std::string& content, const std::string& file, pcl::PCLPointCloud2& cloud);

}  // namespace mlsmesh::apps
