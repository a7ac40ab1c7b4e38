// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/failure.h"
#include "mlsmesh/core/half_edge_mesh.h"
#include "mlsmesh/core/mls_refinement.h"
#include "mlsmesh/core/parallel.h"
#include "mlsmesh/vertex_cloud.h"

#include <pcl/PolygonMesh.h>

#include <string>
#include <utility>
#include <vector>

namespace mlsmesh::detail {

/// A mesh handed to refinement, checked: every used vertex is finite, the triangles are an oriented
/// 2-manifold.
struct InputMesh {
  std::vector<core::Vec3> position;  ///< world
  core::StoredAs stored_as = core::StoredAs::Float;
  std::vector<core::Triangle> triangles;
  std::vector<bool> used;  ///< by a triangle, one entry a vertex
};

[[noreturn]] inline void failMesh(const std::string& what) {
  throw core::Failure(StatusCode::InvalidMesh, what);
}

/// The polygons as triangles over `vertices` vertices. Throws core::Failure(InvalidMesh).
inline std::vector<core::Triangle> trianglesOf(const std::vector<pcl::Vertices>& polygons,
                                               std::size_t vertices, const core::Context& context) {
  core::CancelCheck check(context);
  std::vector<core::Triangle> triangles;
  triangles.reserve(polygons.size());
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    check();
    const pcl::Indices& corners = polygons[i].vertices;
    if (corners.size() != 3) {
      failMesh("input mesh: polygon " + std::to_string(i) + " has " + std::to_string(corners.size()) +
               " corners; triangulate it first");
    }
    for (const auto corner : corners) {
      if (corner < 0 || static_cast<std::size_t>(corner) >= vertices) {
        failMesh("input mesh: polygon " + std::to_string(i) + " names vertex " + std::to_string(corner) +
                 " of " + std::to_string(vertices));
      }
    }
    triangles.push_back({static_cast<core::Index>(corners[0]), static_cast<core::Index>(corners[1]),
                         static_cast<core::Index>(corners[2])});
  }
  return triangles;
}

inline void checkManifold(const InputMesh& mesh, const core::Context& context) {
  core::HalfEdgeMesh half_edges;
  std::string why;
  if (core::buildMesh(static_cast<core::Index>(mesh.position.size()), mesh.triangles, half_edges, &why,
                      context)) {
    why = half_edges.validate(false, context);
  }
  if (!why.empty()) failMesh("input mesh: not an oriented 2-manifold: " + why);
}

/// Reads and checks a mesh. Throws core::Failure: NoMesh for a null mesh or one without polygons,
/// InvalidMesh, Cancelled.
inline InputMesh readMesh(const pcl::PolygonMesh::ConstPtr& input, const core::Context& context) {
  if (!input || input->polygons.empty()) {
    throw core::Failure(StatusCode::NoMesh, "no input mesh with triangles: call setInputMesh first");
  }
  InputMesh mesh;
  try {
    mesh.position = worldPositions(input->cloud, mesh.stored_as, context);
  } catch (const core::Failure& failure) {
    context.checkCancelled();
    failMesh(std::string("input mesh: ") + failure.what());
  }
  mesh.triangles = trianglesOf(input->polygons, mesh.position.size(), context);
  mesh.used.assign(mesh.position.size(), false);
  core::CancelCheck check(context);
  for (const core::Triangle& triangle : mesh.triangles) {
    check();
    for (const core::Index vertex : triangle) {
      if (!mesh.position[vertex].allFinite()) {
        failMesh("input mesh: vertex " + std::to_string(vertex) + " is not finite");
      }
      mesh.used[vertex] = true;
    }
  }
  checkManifold(mesh, context);
  return mesh;
}

/// The mesh as level 0 of a refinement over `surface`, with normals of the surface on the side the triangles
/// face.
inline core::RefinedMesh levelZero(const InputMesh& input, const core::PointSet& points,
                                   const core::MlsSurface& surface, const core::Context& context) {
  const std::size_t count = input.position.size();
  core::RefinedMesh mesh;
  context.checkCancelled();
  mesh.position.assign(count, core::Vec3::Zero());
  mesh.kind.assign(count, core::VertexKind::InputPoint);
  mesh.nearest.assign(count, 0);
  for (std::size_t i = 0; i < count; ++i) {
    const auto vertex = static_cast<core::Index>(i);
    mesh.parents.push_back({vertex, vertex});
    if (input.used[i]) mesh.position[i] = points.stored(input.position[i] - points.origin);
  }
  mesh.normal = core::vertexNormals(input.triangles, mesh.position);
  core::parallelBlocks(context, count, 256, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      if (!input.used[i]) continue;
      const core::Projection projection = surface.project(mesh.position[i]);
      mesh.nearest[i] = projection.nearest;
      if (!projection.normal.allFinite()) continue;
      mesh.normal[i] = projection.normal.dot(mesh.normal[i]) < 0 ? -projection.normal : projection.normal;
    }
  });
  mesh.level_vertices = {static_cast<core::Index>(count)};
  mesh.level_triangles = {input.triangles};
  return mesh;
}

}  // namespace mlsmesh::detail
