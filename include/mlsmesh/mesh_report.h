// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "mlsmesh/core/context.h"
#include "mlsmesh/core/types.h"

namespace mlsmesh {

/// Topology of a triangle soup, and whether it crosses itself, counted without trusting who made it.
struct MeshReport {
  core::Index vertices = 0;  ///< all, used or not
  core::Index triangles = 0;
  core::Index isolated_vertices = 0;      ///< in no triangle
  core::Index components = 0;             ///< connected through shared edges
  core::Index border_loops = 0;           ///< as if cut at pinches; a chain that ends on a non-manifold edge is none
  core::Index border_edges = 0;           ///< with one triangle
  core::Index nonmanifold_edges = 0;      ///< with three or more triangles
  core::Index nonmanifold_vertices = 0;   ///< with more than one fan, or at a non-manifold edge
  core::Index orientation_conflicts = 0;  ///< two-triangle edges run in the same direction by both
  core::Index degenerate_faces = 0;       ///< a repeated vertex, not finite, or exactly collinear in doubles
  core::Index duplicate_faces = 0;        ///< with the three vertices of an earlier face, in any order
  core::Index euler = 0;                  ///< V - E + F of the used vertices
  std::optional<int> genus;               ///< of all components, loops capped; none unless an oriented manifold
  /// Pairs of triangles that meet outside of the corner or edge that they share (core/self_intersections.h), those
  /// with collinear corners left out; none unless asked for.
  std::optional<std::int64_t> self_intersections;

  bool isManifold() const { return nonmanifold_edges == 0 && nonmanifold_vertices == 0; }
  bool isSound() const {
    return isManifold() && orientation_conflicts == 0 && degenerate_faces == 0 && duplicate_faces == 0;
  }
};

/// Counts in O(n log n). Faces with a repeated index, or one out of [0, vertices), are counted as degenerate and left out of
/// all else; collinear faces and duplicates stay in. Throws core::Failure(IndexOverflow) beyond 2^31 - 1 half-edges.
MeshReport reportMesh(const std::vector<core::Vec3>& vertices, const std::vector<core::Triangle>& triangles);
/// The same on the context's threads. Also throws core::Failure(Cancelled).
MeshReport reportTopology(const std::vector<core::Vec3>& vertices,
                          const std::vector<core::Triangle>& triangles, const core::Context& context);
/// The same with self_intersections, on the context's threads: exact, in O(n log n) where triangles do not pile up in
/// one place. Also throws core::Failure(Cancelled).
MeshReport reportMesh(const std::vector<core::Vec3>& vertices, const std::vector<core::Triangle>& triangles,
                      const core::Context& context);

}  // namespace mlsmesh
