// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace mlsmesh::apps {

/// The points and the point data of a legacy VTK file, whatever its data set, as the text of a legacy file of
/// polygons without cells; `content` is the whole file, `file` its name for errors. VTK's reader follows
/// damaged lists of cells out of bounds, and takes points that are cut off for zeros: here cells are stepped
/// over and lengths are checked. Throws AppError if it is another type, holds no points or is cut off.
std::string pointsOfLegacyVtk(const std::string& content, const std::string& file);

/// Throws AppError unless the file is a legacy VTK file of polygons whose lists of cells are whole: as long
/// as announced, and every cell within its list. That their corners are points is not asked.
void checkPolygonsOfLegacyVtk(const std::string& content, const std::string& file);

}  // namespace mlsmesh::apps
