// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>

#include "mlsmesh/core/advancing_front.h"
#include "mlsmesh/core/features.h"
#include "mlsmesh/core/hole_patches.h"
#include "mlsmesh/core/mls_reduction.h"
#include "mlsmesh/core/mls_refinement.h"
#include "mlsmesh/core/neighbor_search.h"
#include "mlsmesh/core/noise.h"
#include "mlsmesh/mesh_report.h"

namespace mlsmesh::core {

struct StageTime {
  std::string name;
  double seconds = 0;
};

/// All that the four steps made of a cloud.
struct Reconstruction {
  PointSet points;
  double spacing = 0;     ///< of the cloud
  NoiseAdaptation noise;  ///< what was estimated and what it changed
  IndexLists clusters;    ///< members (points) of each level-0 vertex's cluster; none on patches
  Features features;      ///< sharp edges of the cloud
  Representatives representatives;
  RefinedMesh mesh;  ///< every vertex of a level is used by one of its triangles
  /// representative of each level-0 vertex; of one on a patch, that of the vertex nearest on its rim
  std::vector<Index> representative_of;
  Index outliers = 0;  ///< points of the set in clusters that were dropped because they belong to no surface
  FrontStatistics front;
  PatchCount patches;               ///< over holes, if any were to be closed
  std::vector<MeshReport> reports;  ///< one a level
  /// search, noise, denoising (where it was needed), reduction, outliers, features, triangulation, holes
  /// (where they are to be closed), refinement 1 .. n, report
  std::vector<StageTime> stages;
};

/// Runs the four steps. `search` may be null: a k-d tree is built; otherwise it is called with the
/// ordered points of the set and returns the search to use (the adapter of a user's pcl::search::Search).
/// Every vertex of the result is used by a triangle. Throws Failure.
using SearchFactory = std::function<std::unique_ptr<NeighborSearch>(const PointSet&)>;
Reconstruction reconstruct(PointSet points, const SearchFactory& search,
                           const MultiresolutionParameters& parameters, Context& context);

}  // namespace mlsmesh::core
