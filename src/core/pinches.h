// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/half_edge_mesh.h"

namespace mlsmesh::core {

struct PinchCount {
  Index dropped_triangles = 0;
  Index split_vertices = 0;
};

/// Leaves one fan at every vertex. Fans of at most `largest_dropped` triangles beside a larger one go, one
/// pinch after the other in vertex order, until none is left to drop; what remains is split with
/// `duplicate_of` told, or, where that is null, dropped whatever its size. Dropping opens holes: fill
/// afterwards.
PinchCount resolvePinches(HalfEdgeMesh& mesh, Index largest_dropped, std::vector<Index>* duplicate_of,
                          const Context& context = {});

}  // namespace mlsmesh::core
