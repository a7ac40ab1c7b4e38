// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/point_set.h"
#include "mlsmesh/parameters.h"

namespace mlsmesh::core {

/// Step 1. Splits the points by a BSP tree until every leaf is small and flat enough; returns the leaves in tree order,
/// the points of each ascending. Every point is in exactly one cluster. `spacing` is the cloud's (for max_width).
/// O(n log n); recursion depth O(log n) for v3, bounded by n for v1.
IndexLists clusterPoints(const std::vector<Vec3>& points, double spacing, const ClusteringParameters& parameters,
                         const Context& context);

}  // namespace mlsmesh::core
