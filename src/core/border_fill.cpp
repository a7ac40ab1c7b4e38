// SPDX-License-Identifier: BSD-3-Clause
// This work is based on G. Barequet, M. Sharir, "Filling gaps in the boundary of a polyhedron", 1995, and P.
// Liepa, "Filling holes in meshes", SGP 2003. Departure: only small loops are filled here.
#include "border_fill.h"

#include <algorithm>

#include "polygon_fill.h"

namespace mlsmesh::core {
namespace {

constexpr double kWorstBend = 165.0 * 3.14159265358979323846 / 180.0;

// Of nearest neighbours at the loop; the local spacing is one over the root of the density, twice that of
// random points.
double spacingAt(const HalfEdgeMesh& mesh, const std::vector<Index>& loop, const FillLimits& limits) {
  if (!limits.local_spacing) return limits.spacing;
  double sum = 0;
  for (const Index h : loop) sum += (*limits.local_spacing)[mesh.origin(h)];
  return std::max(limits.spacing, 0.5 * sum / static_cast<double>(loop.size()));
}

bool isSmall(const HalfEdgeMesh& mesh, const std::vector<Vec3>& points, const std::vector<Index>& loop,
             const FillLimits& limits) {
  if (static_cast<int>(loop.size()) > limits.max_edges) return false;
  double perimeter = 0;
  for (const Index h : loop) perimeter += (points[mesh.target(h)] - points[mesh.origin(h)]).norm();
  return perimeter <= limits.max_perimeter * spacingAt(mesh, loop, limits);
}

}  // namespace

std::vector<std::vector<Index>> simpleLoops(const HalfEdgeMesh& mesh, const std::vector<Index>& loop) {
  std::vector<std::vector<Index>> parts;
  std::vector<Index> open;
  for (const Index h : loop) {
    const auto seen =
        std::find_if(open.begin(), open.end(), [&](Index g) { return mesh.origin(g) == mesh.origin(h); });
    if (seen != open.end()) {
      parts.emplace_back(seen, open.end());
      open.erase(seen, open.end());
    }
    open.push_back(h);
  }
  if (!open.empty()) parts.push_back(std::move(open));
  return parts;
}

std::vector<Triangle> fillOf(const HalfEdgeMesh& mesh, const std::vector<Vec3>& points,
                             const std::vector<Index>& loop) {
  return fillPolygon(mesh, points, polygonOf(mesh, loop), {kWorstBend, false});
}

FillCount fillLoops(HalfEdgeMesh& mesh, const std::vector<Vec3>& points, const FillLimits& limits,
                    const Context& context) {
  constexpr int kSlack = 4;  // a loop may be longer than the limit before it is cut at repeated vertices
  FillCount count;
  CancelCheck check(context);
  for (const std::vector<Index>& walk : mesh.borderLoopEdges(context)) {
    check();
    if (static_cast<int>(walk.size()) > kSlack * limits.max_edges) continue;
    for (const std::vector<Index>& loop : simpleLoops(mesh, walk)) {
      if (!isSmall(mesh, points, loop, limits)) continue;
      const std::vector<Triangle> fill = fillOf(mesh, points, loop);
      for (const auto& [a, b, c] : fill) mesh.addTriangle(a, b, c);
      count.loops += fill.empty() ? 0 : 1;
      count.triangles += static_cast<Index>(fill.size());
    }
  }
  return count;
}

}  // namespace mlsmesh::core
