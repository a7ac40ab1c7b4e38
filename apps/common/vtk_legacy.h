// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/cloud_columns.h"
#include "common/polygon_soup.h"

#include <string>
#include <vector>

namespace mlsmesh::apps {

// Legacy VTK files, from their whole content; `file` is the name for errors. By hand: VTK's reader follows
// damaged lists out of bounds, makes arrays as long as a header claims, crashes over text that is not a
// number (NaN is none to it), and takes what is cut off for zeros. Both throw AppError if it is another type,
// holds no points, or anything that is wanted of it is cut off or no number.

/// The points and the point data of any data set that lists its points. Point data end at the first attribute
/// that is not numbers.
std::vector<CloudColumn> cloudOfLegacyVtk(const std::string& content, const std::string& file);

/// The points, polygons and strips of triangles (taken apart) of a data set of polygons. Whether corners are
/// points is not asked.
PolygonSoup meshOfLegacyVtk(const std::string& content, const std::string& file);

}  // namespace mlsmesh::apps
