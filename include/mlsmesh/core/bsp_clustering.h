// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/point_set.h"
#include "mlsmesh/parameters.h"

namespace mlsmesh::core {

/// Step 1. Splits the points by a BSP tree until every leaf is small and flat enough; returns the leaves in
/// tree order, the points of each ascending. Every point is in exactly one cluster; points that are all equal
/// stay together. O(n log n) in parallel over subtrees. Throws Failure(Cancelled).
IndexLists clusterPoints(const std::vector<Vec3>& points, const ClusteringParameters& parameters,
                         const Context& context);

}  // namespace mlsmesh::core
