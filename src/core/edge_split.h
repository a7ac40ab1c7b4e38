// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/half_edge_mesh.h"
#include "mlsmesh/core/mls_surface.h"
#include "mlsmesh/core/point_set.h"

namespace mlsmesh::core {

/// An edge of the mesh that is refined, and where its new vertex goes.
struct SplitEdge {
  Index half_edge = kNone;  ///< the one of lower number
  bool marked = false;
  Vec3 midpoint;  ///< rounded to the stored type
  Vec3 position;  ///< of the new vertex, rounded to the stored type
  Vec3 normal;    ///< unit, on the mesh's side
  Index nearest = kNone;
  VertexKind kind = VertexKind::Projected;
};

/// Rounds a local position to the type it is stored in.
using Rounding = const PointSet&;

/// Triangles of the next level: every marked edge k gets vertex first_new + (its rank among the marked
/// edges). Divides each triangle by template (1-2, 1-3, 1-4, the quad of 1-3 along its shorter diagonal).
/// With `fold_angle` >= 0 (degrees) a child that turns farther from its parent, or is degenerate, pulls its
/// new vertices half-way to their midpoints, twice, then onto them, and at last unmarks the edges; with a
/// negative one only degenerate children do. `edge_of` gives the number of each half-edge's edge. Changes
/// position, kind and marked of the edges.
std::vector<Triangle> splitByTemplates(const HalfEdgeMesh& mesh, const std::vector<Vec3>& position,
                                       const std::vector<Index>& edge_of, double fold_angle,
                                       Rounding rounding, const Context& context,
                                       std::vector<SplitEdge>& edges);

/// The same, one edge after the other in their order, as printed: a triangle is divided when its turn comes,
/// unless one that it would give is degenerate (or turned, see fold_angle), or its shortest edge is below
/// min_edge_ratio of its longest.
std::vector<Triangle> splitOneByOne(const HalfEdgeMesh& mesh, const std::vector<Vec3>& position,
                                    double min_edge_ratio, double fold_angle, Rounding rounding,
                                    std::vector<SplitEdge>& edges);

}  // namespace mlsmesh::core
