// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/types.h"

namespace mlsmesh::core {

/// The coordinate axis that the triangle is seen largest along.
int widestAxis(const Vec3& a, const Vec3& b, const Vec3& c);

/// Whether two triangles, neither of them degenerate, meet anywhere outside of the corner or edge that they
/// share; touching counts. Corners at equal positions are shared; triangles that share all three do not meet.
/// `axis` is the widest of the first. Exact.
bool trianglesMeet(const std::vector<Vec3>& position, const Triangle& first, const Triangle& second,
                   int axis);

/// Whether the triangles have two corners or more at equal positions that are not the same vertices: an edge
/// of one lies on one of the other, and is none that they share.
bool doubleAnEdge(const std::vector<Vec3>& position, const Triangle& first, const Triangle& second);

}  // namespace mlsmesh::core
