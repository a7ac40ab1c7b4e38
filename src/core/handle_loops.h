// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/half_edge_mesh.h"

namespace mlsmesh::core {

/// Short closed walks along edges that do not divide the surface they lie on, with its border loops capped:
/// round or through a handle. Each is a list of vertices, each joined to the next and the last to the first,
/// no vertex twice. Of every vertex at a handle, the shortest such walk of at most `max_edges` edges through
/// it; of walks that are near one another the one with the fewest edges, of equals the shortest. Empty for
/// surfaces without handles. `mesh` must have no pinches. O(n), and O(d^(max_edges / 2)) for each vertex at a
/// handle, d the degree.
std::vector<std::vector<Index>> shortHandleLoops(const HalfEdgeMesh& mesh, const std::vector<Vec3>& position,
                                                 int max_edges, const Context& context = {});

}  // namespace mlsmesh::core
