// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "crease_feet.h"
#include "mlsmesh/core/features.h"

namespace mlsmesh::core {

/// Chooses vertices on the sharp edges, corners first, then marching along the edges, so that no two are
/// closer than `spacing` local spacings. All feet must have sides; foot[i] is that of points[i]. Fills
/// features.vertices and features.vertex_of. `search` is over the cloud.
void chooseCreaseVertices(const std::vector<Index>& points, const std::vector<CreaseFoot>& feet,
                          const std::vector<Vec3>& cloud, const NeighborSearch& search,
                          const RobustNormals& normals, double spacing, const Context& context,
                          Features& features);

}  // namespace mlsmesh::core
