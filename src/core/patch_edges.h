// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/half_edge_mesh.h"
#include "mlsmesh/core/mls_surface.h"

namespace mlsmesh::core {

/// Which edges of a mesh lie on patches over holes, where there is no cloud to refine them by. Holds
/// references. Const and thread-safe.
class PatchEdges {
 public:
  PatchEdges(const HalfEdgeMesh& mesh, const std::vector<VertexKind>& kinds) : mesh_(mesh), kinds_(kinds) {}

  /// On a patch: an end is a vertex of one, or both triangles are on one.
  bool isInside(Index half_edge) const {
    return isPatch(mesh_.origin(half_edge)) || isPatch(mesh_.target(half_edge)) ||
           (beyond(half_edge) && !mesh_.isBorder(half_edge) && beyond(mesh_.twin(half_edge)));
  }
  /// Where a patch meets the mesh: one triangle is on it.
  bool isRim(Index half_edge) const {
    return !mesh_.isBorder(half_edge) && !isInside(half_edge) &&
           (beyond(half_edge) || beyond(mesh_.twin(half_edge)));
  }
  /// Whether turning the edge inside its two triangles leaves the patches' rims, and what is on them, alone.
  bool mayFlip(Index half_edge) const {
    const bool ends = isPatch(mesh_.origin(half_edge)) || isPatch(mesh_.target(half_edge));
    const bool apices = beyond(half_edge) || beyond(mesh_.twin(half_edge));
    return ends == apices;
  }

 private:
  bool isPatch(Index vertex) const { return kinds_[vertex] == VertexKind::Patch; }
  bool beyond(Index half_edge) const { return isPatch(mesh_.opposite(half_edge)); }

  const HalfEdgeMesh& mesh_;
  const std::vector<VertexKind>& kinds_;
};

}  // namespace mlsmesh::core
