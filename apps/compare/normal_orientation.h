// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "compare/method_input.h"

namespace mlsmesh::apps {

/// Turns normals over until they agree along the minimum spanning tree of the graph that joins each point to
/// its `neighbors` nearest ones, in which an edge costs 1 - |cosine| of its two normals; in each of its parts
/// the highest point (z) looks up. PCL has nothing of the kind. O(n neighbors log n).
///
/// Hoppe, DeRose, Duchamp, McDonald, Stuetzle, Surface reconstruction from unorganized points, SIGGRAPH 1992,
/// section 3.3.
void orientNormals(int neighbors, OrientedCloud& points);

}  // namespace mlsmesh::apps
