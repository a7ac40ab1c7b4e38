// SPDX-License-Identifier: BSD-3-Clause
#include "clouds/soundness.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <exception>

#include "mlsmesh/core/failure.h"
#include "mlsmesh/core/half_edge_mesh.h"
#include "mlsmesh/mesh_topology.h"

namespace mlsmesh::test {

using core::Index;
using core::Reconstruction;
using core::RefinedMesh;
using core::Triangle;
using core::Vec3;

namespace {

std::string counted(const char* what, std::int64_t count) {
  return count == 0 ? "" : std::to_string(count) + " " + what;
}

std::string faultOfTopology(const MeshTopology& found) {
  std::string fault = counted("non-manifold edges", found.nonmanifold_edges);
  if (fault.empty()) fault = counted("non-manifold vertices", found.nonmanifold_vertices);
  if (fault.empty()) fault = counted("orientation conflicts", found.orientation_conflicts);
  if (fault.empty()) fault = counted("degenerate faces", found.degenerate_faces);
  if (fault.empty()) fault = counted("duplicate faces", found.duplicate_faces);
  if (fault.empty() && found.triangles == 0) fault = "no triangle";
  return fault;
}

std::string faultOfHalfEdges(Index vertices, const std::vector<Triangle>& triangles) {
  core::HalfEdgeMesh mesh;
  std::string why;
  return buildMesh(vertices, triangles, mesh, &why) ? mesh.validate() : why;
}

std::string faultOfReport(const MeshReport& report, const MeshTopology& found) {
  if (report.vertices != found.vertices || report.triangles != found.triangles)
    return "wrong counts reported";
  if (report.border_loops != found.border_loops || report.euler != found.euler)
    return "wrong topology reported";
  if (!report.isSound()) return "reported unsound";
  return report.self_intersections ? "" : "self-intersections not counted";
}

std::string faultOfLevel(const Reconstruction& result, std::size_t level, const MeshTopology& coarsest) {
  const RefinedMesh& mesh = result.mesh;
  const std::vector<Triangle>& triangles = mesh.level_triangles[level];
  const Index vertices = mesh.level_vertices[level];
  if (vertices > static_cast<Index>(mesh.position.size())) return "fewer positions than vertices";
  const MeshTopology found =
      meshTopology({mesh.position.begin(), mesh.position.begin() + vertices}, triangles);
  std::string fault = faultOfTopology(found);
  if (fault.empty()) fault = counted("isolated vertices", found.isolated_vertices);
  if (fault.empty()) fault = faultOfHalfEdges(vertices, triangles);
  if (fault.empty()) fault = faultOfReport(result.reports[level], found);
  if (!fault.empty()) return fault;
  if (found.euler != coarsest.euler || found.border_loops != coarsest.border_loops)
    return "another topology than level 0";
  return "";
}

std::string faultOfVertices(const Reconstruction& result) {
  constexpr double kUnit = 1e-9;
  const RefinedMesh& mesh = result.mesh;
  for (std::size_t v = 0; v < mesh.position.size(); ++v) {
    const Vec3& position = mesh.position[v];
    if (!position.allFinite()) return "a position that is not finite";
    if (result.points.stored(position) != position) return "a position that storing changes";
    const double length = mesh.normal[v].norm();
    if (!(std::abs(length - 1) < kUnit || length == 0)) return "a normal that is no unit vector";
    if (mesh.nearest[v] < 0 || mesh.nearest[v] >= result.points.size()) return "a nearest point that is none";
  }
  return "";
}

std::string faultOfCounts(const Reconstruction& result) {
  const RefinedMesh& mesh = result.mesh;
  const std::size_t vertices = mesh.position.size(), levels = mesh.level_vertices.size();
  if (levels == 0 || mesh.level_triangles.size() != levels || result.reports.size() != levels)
    return "levels that do not match";
  if (mesh.normal.size() != vertices || mesh.kind.size() != vertices || mesh.nearest.size() != vertices ||
      mesh.parents.size() != vertices || mesh.level_vertices.back() != static_cast<Index>(vertices))
    return "vertex data of another length";
  for (std::size_t level = 1; level < levels; ++level)
    if (mesh.level_vertices[level] < mesh.level_vertices[level - 1]) return "a level that is no prefix";
  return "";
}

bool mayRefuse(StatusCode code, bool is_empty) {
  if (is_empty) return code == StatusCode::EmptyInput;
  return code == StatusCode::TooFewPoints || code == StatusCode::DegenerateInput ||
         code == StatusCode::NoTriangles;
}

void look(const Reconstruction& result, Outcome& outcome) {
  outcome.fault = faultOf(result);
  outcome.triangles = static_cast<Index>(result.mesh.level_triangles.back().size());
  for (const MeshReport& report : result.reports)
    outcome.self_intersections = std::max(outcome.self_intersections, report.self_intersections.value_or(0));
}

}  // namespace

std::string faultOf(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles) {
  const std::string fault = faultOfTopology(meshTopology(vertices, triangles));
  return fault.empty() ? faultOfHalfEdges(static_cast<Index>(vertices.size()), triangles) : fault;
}

std::string faultOf(const Reconstruction& result) {
  std::string fault = faultOfCounts(result);
  if (fault.empty()) fault = faultOfVertices(result);
  if (!fault.empty()) return fault;
  const Index vertices = result.mesh.level_vertices[0];
  const MeshTopology coarsest =
      meshTopology({result.mesh.position.begin(), result.mesh.position.begin() + vertices},
                   result.mesh.level_triangles[0]);
  for (std::size_t level = 0; level < result.reports.size(); ++level) {
    fault = faultOfLevel(result, level, coarsest);
    if (!fault.empty()) return "level " + std::to_string(level) + ": " + fault;
  }
  return "";
}

Outcome outcomeOf(const std::vector<Vec3>& world, core::StoredAs stored_as,
                  const MultiresolutionParameters& parameters, core::Context& context) {
  Outcome outcome;
  const std::clock_t start = std::clock();
  const auto time = [&] {
    outcome.seconds = static_cast<double>(std::clock() - start) / static_cast<double>(CLOCKS_PER_SEC);
  };
  try {
    const Reconstruction result =
        reconstruct(makePointSet(world, stored_as, nullptr, context), nullptr, parameters, context);
    time();
    look(result, outcome);
  } catch (const core::Failure& failure) {
    time();
    outcome.code = failure.code();
    if (!mayRefuse(outcome.code, world.empty()))
      outcome.fault = std::string(name(outcome.code)) + ": " + failure.what();
  } catch (const std::exception& error) {
    time();
    outcome.code = StatusCode::Internal;
    outcome.fault = error.what();
  }
  return outcome;
}

Outcome outcomeOf(const std::vector<Vec3>& world, core::StoredAs stored_as,
                  const MultiresolutionParameters& parameters) {
  core::Context context;
  context.threads = 1;
  return outcomeOf(world, stored_as, parameters, context);
}

}  // namespace mlsmesh::test
