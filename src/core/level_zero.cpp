// SPDX-License-Identifier: BSD-3-Clause
#include "level_zero.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "border_smoothing.h"
#include "mlsmesh/core/failure.h"
#include "mlsmesh/core/self_intersections.h"
#include "reduction_stages.h"
#include "side_flips.h"
#include "troubled_places.h"

namespace mlsmesh::core {
namespace {

// Level 0: the vertices that a triangle uses, in the order of the representatives, copies of split ones last.
void storeLevelZero(Triangulation triangulation, const Context& context, Reconstruction& result) {
  CancelCheck check(context);
  const Representatives& all = result.representatives;
  const Index originals = all.size();
  const Index total = originals + static_cast<Index>(triangulation.duplicate_of.size());
  std::vector<Index> vertex_of(static_cast<std::size_t>(total), kNone);
  for (const Triangle& t : triangulation.triangles) {
    for (const Index v : t) vertex_of[v] = 0;
  }
  RefinedMesh& mesh = result.mesh;
  IndexLists members;
  members.items.reserve(result.clusters.items.size());
  members.begin.reserve(static_cast<std::size_t>(total) + 1);
  mesh.position.reserve(static_cast<std::size_t>(total));
  for (Index v = 0; v < total; ++v) {
    check();
    if (vertex_of[v] == kNone) continue;
    vertex_of[v] = static_cast<Index>(mesh.position.size());
    const Index from = v < originals ? v : triangulation.duplicate_of[v - originals];
    result.representative_of.push_back(from);
    mesh.position.push_back(all.position[from]);
    mesh.kind.push_back(all.kind[from]);
    mesh.nearest.push_back(all.nearest[from]);
    mesh.parents.push_back({vertex_of[v], vertex_of[v]});
    members.append(result.clusters.data(from), result.clusters.size(from));
  }
  result.clusters = std::move(members);
  context.checkCancelled();
  std::vector<Triangle> triangles = std::move(triangulation.triangles);
  for (Triangle& t : triangles) {
    for (Index& v : t) v = vertex_of[v];
  }
  mesh.normal = vertexNormals(triangles, mesh.position);
  context.checkCancelled();
  for (std::size_t v = 0; v < mesh.position.size() && !all.normal.empty(); ++v) {
    const Vec3& fitted = all.normal[result.representative_of[v]];
    mesh.normal[v] = fitted.dot(mesh.normal[v]) < 0 ? Vec3(-fitted) : fitted;
  }
  mesh.level_triangles.push_back(std::move(triangles));
  const std::optional<HealingStatistics>& healing = triangulation.statistics.healing;
  mesh.level_intersections.push_back(healing ? std::optional(healing->intersections) : std::nullopt);
  mesh.level_vertices.push_back(static_cast<Index>(mesh.position.size()));
}

// The normals of the surface at the vertices of level 0; none away from sharp edges.
std::vector<VertexSides> vertexSides(const Reconstruction& result) {
  const RefinedMesh& mesh = result.mesh;
  std::vector<VertexSides> sides(mesh.position.size());
  for (std::size_t v = 0; v < sides.size(); ++v) {
    const Index crease = result.representatives.crease[result.representative_of[v]];
    if (crease != kNone) {
      sides[v] = {result.features.vertices[crease].side_normal, result.features.vertices[crease].sides};
    } else {
      sides[v].normal[0] = result.representatives.normal[result.representative_of[v]];
      sides[v].count = 1;
    }
  }
  return sides;
}

HalfEdgeMesh levelZero(const RefinedMesh& mesh, const Context& context) {
  HalfEdgeMesh level;
  std::string why;
  if (!buildMesh(static_cast<Index>(mesh.position.size()), mesh.level_triangles[0], level, &why, context)) {
    throw Failure(StatusCode::Internal, "the triangulation is not a manifold: " + why);
  }
  return level;
}

// Flips edges to the sides of sharp edges. Where triangles then meet that should not, edges stay.
void turnToSides(const Context& context, Reconstruction& result) {
  constexpr int kRounds = 4;
  RefinedMesh& mesh = result.mesh;
  std::vector<VertexSides> sides = vertexSides(result);
  for (int round = 0; round < kRounds; ++round) {
    HalfEdgeMesh level = levelZero(mesh, context);
    if (flipToSides(level, mesh.position, sides) == 0) return;
    std::vector<Triangle> triangles = level.triangles();
    const auto pairs = SelfIntersections(mesh.position, triangles, context, &level).all();
    const auto count = static_cast<std::int64_t>(pairs.size());
    if (count <= mesh.level_intersections[0].value_or(0)) {
      mesh.level_triangles[0] = std::move(triangles);
      mesh.level_intersections[0] = count;
      return;
    }
    for (const TrianglePair& pair : pairs) {
      for (const Index t : pair) {
        for (const Index v : triangles[t]) sides[v].count = 0;
      }
    }
  }
}

void warnOfSeams(const FrontStatistics& front, Context& context) {
  if (front.seams == 0) return;
  context.warnings.push_back(
      "the cloud is one-sided or contradictory: it was cut open (seams: " + std::to_string(front.seams) +
      ", edges along them: " + std::to_string(front.seam_edges) + ")");
}

// Borders move to the rim of the cloud where its points are where they were measured, and borders are to
// stay: patches go on better from the triangles of the representatives.
void moveBorders(const Surroundings& cloud, const Context& context, Reconstruction& result) {
  const MultiresolutionParameters& parameters = result.noise.parameters;
  const bool stay = parameters.refinement.smooth_borders && !parameters.watertight;
  if (!parameters.reduce || !stay || result.noise.passes > 0) return;
  smoothBorders(cloud.points, cloud.surface(), result.clusters, context, result.mesh);
}

Triangulation triangulateRepresentatives(const std::vector<Vec3>& points, const NeighborSearch& search,
                                         const Context& context, KnownNeighbors& neighbors,
                                         const Reconstruction& result) {
  const Representatives& all = result.representatives;
  const bool reduced = result.noise.parameters.reduce;
  TriangulationInput input{reduced ? all.position : points};
  input.spacing = result.spacing;
  input.may_split = true;
  if (reduced) {
    input.neighbors = &neighbors.of(all.position, result.noise.parameters.triangulation.neighbors, context);
    input.normals = &all.normal;
    input.cloud_spacing = &all.spacing;
    input.cloud = &search;
    input.cloud_points = &points;
    input.cloud_nearest = &all.nearest;
  } else {
    input.search = &search;
  }
  return triangulate(input, result.noise.parameters.triangulation, context);
}

// What is left to wish for: fewer are better.
Index faultsOf(const Triangulation& triangulation) {
  constexpr Index kHandle = 10;  // as bad as so many troubled vertices
  const HealingStatistics& healing = *triangulation.statistics.healing;
  return static_cast<Index>(triangulation.troubled.size()) + healing.opened_places +
         kHandle * healing.handles;
}

// Triangulates again, with smaller clusters where there was trouble, as long as that leaves less of it.
void refineTroubledPlaces(const Surroundings& cloud, Context& context, KnownNeighbors& neighbors,
                          Reconstruction& result, Triangulation& triangulation) {
  constexpr int kRounds = 2;
  const MultiresolutionParameters& parameters = result.noise.parameters;
  const bool may_refine = parameters.reduce && parameters.triangulation.heal && !result.features.any() &&
                          result.noise.passes == 0;
  for (int round = 0; may_refine && round < kRounds && !triangulation.troubled.empty(); ++round) {
    const std::vector<char> marked = aroundTrouble(triangulation, result.representatives.size());
    IndexLists clusters = result.clusters;
    Representatives representatives = result.representatives;
    reduceDivided(marked,
                  finerClusters(cloud.points.position, clusters, marked, parameters.clustering, context),
                  cloud.points, cloud.surface(), parameters.reduction, context, representatives, clusters);
    if (result.noise.drops_crowded) dropCrowded(representatives, clusters, context);
    std::swap(representatives, result.representatives);
    std::swap(clusters, result.clusters);
    Triangulation finer =
        triangulateRepresentatives(cloud.points.position, cloud.search(), context, neighbors, result);
    if (faultsOf(finer) >= faultsOf(triangulation)) {
      std::swap(representatives, result.representatives);
      std::swap(clusters, result.clusters);
      return;
    }
    triangulation = std::move(finer);
  }
}

}  // namespace

void makeLevelZero(const Surroundings& cloud, Context& context, KnownNeighbors neighbors,
                   Reconstruction& result) {
  Triangulation triangulation =
      triangulateRepresentatives(cloud.points.position, cloud.search(), context, neighbors, result);
  refineTroubledPlaces(cloud, context, neighbors, result, triangulation);
  if (!result.noise.parameters.reduce) useThePoints(cloud, result);
  result.front = triangulation.statistics;
  warnOfSeams(result.front, context);
  storeLevelZero(std::move(triangulation), context, result);
  if (result.features.any()) turnToSides(context, result);
  moveBorders(cloud, context, result);
}

void closeHolesOf(const Surroundings& cloud, Context& context, Reconstruction& result) {
  const MultiresolutionParameters& parameters = result.noise.parameters;
  const double longest =
      parameters.watertight ? std::numeric_limits<double>::infinity() : parameters.hole_size * result.spacing;
  std::vector<Index> source;
  result.patches = closeHoles(cloud.points, cloud.search(), longest, context, result.mesh, source);
  for (const Index vertex : source) {
    result.representative_of.push_back(result.representative_of[vertex]);
    result.clusters.begin.push_back(result.clusters.begin.back());
  }
  if (result.patches.open_loops > 0) {
    context.warnings.push_back("holes that stay open, because no patch over them keeps clear of the mesh: " +
                               std::to_string(result.patches.open_loops));
  }
}

}  // namespace mlsmesh::core
