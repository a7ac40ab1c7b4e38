// SPDX-License-Identifier: BSD-3-Clause
// This work is based on B. Mederos, L. Velho, L. H. de Figueiredo, "Moving least squares multiresolution
// surface approximation", SIBGRAPI 2003, section 2.4. Departures (defaults): an edge is split by the
// displacement of its midpoint along the normal, because the printed alpha measures the bias of the
// neighbours' mean, which never vanishes; a new vertex stays within half an edge of its midpoint; on a border
// it moves along the normal, and in the surface to a smooth curve through the border's vertices, but for
// corners. Patches over holes are left as they are, but for their rims, which are refined as borders.
#include "mlsmesh/core/mls_refinement.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "border_smoothing.h"
#include "crease_edges.h"
#include "edge_flips.h"
#include "edge_split.h"
#include "intersection_guard.h"
#include "mlsmesh/core/failure.h"
#include "mlsmesh/core/parallel.h"
#include "mlsmesh/core/self_intersections.h"
#include "overlap_tests.h"
#include "patch_edges.h"
#include "radix_sort.h"

namespace mlsmesh::core {
namespace {

struct EdgeNumbers {
  std::vector<Index> first;    // half-edge of lower number of every edge
  std::vector<Index> of_half;  // edge of every half-edge
};

EdgeNumbers numberEdges(const HalfEdgeMesh& mesh, const Context& context) {
  CancelCheck check(context);
  EdgeNumbers numbers;
  numbers.of_half.resize(3 * static_cast<std::size_t>(mesh.slotCount()));
  for (Index h = 0; h < 3 * mesh.slotCount(); ++h) {
    check();
    const Index g = mesh.twin(h);
    if (g != kNone && g < h) {
      numbers.of_half[h] = numbers.of_half[g];
    } else {
      numbers.of_half[h] = static_cast<Index>(numbers.first.size());
      numbers.first.push_back(h);
    }
  }
  return numbers;
}

class EdgeTest {
 public:
  EdgeTest(const PointSet& points, const MlsSurface& surface, double spacing,
           const RefinementParameters& parameters, const HalfEdgeMesh& mesh,
           const std::vector<Vec3>& position, const std::vector<Vec3>& normals,
           const std::vector<std::array<Index, 2>>& flat_edges, const CreaseEdges& creases,
           const PatchEdges& patches)
      : points_(points),
        surface_(surface),
        spacing_(spacing),
        parameters_(parameters),
        mesh_(mesh),
        position_(position),
        normals_(normals),
        flat_edges_(flat_edges),
        creases_(creases),
        patches_(patches) {}

  SplitEdge evaluate(Index half_edge) const {
    SplitEdge edge;
    edge.half_edge = half_edge;
    const Index u = mesh_.origin(half_edge), v = mesh_.target(half_edge);
    if (patches_.isInside(half_edge) || isKnownFlat(u, v)) return edge;
    const Vec3 middle = 0.5 * (position_[u] + position_[v]);
    if (!patches_.isRim(half_edge) && creases_.isNear(half_edge)) {
      evaluateNearCrease(middle, (position_[u] - position_[v]).norm(), edge);
      return edge;
    }
    const Vec3 normal = normalAt(half_edge);
    const Vec3 aside = borderStep(half_edge, normal);
    Projection projection;
    if (parameters_.test == RefinementTest::Displacement) {
      projection = surface_.project(middle + aside);
      const double height = (projection.position - middle).dot(normal);
      edge.marked = std::hypot(height, aside.norm()) >= parameters_.threshold * projection.spacing;
    } else {
      const double alpha = surface_.meanDifference(middle).dot(normal);
      edge.marked = std::abs(alpha) >= parameters_.threshold * spacing_;
      if (edge.marked) projection = surface_.project(middle + alpha * normal);
    }
    if (edge.marked) place(projection, middle, normal, (position_[u] - position_[v]).norm(), edge, aside);
    return edge;
  }

 private:
  bool isKnownFlat(Index u, Index v) const {
    return std::binary_search(flat_edges_.begin(), flat_edges_.end(),
                              std::array<Index, 2>{std::min(u, v), std::max(u, v)});
  }

  // From the middle of a border edge to the curve that the border runs along, in the surface.
  Vec3 borderStep(Index half_edge, const Vec3& normal) const {
    if (!parameters_.smooth_borders || !mesh_.isBorder(half_edge)) return Vec3::Zero();
    const Vec3 offset = borderCurveOffset(mesh_, position_, half_edge);
    return offset - offset.dot(normal) * normal;
  }

  void evaluateNearCrease(const Vec3& middle, double length, SplitEdge& edge) const {
    Vec3 normal = creases_.meanNormal(edge.half_edge);
    if (normal.isZero()) normal = normalAt(edge.half_edge);
    Projection projection;
    double offset = 0;
    if (creases_.isAlong(edge.half_edge) && creases_.onCrease(edge.half_edge, projection)) {
      offset = (projection.position - middle).norm();
    } else {
      projection = creases_.onSide(middle, normal);
      offset = std::abs((projection.position - middle).dot(normal));
    }
    edge.marked = offset >= parameters_.threshold * projection.spacing;
    if (edge.marked) place(projection, middle, normal, length, edge);
  }

  Vec3 normalAt(Index half_edge) const {
    const Vec3 sum = normals_[mesh_.origin(half_edge)] + normals_[mesh_.target(half_edge)];
    const double length = sum.norm();
    if (length > 1e-6) return sum / length;
    return unitNormal(position_[mesh_.origin(half_edge)], position_[mesh_.target(half_edge)],
                      position_[mesh_.opposite(half_edge)]);
  }

  void place(const Projection& projection, const Vec3& middle, const Vec3& normal, double length,
             SplitEdge& edge, const Vec3& aside = Vec3::Zero()) const {
    Vec3 step = projection.position - middle;
    double limit = parameters_.max_displacement * length;
    edge.kind = projection.kind;
    if (mesh_.isBorder(edge.half_edge) || patches_.isRim(edge.half_edge)) {
      step = step.dot(normal) * normal + aside;
      limit = parameters_.border_displacement * length;
      edge.kind = VertexKind::Border;
    }
    const double distance = step.norm();
    if (!std::isfinite(distance)) {
      step.setZero();
      edge.kind = VertexKind::Clamped;
    } else if (distance > limit) {
      step *= limit / distance;
      edge.kind = VertexKind::Clamped;
    }
    edge.midpoint = points_.stored(middle);
    edge.position = points_.stored(middle + step);
    edge.nearest = projection.nearest;
    const bool usable = projection.normal.allFinite();
    edge.normal = usable ? projection.normal : normal;
    if (edge.normal.dot(normal) < 0) edge.normal = -edge.normal;
  }

  const PointSet& points_;
  const MlsSurface& surface_;
  const double spacing_;
  const RefinementParameters& parameters_;
  const HalfEdgeMesh& mesh_;
  const std::vector<Vec3>& position_;
  const std::vector<Vec3>& normals_;
  const std::vector<std::array<Index, 2>>& flat_edges_;
  const CreaseEdges& creases_;
  const PatchEdges& patches_;
};

// Triangles too thin to divide keep their edges whole.
void keepThinTriangles(const HalfEdgeMesh& mesh, const std::vector<Vec3>& position,
                       const std::vector<Index>& edge_of, double min_ratio, const Context& context,
                       std::vector<SplitEdge>& edges) {
  CancelCheck check(context);
  for (Index t = 0; t < mesh.slotCount(); ++t) {
    check();
    const auto [a, b, c] = mesh.corners(t);
    const double x = (position[a] - position[b]).norm();
    const double y = (position[b] - position[c]).norm();
    const double z = (position[c] - position[a]).norm();
    if (std::min({x, y, z}) >= min_ratio * std::max({x, y, z})) continue;
    for (int i = 0; i < 3; ++i) edges[edge_of[3 * t + i]].marked = false;
  }
}

std::vector<std::array<Index, 2>> unmarkedEdges(const HalfEdgeMesh& mesh, const std::vector<SplitEdge>& edges,
                                                const Context& context) {
  CancelCheck check(context);
  std::vector<std::array<Index, 2>> unmarked;
  for (const SplitEdge& edge : edges) {
    check();
    if (edge.marked || mesh.isBorder(edge.half_edge)) continue;
    const Index u = mesh.origin(edge.half_edge), v = mesh.target(edge.half_edge);
    unmarked.push_back({std::min(u, v), std::max(u, v)});
  }
  int bits = 1;  // of a vertex number
  while (mesh.vertexCount() >> bits > 0) ++bits;
  const auto keyOf = [bits](const std::array<Index, 2>& edge) {
    return static_cast<std::uint64_t>(edge[0]) << bits | static_cast<std::uint64_t>(edge[1]);
  };
  radixSort(unmarked, 2 * bits, keyOf, context);
  return unmarked;
}

HalfEdgeMesh finestMesh(const RefinedMesh& refined, const Context& context) {
  HalfEdgeMesh mesh;
  std::string why;
  const Index vertices = static_cast<Index>(refined.position.size());
  if (!buildMesh(vertices, refined.level_triangles.back(), mesh, &why, context))
    throw Failure(StatusCode::InvalidMesh, why);
  parallelBlocks(context, refined.position.size(), 4096, [&](std::size_t first, std::size_t last) {
    for (Index v = static_cast<Index>(first); v < static_cast<Index>(last); ++v) {
      if (mesh.fanCount(v) < 2) continue;
      throw Failure(StatusCode::InvalidMesh,
                    "vertex " + std::to_string(v) + " joins fans of triangles that share no edge");
    }
  });
  return mesh;
}

void appendVertices(const HalfEdgeMesh& mesh, const std::vector<SplitEdge>& edges, const Context& context,
                    RefinedMesh& refined) {
  CancelCheck check(context);
  for (const SplitEdge& edge : edges) {
    check();
    if (!edge.marked) continue;
    refined.position.push_back(edge.position);
    refined.normal.push_back(edge.normal);
    refined.kind.push_back(edge.kind);
    refined.nearest.push_back(edge.nearest);
    refined.parents.push_back({mesh.origin(edge.half_edge), mesh.target(edge.half_edge)});
  }
}

// Appends the vertices of the marked edges; the level has yet to be flipped.
NewLevel newLevel(const HalfEdgeMesh& mesh, const std::vector<SplitEdge>& edges,
                  std::vector<Triangle> triangles, const Context& context, RefinedMesh& refined) {
  NewLevel level;
  level.first_vertex = static_cast<Index>(refined.position.size());
  appendVertices(mesh, edges, context, refined);
  for (const SplitEdge& edge : edges) {
    if (edge.marked) level.midpoint.push_back(edge.midpoint);
  }
  std::string why;
  if (!buildMesh(static_cast<Index>(refined.position.size()), triangles, level.flipped, &why, context))
    throw Failure(StatusCode::Internal, "refinement broke the mesh: " + why);
  level.unflipped = std::move(triangles);
  return level;
}

// A level over the marked edges, with the pairs of its triangles that meet.
struct Division {
  NewLevel level;
  std::vector<Triangle> triangles;
  std::vector<TrianglePair> pairs;
};

Division divide(const HalfEdgeMesh& mesh, const EdgeNumbers& numbers, const PointSet& points,
                const RefinementParameters& parameters, const Context& context, std::vector<SplitEdge>& edges,
                RefinedMesh& refined) {
  const double fold_angle = parameters.fold_guard ? parameters.fold_angle : -1.0;
  const double min_ratio = parameters.min_edge_ratio;
  std::vector<Triangle> triangles;
  if (parameters.split_mode == SplitMode::Templates) {
    keepThinTriangles(mesh, refined.position, numbers.of_half, min_ratio, context, edges);
    triangles = splitByTemplates(mesh, refined.position, numbers.of_half, fold_angle, points, context, edges);
  } else {
    triangles = splitOneByOne(mesh, refined.position, min_ratio, fold_angle, points, edges);
  }
  Division division;
  division.level = newLevel(mesh, edges, std::move(triangles), context, refined);
  HalfEdgeMesh& flipped = division.level.flipped;
  flipEdges(flipped, refined.position, parameters.flips, parameters.flip_guard, context, &refined.kind,
            &division.level.flips);
  division.triangles = flipped.triangles();
  division.pairs = parameters.fold_guard
                       ? guardIntersections(points, division.level, context, refined, division.triangles)
                       : SelfIntersections(refined.position, division.triangles, context, &flipped).all();
  return division;
}

// Unmarks the edges whose vertices are in triangles that meet: once all are on midpoints, their rounding has
// made these meet. Returns whether there were any.
bool unmarkMeeting(const Division& division, std::vector<SplitEdge>& edges) {
  std::vector<std::size_t> marked;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (edges[e].marked) marked.push_back(e);
  }
  bool any = false;
  for (const TrianglePair& pair : division.pairs) {
    for (const Index t : pair) {
      for (const Index v : division.triangles[t]) {
        if (v < division.level.first_vertex) continue;
        edges[marked[v - division.level.first_vertex]].marked = false;
        any = true;
      }
    }
  }
  return any;
}

void dropVerticesFrom(Index first, RefinedMesh& refined) {
  const auto count = static_cast<std::size_t>(first);
  refined.position.resize(count);
  refined.normal.resize(count);
  refined.kind.resize(count);
  refined.nearest.resize(count);
  refined.parents.resize(count);
}

}  // namespace

std::vector<Vec3> vertexNormals(const std::vector<Triangle>& triangles, const std::vector<Vec3>& position) {
  std::vector<Vec3> normals(position.size(), Vec3::Zero());
  for (const auto& [a, b, c] : triangles) {
    const Vec3 area = (position[b] - position[a]).cross(position[c] - position[a]);
    for (const Index v : {a, b, c}) normals[v] += area;
  }
  for (Vec3& n : normals) n = n.squaredNorm() > 0 ? Vec3(n.normalized()) : Vec3(Vec3::Zero());
  return normals;
}

void addLevel(const PointSet& points, const MlsSurface& surface, double spacing,
              const RefinementParameters& parameters, const Context& context, RefinedMesh& refined,
              const Features& features) {
  const HalfEdgeMesh mesh = finestMesh(refined, context);
  const EdgeNumbers numbers = numberEdges(mesh, context);
  const std::vector<Vec3> normals = vertexNormals(refined.level_triangles.back(), refined.position);
  const CreaseEdges creases(features, surface, mesh, refined);
  const PatchEdges patches(mesh, refined.kind);
  const EdgeTest test(points, surface, spacing, parameters, mesh, refined.position, normals,
                      refined.flat_edges, creases, patches);
  context.checkCancelled();
  std::vector<SplitEdge> edges(numbers.first.size());
  parallelBlocks(context, edges.size(), 256, [&](std::size_t first, std::size_t last) {
    for (std::size_t e = first; e < last; ++e) edges[e] = test.evaluate(numbers.first[e]);
  });
  std::vector<std::array<Index, 2>> flat_edges = unmarkedEdges(mesh, edges, context);

  Division division = divide(mesh, numbers, points, parameters, context, edges, refined);
  while (parameters.fold_guard && !division.pairs.empty() && unmarkMeeting(division, edges)) {
    dropVerticesFrom(division.level.first_vertex, refined);
    division = divide(mesh, numbers, points, parameters, context, edges, refined);
  }
  refined.flat_edges = std::move(flat_edges);
  refined.level_intersections.resize(refined.level_triangles.size());
  refined.level_intersections.emplace_back(static_cast<std::int64_t>(division.pairs.size()));
  refined.level_triangles.push_back(std::move(division.triangles));
  refined.level_vertices.push_back(static_cast<Index>(refined.position.size()));
}

void refineMesh(const PointSet& points, const MlsSurface& surface, double spacing,
                const RefinementParameters& parameters, const Context& context, RefinedMesh& mesh) {
  for (int level = 0; level < parameters.levels; ++level) {
    context.checkCancelled();
    addLevel(points, surface, spacing, parameters, context, mesh);
  }
}

}  // namespace mlsmesh::core
