// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cloud_support.h"
#include "mlsmesh/core/advancing_front.h"

namespace mlsmesh::core {

/// What healMesh reads beside the mesh.
struct HealingInput {
  const std::vector<Vec3>& points;   ///< one a vertex of the mesh
  const std::vector<Vec3>& normals;  ///< of the surface at the points: unit, sign arbitrary
  const CloudSupport& support;
};

struct Healing {
  HealingStatistics statistics;
  std::vector<Index> troubled;  ///< vertices where there was something to mend, or still is; ascending
};

/// Mends a mesh without pinches, place by place; a change that does not help is taken back, and none makes
/// more border loops, handles or components, but for the last resort. In this order:
/// - border loops are filled where the cloud has points near all of the fill and the fill meets nothing;
/// - triangles that meet where they should not go, with up to three rings around them, and what that opens is
///   closed again; where that does not help, they go and leave a hole;
/// - handles that a short walk goes round are cut, where the triangles that close the cut lie more along the
///   surface than those that went.
/// O(n log n) to look, and little for each place. Throws Failure(Cancelled).
Healing healMesh(HalfEdgeMesh& mesh, const HealingInput& input, const TriangulationParameters& parameters,
                 const Context& context);

}  // namespace mlsmesh::core
