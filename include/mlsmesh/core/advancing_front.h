// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/context.h"
#include "mlsmesh/core/half_edge_mesh.h"
#include "mlsmesh/parameters.h"

namespace mlsmesh::core {

struct FrontStatistics {
  Index seed_triangles = 0;   ///< loaded from agreed stars, or single seeds
  Index front_triangles = 0;  ///< added by the front
  Index filled_loops = 0;
  Index filled_triangles = 0;
  Index dropped_triangles = 0;  ///< removed at pinched vertices
  Index split_vertices = 0;     ///< pinched vertices that were duplicated (only if allowed)
  Index unused_points = 0;
};

struct Triangulation {
  std::vector<Triangle> triangles;     ///< oriented; outward on closed components
  std::vector<Index> duplicate_of;     ///< vertex n + i is a copy of point duplicate_of[i]
  FrontStatistics statistics;
};

/// Step 3: an oriented 2-manifold over `points` (no two equal). `normals` (unit, sign arbitrary) may be null: then the
/// neighbours' principal components serve. `spacing` is the unit of fill_max_perimeter. Pinched vertices are resolved by
/// dropping their smaller fans, or, with `may_split`, by duplicating the point. Throws Failure(NoTriangles).
Triangulation triangulate(const std::vector<Vec3>& points, const std::vector<Vec3>* normals, double spacing,
                          bool may_split, const TriangulationParameters& parameters, const Context& context);

}  // namespace mlsmesh::core
