// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/types.h"

#include <cstdint>
#include <vector>

namespace mlsmesh::apps {

/// A mesh as a file has it: polygons of any number of corners, which need not be vertices.
struct PolygonSoup {
  std::vector<core::Vec3> vertices;
  std::vector<std::int64_t> corners;  ///< of all polygons, from 0
  std::vector<std::size_t> ends;      ///< of each polygon, where the next one begins in `corners`

  /// Ends the polygon whose corners were appended since the last one ended.
  void endPolygon() { ends.push_back(corners.size()); }
  std::size_t polygonCount() const { return ends.size(); }
};

}  // namespace mlsmesh::apps
