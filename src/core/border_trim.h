// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "mlsmesh/core/half_edge_mesh.h"

namespace mlsmesh::core {

/// Takes flaps off the borders: obtuse triangles that stand up from the surface, as the normals at all three
/// corners tell. Three points in a row along a border span such triangles: their plane is that of the row's
/// curve, not of the surface. Only triangles whose removal leaves one triangle less and nothing else are
/// removed, one behind the other until none is left: no vertex loses its last triangle, and components,
/// border loops and handles stay as they are. `normal`: of the surface at the points, unit, sign arbitrary.
/// Returns how many were removed. O(border edges + removed) for bounded degrees. The result depends on the
/// mesh and its numbering alone.
Index trimFlaps(HalfEdgeMesh& mesh, const std::vector<Vec3>& points, const std::vector<Vec3>& normal,
                const Context& context = {});

}  // namespace mlsmesh::core
