// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/types.h"

#include <array>
#include <vector>

namespace mlsmesh::apps {

/// Edges worth marking, as pairs of vertices: what the counts of mlsmesh/mesh_topology.h are of.
struct EdgeMarks {
  using Edge = std::array<core::Index, 2>;
  std::vector<Edge> border;
  std::vector<Edge> nonmanifold;
  std::vector<Edge> misoriented;
};

/// Corners must be vertices; faces with a repeated one have no edges. O(n log n).
EdgeMarks markEdges(const std::vector<core::Triangle>& triangles);

}  // namespace mlsmesh::apps
