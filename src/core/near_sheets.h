// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <optional>

#include "mlsmesh/core/types.h"

namespace mlsmesh::core {

/// Between two planes.
struct Slab {
  Vec3 axis = Vec3::UnitZ();  ///< unit
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  double gap = std::numeric_limits<double>::infinity();  ///< from the sheet inside to the nearest outside

  bool contains(const Vec3& p) const {
    const double height = axis.dot(p);
    return low < height && height < high;
  }
};

/// Whether these points lie on sheets with clear air between them: then the slab of the sheet that the first
/// point is on, bounded half-way to its neighbours. Air is clear that is `least_gap` wide and four times the
/// scatter of the sheet. None where the first point's part is no flat sheet (fewer than six points, or on a
/// line). Works whatever the sheets' distance is to the width of the neighbourhood. O(count log count).
std::optional<Slab> sheetOfFirst(const std::vector<Vec3>& points, const Index* neighbors, int count,
                                 double least_gap);

}  // namespace mlsmesh::core
