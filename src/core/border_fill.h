// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/half_edge_mesh.h"

namespace mlsmesh::core {

/// A loop is filled if it has at most max_edges edges and a perimeter of at most max_perimeter spacings:
/// those of the whole cloud, or where the cloud is sparser those at the loop.
struct FillLimits {
  int max_edges = 6;
  double max_perimeter = 0;
  double spacing = 1;                                  ///< of the cloud, in the points' unit
  const std::vector<double>* local_spacing = nullptr;  ///< as MlsSurface measures it; null: even everywhere
};

struct FillCount {
  Index loops = 0;
  Index triangles = 0;
};

/// Closes every border loop within the limits that a legal fill exists for: no edge of the mesh used twice,
/// no triangle degenerate or bent back by more than 165 degrees. Loops that pass a vertex twice are cut there
/// first. O(n^3) a loop.
FillCount fillLoops(HalfEdgeMesh& mesh, const std::vector<Vec3>& points, const FillLimits& limits,
                    const Context& context = {});

/// Triangles that close the loop of these border half-edges (in walking order, each vertex once), or none.
/// The fill has the smallest worst dihedral bend, of equals the smallest area.
std::vector<Triangle> fillOf(const HalfEdgeMesh& mesh, const std::vector<Vec3>& points,
                             const std::vector<Index>& loop);

/// Cuts a closed walk of border half-edges where it passes a vertex twice; each part passes its vertices
/// once.
std::vector<std::vector<Index>> simpleLoops(const HalfEdgeMesh& mesh, const std::vector<Index>& loop);

}  // namespace mlsmesh::core
