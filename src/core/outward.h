// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/half_edge_mesh.h"

namespace mlsmesh::core {

/// Whether the volume under the triangles, seen from the mean of their corners, is negative: a closed surface
/// then faces inwards. There must be a triangle. O(n).
bool isInsideOut(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles);

/// Turns every component of the mesh that is inside out. O(n).
void orientOutward(const std::vector<Vec3>& points, HalfEdgeMesh& mesh, const Context& context = {});

}  // namespace mlsmesh::core
