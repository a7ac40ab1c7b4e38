// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/mls_reduction.h"

namespace mlsmesh::core {

/// Neighbours of every representative that dropOutliers reads.
constexpr int kOutlierNeighbors = 12;

/// Drops representatives of points that belong to no surface, and their clusters: those not linked to others,
/// small floating groups, and larger groups that are both far sparser than the main one and spread in all
/// directions. Two representatives are linked if their distance is within a few local spacings of the cloud
/// at *both*, so that a test for density is never needed and gradients of density stay linked. Returns the
/// points of the dropped clusters, ascending. Of `neighbors`, those of the representatives, kOutlierNeighbors
/// each are read. O(n log n).
std::vector<Index> dropOutliers(const OutlierParameters& parameters, const NeighborTable& neighbors,
                                Representatives& representatives, IndexLists& clusters);

/// Points off the surface below them, ascending: farther from the tangent plane of their cluster's
/// representative than most, or in a cluster too uneven for that test, and then farther than 0.75 local
/// spacings and six times the median residual from a surface fitted without them. One pass over the points;
/// fits for those suspect.
std::vector<Index> strayPoints(const std::vector<Vec3>& points, const MlsSurface& surface,
                               const Representatives& representatives, const IndexLists& clusters,
                               const Context& context);

/// Takes the points `removed` (ascending; their positions beside them) out of the clusters and gives the rest
/// the numbers that they have without these. Clusters left empty go, with their representatives. Returns for
/// each remaining one whether its fit, of so many neighbours, may have seen a removed point, and so has to be
/// made again. At least one point must be removed. O(n log r) for r removed points.
std::vector<char> forgetMembers(const std::vector<Index>& removed, const std::vector<Vec3>& removed_position,
                                int neighbors, Representatives& representatives, IndexLists& clusters);

}  // namespace mlsmesh::core
