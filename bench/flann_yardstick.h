// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "mlsmesh/core/types.h"

namespace mlsmesh::bench {

/// The yardstick of everything that looks at each point: builds FLANN's KDTreeSingleIndex (doubles, leaves of
/// 15 points, reordered) and asks it once for the k nearest of every point, in the order given, on one
/// thread, keeping nothing. Returns the sum of the k-th squared distances, so that no compiler can leave the
/// work out.
double flannTreeAndNearest(const std::vector<core::Vec3>& points, int k);

}  // namespace mlsmesh::bench
