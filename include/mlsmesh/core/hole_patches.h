// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/mls_refinement.h"

namespace mlsmesh::core {

/// What became of the border loops that were to be closed.
struct PatchCount {
  Index closed_loops = 0;
  Index open_loops = 0;  ///< no patch was found that keeps clear of the mesh and of itself
  Index triangles = 0;
  Index vertices = 0;
};

/// Closes every border loop of level 0 (the only one that `mesh` has) that is at most `longest` around with a
/// patch. It has about the edge lengths of its surroundings and lies on a surface that carries on their
/// shape; where that would meet the mesh, on one nearer to a membrane, or on a cushion that rises off its
/// rim; and over the only border of a sheet without handles at last on the sheet's back. No pair of
/// intersecting triangles comes into being, by the positions as they are stored; a loop for which nothing
/// fits stays. Triangles on a rim that are bent back by more than 80 degrees may be taken off where no patch
/// fits beside them; all else of the mesh stays as it is. The patches' own vertices (VertexKind::Patch) come
/// last, and `source` is told of each a vertex on the border of its hole, the nearest along edges. A
/// component that is closed by it faces outward, if need be by turning it. `search` is over the cloud. O(n
/// log n) in the mesh, about O(m^1.5) in the vertices of a patch. Throws Failure(InvalidMesh, Cancelled).
PatchCount closeHoles(const PointSet& points, const NeighborSearch& search, double longest,
                      const Context& context, RefinedMesh& mesh, std::vector<Index>& source);

}  // namespace mlsmesh::core
