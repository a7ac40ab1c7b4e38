// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/mls_reduction.h"

namespace mlsmesh::core {

/// Drops representatives of points that belong to no surface, and their clusters: those not linked to others,
/// small floating groups, and larger groups that are both far sparser than the main one and spread in all
/// directions. Two representatives are linked if their distance is within a few local spacings of the cloud
/// at *both*, so that a test for density is never needed and gradients of density stay linked. Returns the
/// points of the dropped clusters, ascending. O(n log n).
std::vector<Index> dropOutliers(const OutlierParameters& parameters, Representatives& representatives,
                                IndexLists& clusters, const Context& context);

/// Points off the surface that their cluster's representative lies on: farther from its tangent plane than
/// most, and strays by MlsSurface::isStray. Ascending. One pass over the points; a fit for the few that are
/// suspect.
std::vector<Index> strayPoints(const std::vector<Vec3>& points, const MlsSurface& surface,
                               const Representatives& representatives, const IndexLists& clusters,
                               const Context& context);

}  // namespace mlsmesh::core
