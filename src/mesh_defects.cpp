// SPDX-License-Identifier: BSD-3-Clause
#include "mlsmesh/mesh_defects.h"

#include <algorithm>
#include <numeric>

#include "core/exact_predicates.h"
#include "edge_table.h"
#include "exact_origin.h"
#include "mlsmesh/core/self_intersections.h"
#include "soup_fans.h"

namespace mlsmesh {

namespace {

using core::DisjointSets;
using core::Index;
using core::Triangle;
using core::Vec3;

/// Places of the faces that have three corners.
std::vector<Index> usableFaces(const std::vector<Triangle>& triangles, Index vertices) {
  std::vector<Index> usable;
  for (std::size_t f = 0; f < triangles.size(); ++f)
    if (hasThreeCorners(triangles[f], vertices)) usable.push_back(static_cast<Index>(f));
  return usable;
}

std::vector<Index> degenerateFaces(const std::vector<Vec3>& vertices,
                                   const std::vector<Triangle>& triangles) {
  std::vector<Index> found;
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    const Triangle& face = triangles[f];
    if (!hasThreeCorners(face, static_cast<Index>(vertices.size())) ||
        core::areCollinear(vertices[face[0]], vertices[face[1]], vertices[face[2]]))
      found.push_back(static_cast<Index>(f));
  }
  return found;
}

std::vector<Index> duplicateFaces(const std::vector<Triangle>& triangles, std::vector<Index> usable) {
  const auto cornersOf = [&](Index face) {
    Triangle corners = triangles[face];
    std::sort(corners.begin(), corners.end());
    return corners;
  };
  std::stable_sort(usable.begin(), usable.end(),
                   [&](Index a, Index b) { return cornersOf(a) < cornersOf(b); });
  std::vector<Index> found;
  for (std::size_t i = 1; i < usable.size(); ++i)
    if (cornersOf(usable[i - 1]) == cornersOf(usable[i])) found.push_back(usable[i]);
  std::sort(found.begin(), found.end());
  return found;
}

MeshEdge edgeAt(const EdgeTable& edges, Index edge) {
  const Index h = edges.halfEdge(edge, 0);
  return {edges.origin(h), edges.target(h)};
}

void findFaultyEdges(const EdgeTable& edges, MeshDefects& defects) {
  for (Index edge = 0; edge < edges.edgeCount(); ++edge) {
    const Index faces = edges.facesAt(edge);
    if (faces > 2) defects.nonmanifold_edges.push_back(edgeAt(edges, edge));
    if (faces == 2 && edges.isConflict(edge)) defects.orientation_conflicts.push_back(edgeAt(edges, edge));
  }
}

void findFaultyVertices(const EdgeTable& edges, MeshDefects& defects) {
  DisjointSets fans = joinFans(edges);
  const std::vector<VertexFault> faults = vertexFaults(edges, fans);
  for (std::size_t v = 0; v < faults.size(); ++v)
    if (faults[v] != VertexFault::None) defects.nonmanifold_vertices.push_back(static_cast<Index>(v));
}

void findCrossings(const std::vector<Vec3>& vertices, const std::vector<Triangle>& faces,
                   const std::vector<Index>& place, const core::Context& context, MeshDefects& defects) {
  const std::vector<Vec3> positions = movedNearOrigin(vertices);
  const std::vector<core::TrianglePair> pairs = core::SelfIntersections(positions, faces, context).all();
  defects.self_intersections = static_cast<std::int64_t>(pairs.size());
  for (const core::TrianglePair& pair : pairs)
    for (const Index face : pair) defects.crossing_faces.push_back(place[face]);
  std::sort(defects.crossing_faces.begin(), defects.crossing_faces.end());
  defects.crossing_faces.erase(std::unique(defects.crossing_faces.begin(), defects.crossing_faces.end()),
                               defects.crossing_faces.end());
}

}  // namespace

MeshDefects findDefects(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles,
                        const core::Context& context) {
  const auto count = static_cast<Index>(vertices.size());
  MeshDefects defects;
  defects.degenerate_faces = degenerateFaces(vertices, triangles);
  const std::vector<Index> usable = usableFaces(triangles, count);
  defects.duplicate_faces = duplicateFaces(triangles, usable);
  const std::vector<Triangle> faces = facesWithThreeCorners(triangles, count);
  const EdgeTable edges(count, faces);
  findFaultyEdges(edges, defects);
  findFaultyVertices(edges, defects);
  findCrossings(vertices, faces, usable, context, defects);
  return defects;
}

std::vector<BorderEdges> findBorders(const std::vector<Vec3>& vertices,
                                     const std::vector<Triangle>& triangles) {
  const auto count = static_cast<Index>(vertices.size());
  const EdgeTable edges(count, facesWithThreeCorners(triangles, count));
  DisjointSets fans = joinFans(edges);
  std::vector<char> is_open;
  DisjointSets joined = joinBorderEdges(edges, fans, is_open);
  std::vector<BorderEdges> borders;
  std::vector<Index> border_of(edges.edgeCount(), core::kNone);
  for (Index edge = 0; edge < edges.edgeCount(); ++edge) {
    if (edges.facesAt(edge) != 1) continue;
    const Index leader = joined.leader(edge);
    if (border_of[leader] == core::kNone) {
      border_of[leader] = static_cast<Index>(borders.size());
      borders.emplace_back();
      borders.back().is_loop = is_open[leader] == 0;
    }
    BorderEdges& border = borders[border_of[leader]];
    border.edges.push_back(edgeAt(edges, edge));
    border.length += (vertices[border.edges.back()[1]] - vertices[border.edges.back()[0]]).norm();
  }
  std::stable_sort(borders.begin(), borders.end(),
                   [](const BorderEdges& a, const BorderEdges& b) { return a.length > b.length; });
  return borders;
}

}  // namespace mlsmesh
