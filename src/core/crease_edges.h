// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "crease_feet.h"
#include "mlsmesh/core/features.h"
#include "mlsmesh/core/mls_refinement.h"

namespace mlsmesh::core {

/// Which edges of a mesh run along sharp edges of the surface or beside them, and where their midpoints
/// belong. Holds references. Const and thread-safe.
class CreaseEdges {
 public:
  CreaseEdges(const Features& features, const MlsSurface& surface, const HalfEdgeMesh& mesh,
              const RefinedMesh& refined)
      : features_(features), surface_(surface), mesh_(mesh), refined_(refined) {}

  /// An interior edge with an end near a sharp edge.
  bool isNear(Index half_edge) const;
  /// Of those, one along a sharp edge: both ends are on it, and its triangles are bent.
  bool isAlong(Index half_edge) const;
  /// Unit mean normal of the two triangles (zero where they cancel).
  Vec3 meanNormal(Index half_edge) const;
  /// Psi of the midpoint, from the points of the side with this normal.
  Projection onSide(const Vec3& middle, const Vec3& normal) const;
  /// Of an edge along a sharp one: the place beside its midpoint where the two sides meet; false where they
  /// do not, or too far away.
  bool onCrease(Index half_edge, Projection& projection) const;

 private:
  Vec3 normalOf(Index half_edge) const;
  bool isOnCrease(Index vertex) const;
  bool isInZone(Index vertex) const;

  const Features& features_;
  const MlsSurface& surface_;
  const HalfEdgeMesh& mesh_;
  const RefinedMesh& refined_;
};

}  // namespace mlsmesh::core
