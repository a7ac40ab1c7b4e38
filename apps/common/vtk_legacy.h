// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace mlsmesh::apps {

/// The points and the point data of a legacy VTK file, whatever its data set, as the text of a legacy file of
/// polygons without cells; `content` is the whole file, `file` its name for errors. VTK's reader follows
/// damaged lists of cells out of bounds, and takes points that are cut off for zeros: here cells are stepped
/// over and lengths are checked. Throws AppError if it is another type, holds no points or is cut off.
std::string pointsOfLegacyVtk(const std::string& content, const std::string& file);

/// The points, polygons and strips of triangles of a legacy VTK file of polygons, as the text of a file
/// without the rest. Every list is whole: as long as announced, of numbers, and in the older layout of cells
/// within their list. That where cells begin (in the newer layout) and corners make sense is not asked.
/// Throws AppError.
std::string polygonsOfLegacyVtk(const std::string& content, const std::string& file);

}  // namespace mlsmesh::apps
