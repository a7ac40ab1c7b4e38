// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mlsmesh/core/context.h"
#include "mlsmesh/core/types.h"

namespace mlsmesh {

/// An edge by its ends, in the direction in which its (first) triangle runs it.
using MeshEdge = std::array<core::Index, 2>;

/// What is wrong with a triangle soup, and where: the things that MeshTopology counts. Faces by their place
/// in the list of triangles, all ascending.
struct MeshDefects {
  std::vector<MeshEdge> nonmanifold_edges;        ///< with three triangles or more
  std::vector<core::Index> nonmanifold_vertices;  ///< with more than one fan, or at a non-manifold edge
  std::vector<MeshEdge> orientation_conflicts;    ///< run in the same direction by both of two triangles
  std::vector<core::Index> degenerate_faces;      ///< a repeated or absent corner, or collinear ones
  std::vector<core::Index> duplicate_faces;       ///< with the three vertices of an earlier face
  std::vector<core::Index> crossing_faces;        ///< in a pair that meets outside of what it shares
  std::int64_t self_intersections = 0;            ///< such pairs

  bool empty() const {
    return nonmanifold_edges.empty() && nonmanifold_vertices.empty() && orientation_conflicts.empty() &&
           degenerate_faces.empty() && duplicate_faces.empty() && crossing_faces.empty();
  }
};

/// Lists what meshTopology() and countSelfIntersections() count. O(n log n). Throws core::Failure:
/// IndexOverflow, Cancelled.
MeshDefects findDefects(const std::vector<core::Vec3>& vertices, const std::vector<core::Triangle>& triangles,
                        const core::Context& context);

/// Edges of one triangle around a hole or an outline, as if the mesh were cut open at pinches.
struct BorderEdges {
  std::vector<MeshEdge> edges;  ///< in no particular order
  double length = 0;
  bool is_loop = true;  ///< else a chain: it ends on edges of three triangles or more
};

/// The borders that MeshTopology::borders measures, longest first. O(n log n). Throws
/// core::Failure(IndexOverflow).
std::vector<BorderEdges> findBorders(const std::vector<core::Vec3>& vertices,
                                     const std::vector<core::Triangle>& triangles);

}  // namespace mlsmesh
