// SPDX-License-Identifier: BSD-3-Clause
#include "mlsmesh/mesh_report.h"

#include <atomic>
#include <limits>
#include <numeric>

#include "core/exact_predicates.h"
#include "edge_table.h"
#include "mlsmesh/core/failure.h"
#include "mlsmesh/core/half_edge_mesh.h"
#include "mlsmesh/core/parallel.h"
#include "mlsmesh/core/self_intersections.h"
#include "mlsmesh/mesh_topology.h"

namespace mlsmesh {

namespace {

using core::Index;
using core::kNone;
using core::Triangle;
using core::Vec3;

/// Sums count(first, last) over blocks of [0, size), on the context's threads.
template <typename Count>
Index sumOverBlocks(const core::Context& context, std::size_t size, const Count& count) {
  constexpr std::size_t kBlock = 1 << 14;
  std::vector<Index> sums((size + kBlock - 1) / kBlock, 0);
  core::parallelBlocks(context, size, kBlock, [&](std::size_t first, std::size_t last) {
    sums[first / kBlock] = count(static_cast<Index>(first), static_cast<Index>(last));
  });
  return std::accumulate(sums.begin(), sums.end(), Index{0});
}

/// Counts faces that are degenerate; returns whether the corners of all are three different vertices.
bool countDegenerate(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles,
                     const core::Context& context, MeshReport& report) {
  std::atomic<bool> all_valid{true};
  report.degenerate_faces = sumOverBlocks(context, triangles.size(), [&](Index first, Index last) {
    Index degenerate = 0;
    for (Index t = first; t < last; ++t) {
      const Triangle& face = triangles[t];
      const bool valid = hasThreeCorners(face, report.vertices);
      if (!valid) all_valid = false;
      degenerate += !valid || core::areCollinear(vertices[face[0]], vertices[face[1]], vertices[face[2]]);
    }
    return degenerate;
  });
  return all_valid;
}

/// The topology of faces of which no two run an edge in the same direction, nor three share one; false, and
/// nothing is counted, of others.
bool countOriented(const std::vector<Triangle>& faces, const core::Context& context, MeshReport& report) {
  core::HalfEdgeMesh mesh(report.vertices);
  if (!mesh.assignTriangles(faces, context)) return false;
  const auto vertices = static_cast<std::size_t>(report.vertices);
  report.isolated_vertices = sumOverBlocks(context, vertices, [&](Index first, Index last) {
    Index isolated = 0;
    for (Index v = first; v < last; ++v) isolated += !mesh.isUsed(v);
    return isolated;
  });
  report.nonmanifold_vertices = sumOverBlocks(context, vertices, [&](Index first, Index last) {
    Index pinched = 0;
    for (Index v = first; v < last; ++v) pinched += mesh.fanCount(v) > 1;
    return pinched;
  });
  report.border_edges = sumOverBlocks(context, 3 * faces.size(), [&](Index first, Index last) {
    Index border = 0;
    for (Index h = first; h < last; ++h) border += mesh.isBorder(h);
    return border;
  });
  report.duplicate_faces = sumOverBlocks(context, faces.size(), [&](Index first, Index last) {
    Index duplicate = 0;
    for (Index t = first; t < last; ++t) {
      const Index other = mesh.twin(3 * t);
      duplicate += other != kNone && other < 3 * t && mesh.opposite(other) == mesh.opposite(3 * t);
    }
    return duplicate;
  });
  if (report.border_edges > 0) report.border_loops = static_cast<Index>(mesh.borderLoopEdges(context).size());
  mesh.components(&report.components, context);
  const Index face_count = mesh.triangleCount();
  const Index edges = (3 * face_count + report.border_edges) / 2;
  report.euler = report.vertices - report.isolated_vertices - edges + face_count;
  return true;
}

/// The topology of any faces.
void countSoup(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles,
               MeshReport& report) {
  const MeshTopology topology = meshTopology(vertices, triangles);
  report.isolated_vertices = topology.isolated_vertices;
  report.components = topology.edge_components;
  report.border_loops = topology.border_loops;
  report.border_edges = topology.border_edges;
  report.nonmanifold_edges = topology.nonmanifold_edges;
  report.nonmanifold_vertices = topology.nonmanifold_vertices;
  report.orientation_conflicts = topology.orientation_conflicts;
  report.duplicate_faces = topology.duplicate_faces;
  report.euler = topology.euler;
}

}  // namespace

MeshReport reportTopology(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles,
                          const core::Context& context) {
  constexpr std::size_t most = std::numeric_limits<Index>::max();
  if (vertices.size() > most || triangles.size() > most / 3)
    throw core::Failure(StatusCode::IndexOverflow,
                        "the mesh has more half-edges than 32-bit indices can name");
  MeshReport report;
  report.vertices = static_cast<Index>(vertices.size());
  report.triangles = static_cast<Index>(triangles.size());
  const bool all_valid = countDegenerate(vertices, triangles, context, report);
  if (!all_valid || !countOriented(triangles, context, report)) countSoup(vertices, triangles, report);
  if (report.components > 0 && report.isManifold() && report.orientation_conflicts == 0)
    report.genus = (2 * report.components - report.euler - report.border_loops) / 2;
  return report;
}

MeshReport reportMesh(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles) {
  return reportTopology(vertices, triangles, {});
}

MeshReport reportMesh(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles,
                      const core::Context& context) {
  MeshReport report = reportTopology(vertices, triangles, context);
  const std::vector<Triangle> faces = facesWithThreeCorners(triangles, report.vertices);
  report.self_intersections = core::SelfIntersections(vertices, faces, context).count();
  return report;
}

}  // namespace mlsmesh
