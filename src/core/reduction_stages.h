// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "known_neighbors.h"
#include "surroundings.h"

namespace mlsmesh::core {

/// The stages of step 1 and 2 that lead from the cloud to representatives and their clusters, in this order.
/// They read the parameters of result.noise. Throw Failure(Cancelled).

/// Clusters and their representatives; smaller clusters than asked where a small cloud would leave too few of
/// them to carry a surface (a warning).
void clusterAndReduce(const Surroundings& cloud, Context& context, Reconstruction& result);

/// The points themselves in the place of representatives.
void useThePoints(const Surroundings& cloud, Reconstruction& result);

/// Takes out the points that belong to no surface, and reduces the rest again where that changes anything.
void removeOutliers(Context& context, Surroundings& cloud, KnownNeighbors& neighbors, Reconstruction& result);

/// More representatives where sheets are near each other.
void divideBetweenSheets(const Surroundings& cloud, const Context& context, Reconstruction& result);

/// Looks for sharp edges in a clean cloud, and reduces again where there are some.
void keepFeatures(const Surroundings& cloud, const Context& context, Reconstruction& result);

}  // namespace mlsmesh::core
