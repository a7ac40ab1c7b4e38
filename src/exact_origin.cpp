// SPDX-License-Identifier: BSD-3-Clause
#include "exact_origin.h"

#include <algorithm>
#include <cmath>

namespace mlsmesh {

namespace {

using core::Vec3;

/// Per axis, a value to subtract from every coordinate of them without rounding error, that brings them near
/// to 0: the middle, where all are within half and double of it (Sterbenz), else 0.
Vec3 exactOrigin(const std::vector<Vec3>& positions) {
  Eigen::AlignedBox3d box;
  for (const Vec3& position : positions)
    if (position.allFinite()) box.extend(position);
  Vec3 origin = Vec3::Zero();
  if (box.isEmpty()) return origin;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = box.min()[axis], high = box.max()[axis], middle = low + (high - low) / 2;
    const double nearest = std::min(std::abs(low), std::abs(high));
    const double farthest = std::max(std::abs(low), std::abs(high));
    const bool is_exact =
        low * high > 0 && nearest >= std::abs(middle) / 2 && farthest / 2 <= std::abs(middle);
    if (is_exact) origin[axis] = middle;
  }
  return origin;
}

}  // namespace

std::vector<Vec3> movedNearOrigin(std::vector<Vec3> positions) {
  const Vec3 origin = exactOrigin(positions);
  for (Vec3& position : positions) position -= origin;
  return positions;
}

}  // namespace mlsmesh
