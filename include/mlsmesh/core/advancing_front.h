// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "mlsmesh/core/context.h"
#include "mlsmesh/core/half_edge_mesh.h"
#include "mlsmesh/core/neighbor_search.h"
#include "mlsmesh/parameters.h"

namespace mlsmesh::core {

/// What was mended once the front had come to its end.
struct HealingStatistics {
  Index repaired_places = 0;       ///< where triangles met that should not, and were made anew
  Index opened_places = 0;         ///< where that did not help, and one of them was taken out
  Index cut_handles = 0;           ///< false ones
  Index handles = 0;               ///< genus of all components that is left
  Index filled_loops = 0;          ///< where the cloud has points
  std::int64_t intersections = 0;  ///< pairs of triangles that still meet
};

struct FrontStatistics {
  Index seed_triangles = 0;   ///< loaded from agreed stars, or single seeds
  Index front_triangles = 0;  ///< added by the front
  Index filled_loops = 0;
  Index filled_triangles = 0;
  Index dropped_triangles = 0;  ///< removed at pinched vertices, and flaps on borders
  Index split_vertices = 0;     ///< pinched vertices that were duplicated (only if allowed)
  Index unused_points = 0;
  Index seams = 0;       ///< cuts across which the surface goes on, but its orientation does not
  Index seam_edges = 0;  ///< border edges along them, on both sides
  std::optional<HealingStatistics> healing;  ///< none if nothing was looked for
};

/// What is triangulated. Only `points` must be given; all that is referred to must outlive the call.
struct TriangulationInput {
  const std::vector<Vec3>& points;         ///< no two equal
  const NeighborSearch* search = nullptr;  ///< over the points; null: a k-d tree of its own
  const std::vector<Vec3>* normals =
      nullptr;  ///< unit, sign arbitrary; null: the neighbours' principal components serve
  /// With `normals`, if at hand: the parameters.neighbors nearest others of every point. Saves the search.
  const NeighborTable* neighbors = nullptr;
  /// For representatives of a cloud: its local spacing d_k / sqrt(k / pi) at every point, and the search over
  /// it. Null: the points are the cloud.
  const std::vector<double>* cloud_spacing = nullptr;
  const NeighborSearch* cloud = nullptr;
  /// With `cloud`, if at hand: its points, and of each of `points` the one nearest to it. Saves searches.
  const std::vector<Vec3>* cloud_points = nullptr;
  const std::vector<Index>* cloud_nearest = nullptr;
  double spacing = 0;      ///< of the cloud, the unit of fill_max_perimeter, > 0
  bool may_split = false;  ///< pinched vertices may be duplicated
};

struct Triangulation {
  std::vector<Triangle> triangles;  ///< oriented; outward on closed components
  std::vector<Index> duplicate_of;  ///< vertex n + i is a copy of point duplicate_of[i]
  /// Points, or copies, where the mesh met itself, a false handle was cut, or a loop near the cloud's points
  /// would not close: they may be too sparse there. Ascending.
  std::vector<Index> troubled;
  FrontStatistics statistics;
};

/// Step 3: an oriented 2-manifold over the points. Pinched vertices are resolved by dropping their smaller
/// fans, or, with may_split, by duplicating the point. Throws Failure(NoTriangles, Cancelled). O(n log n).
Triangulation triangulate(const TriangulationInput& input, const TriangulationParameters& parameters,
                          const Context& context);

}  // namespace mlsmesh::core
