// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "mlsmesh/core/context.h"
#include "mlsmesh/core/half_edge_mesh.h"

namespace mlsmesh::core {

struct SeamCount {
  Index seams = 0;
  Index edges = 0;    ///< border edges along them, on both sides
  double length = 0;  ///< half the length of these edges, in the points' unit
};

/// Seams: where a piece of the mesh was cut open although the surface goes on, because its two sides are
/// oriented against each other there, as on a Moebius band. A border edge belongs to one if another border
/// edge of the same component lies across a gap of at most 3 edge lengths, along the surface, and runs the
/// same way with the opposite normal (across a hole of an oriented surface it runs the opposite way). Rows of
/// fewer than 4 edges, both sides together, are not counted, nor folds of the mesh: the way from side to side
/// over it must be longer than 30 triangles. `normal`: of the surface at the points, unit, sign arbitrary.
/// O(T + B log B) for T triangles and B border edges; one thread, safe to call from several.
SeamCount countSeams(const HalfEdgeMesh& mesh, const std::vector<Vec3>& points,
                     const std::vector<Vec3>& normal, const Context& context = {});

}  // namespace mlsmesh::core
