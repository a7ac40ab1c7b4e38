// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "known_neighbors.h"
#include "surroundings.h"

namespace mlsmesh::core {

/// Step 3 and what belongs to it: triangulates the representatives, with smaller clusters where there was
/// trouble; turns edges to sharp ones; moves borders to the rim of the cloud. Leaves level 0 in result.mesh,
/// with the clusters of its vertices. Warns of seams. Throws Failure(NoTriangles, Cancelled). `neighbors` may
/// know those of the representatives.
void makeLevelZero(const Surroundings& cloud, Context& context, KnownNeighbors neighbors,
                   Reconstruction& result);

/// Patches over the holes that are to be closed; their vertices have no points. Warns of holes that stay
/// open.
void closeHolesOf(const Surroundings& cloud, Context& context, Reconstruction& result);

}  // namespace mlsmesh::core
