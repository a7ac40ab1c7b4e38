// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "mlsmesh/core/context.h"
#include "mlsmesh/core/types.h"

namespace mlsmesh {

/// A part of a soup whose triangles are connected through shared vertices.
struct ComponentTopology {
  core::Index vertices = 0;  ///< in at least one triangle
  core::Index edges = 0;
  core::Index triangles = 0;
  core::Index border_edges = 0;
  core::Index border_loops = 0;
  core::Index border_chains = 0;
  core::Index nonmanifold_edges = 0;
  core::Index nonmanifold_vertices = 0;
  core::Index orientation_conflicts = 0;
  bool orientable = true;  ///< turning triangles over could cure all conflicts
  double area = 0;
  double volume =
      0;  ///< signed, positive inside out-facing triangles; means something if closed and oriented

  core::Index euler() const { return vertices - edges + triangles; }
  bool isManifold() const { return nonmanifold_edges == 0 && nonmanifold_vertices == 0; }
  bool isClosed() const { return border_edges == 0 && nonmanifold_edges == 0; }
  /// Closed, coherently oriented, and its triangles face inwards.
  bool isInward() const { return isClosed() && orientation_conflicts == 0 && volume < 0; }
  /// With border loops capped; none unless an orientable manifold.
  std::optional<core::Index> genus() const;
};

/// Border edges one after the other around a hole or an outline, as if the mesh were cut open at pinches.
struct Border {
  core::Index component = 0;  ///< place in MeshTopology::components
  core::Index edges = 0;
  double length = 0;
  bool is_loop = true;  ///< else a chain: it ends on edges of three triangles or more
};

/// Topology of a triangle soup, whole and by component, counted without trusting who made it.
struct MeshTopology {
  core::Index vertices = 0;  ///< all, used or not
  core::Index triangles = 0;
  core::Index edges = 0;
  core::Index isolated_vertices = 0;      ///< in no triangle
  core::Index coincident_vertices = 0;    ///< at exactly the position of an earlier one
  core::Index degenerate_faces = 0;       ///< a repeated vertex, not finite, or exactly collinear in doubles
  core::Index duplicate_faces = 0;        ///< with the three vertices of an earlier face, in any order
  core::Index border_edges = 0;           ///< with one triangle
  core::Index nonmanifold_edges = 0;      ///< with three or more triangles
  core::Index nonmanifold_vertices = 0;   ///< with more than one fan, or at a non-manifold edge
  core::Index bow_tie_vertices = 0;       ///< of these, those at no non-manifold edge
  core::Index orientation_conflicts = 0;  ///< two-triangle edges run in the same direction by both
  core::Index border_loops = 0;
  core::Index border_chains = 0;
  core::Index edge_components = 0;  ///< connected through shared edges
  core::Index closed_components = 0;
  core::Index inward_components = 0;
  core::Index euler = 0;             ///< V - E + F of the used vertices
  bool orientable = true;            ///< all components
  std::optional<core::Index> genus;  ///< of all components; none unless each has one, and there is one
  std::vector<ComponentTopology> components;  ///< most triangles first
  std::vector<Border> borders;                ///< loops and chains, longest first

  bool isManifold() const { return !components.empty() && nonmanifold_edges + nonmanifold_vertices == 0; }
  bool isClosed() const { return !components.empty() && border_edges == 0; }
};

/// Faces with a repeated index, or one out of [0, vertices), are counted as degenerate and left out of all
/// else; collinear faces and duplicates stay in. Lengths, areas and volumes are finite if the positions are.
/// On what both count, it agrees with reportMesh(), but for components, genus (here of orientable components,
/// too, that are not oriented). O(n log n). Throws core::Failure(IndexOverflow) beyond 2^31 - 1 half-edges.
MeshTopology meshTopology(const std::vector<core::Vec3>& vertices,
                          const std::vector<core::Triangle>& triangles);

/// Pairs of triangles that meet outside of the corner or edge that they share (core/self_intersections.h).
/// Faces with a repeated index, or one out of range, take no part. Far from the origin the positions are
/// moved there first where that takes no rounding. Throws core::Failure(Cancelled).
std::int64_t countSelfIntersections(const std::vector<core::Vec3>& vertices,
                                    const std::vector<core::Triangle>& triangles,
                                    const core::Context& context);

}  // namespace mlsmesh
