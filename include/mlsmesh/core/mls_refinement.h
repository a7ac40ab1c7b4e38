// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "mlsmesh/core/features.h"
#include "mlsmesh/core/half_edge_mesh.h"
#include "mlsmesh/core/mls_surface.h"
#include "mlsmesh/core/point_set.h"

namespace mlsmesh::core {

/// A mesh in levels: level i uses the first level_vertices[i] vertices and the triangles level_triangles[i].
struct RefinedMesh {
  std::vector<Vec3> position;  ///< local, rounded to the stored type
  std::vector<Vec3> normal;    ///< unit, on the side the triangles are oriented to
  std::vector<VertexKind> kind;
  std::vector<Index> nearest;  ///< point of the set nearest to the vertex
  std::vector<std::array<Index, 2>>
      parents;  ///< ends of the edge a vertex was made on; {v, v} for those of level 0
  std::vector<Index> level_vertices;
  std::vector<std::vector<Triangle>> level_triangles;
  /// Pairs of triangles of a level that meet where they should not (self_intersections.h), where counted: at
  /// every level that addLevel made.
  std::vector<std::optional<std::int64_t>> level_intersections;
  /// Inner edges that the finest level has from the one before, because their midpoints already lie on the
  /// surface: they are not tested again. Pairs of vertices, the lower first, ascending.
  std::vector<std::array<Index, 2>> flat_edges;

  Index levelCount() const { return static_cast<Index>(level_vertices.size()); }
};

/// Step 4: adds one level to `mesh`, whose finest level must be an oriented 2-manifold. `spacing` is the
/// cloud's. The vertices of the level before stay where they are. Near sharp edges (features), edges are
/// refined on their side of the surface, and those along one where the sides meet. Edges on patches
/// (VertexKind::Patch) are left whole, those on their rims treated as border edges. Throws
/// Failure(InvalidMesh, Cancelled).
void addLevel(const PointSet& points, const MlsSurface& surface, double spacing,
              const RefinementParameters& parameters, const Context& context, RefinedMesh& mesh,
              const Features& features = {});

/// Adds parameters.levels levels.
void refineMesh(const PointSet& points, const MlsSurface& surface, double spacing,
                const RefinementParameters& parameters, const Context& context, RefinedMesh& mesh);

/// Unit normals of the vertices: the area-weighted mean of the triangles around each, zero where they cancel
/// or are none.
std::vector<Vec3> vertexNormals(const std::vector<Triangle>& triangles, const std::vector<Vec3>& position);

}  // namespace mlsmesh::core
