// SPDX-License-Identifier: BSD-3-Clause
// Representatives are centroids of clusters, so that the border of their mesh lies inside that of the cloud,
// by about half a cluster, here more and there less. The points of the clusters along the loop say where the
// rim is. The curve between border vertices is that of N. Dyn, D. Levin, J. A. Gregory, "A 4-point
// interpolatory subdivision scheme for curve design", Computer Aided Geometric Design 4, 1987, with second
// differences by length, as the edges of a loop differ; the filter
// that evens out the loops has the fourth difference that this scheme is built on, so that it takes out a saw
// and leaves cubics as they are, where the usual (1, 2, 1) / 4 shrinks a loop.
#include "border_smoothing.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "mlsmesh/core/failure.h"
#include "mlsmesh/core/parallel.h"
#include "mlsmesh/core/self_intersections.h"
#include "overlap_tests.h"

namespace mlsmesh::core {
namespace {

constexpr double kStraight = 0.5;  // cosine of the turn, 60 degrees, from which on a loop has a corner

bool isCorner(const Vec3& before, const Vec3& at, const Vec3& after) {
  const Vec3 in = at - before, out = after - at;
  return in.dot(out) < kStraight * in.norm() * out.norm();
}

// A border loop: its vertices, where they are to go, and the directions out of the mesh there.
struct Loop {
  std::vector<Index> vertex;
  std::vector<Vec3> outward;  // unit, in the surface; zero where the vertex is to stay
  std::vector<double> reach;  // the farthest that a vertex may move
  std::vector<Vec3> target;

  std::size_t size() const { return vertex.size(); }
  std::size_t at(std::size_t i, int step) const { return (i + size() + step) % size(); }
};

class RimFinder {
 public:
  RimFinder(const PointSet& points, const IndexLists& clusters, const RefinedMesh& mesh)
      : points_(points), clusters_(clusters), mesh_(mesh) {}

  Loop find(const std::vector<Index>& vertices) const {
    Loop loop;
    loop.vertex = vertices;
    for (std::size_t i = 0; i < loop.size(); ++i)
      aim(vertices[loop.at(i, -1)], vertices[i], vertices[loop.at(i, 1)], loop);
    return loop;
  }

 private:
  void aim(Index before, Index vertex, Index after, Loop& loop) const {
    const Vec3 &a = mesh_.position[before], &v = mesh_.position[vertex], &b = mesh_.position[after];
    Vec3 outward = (b - a).cross(mesh_.normal[vertex]);
    const double length = outward.norm();
    const bool stays = mesh_.kind[vertex] == VertexKind::Crease || !(length > 0);
    outward = stays ? Vec3(Vec3::Zero()) : Vec3(outward / length);
    const double reach = 0.5 * ((v - a).norm() + (b - v).norm());
    loop.outward.push_back(outward);
    loop.reach.push_back(reach);
    const double offset =
        stays ? 0.0 : rimOffset({before, vertex, after}, mesh_.normal[vertex].cross(outward), outward);
    loop.target.push_back(v + std::min(offset, reach) * outward);
  }

  // How far the points that are the vertex's own along the loop reach outwards.
  double rimOffset(const Triangle& along, const Vec3& tangent, const Vec3& outward) const {
    const Vec3& v = mesh_.position[along[1]];
    const double first = 0.5 * (mesh_.position[along[0]] - v).dot(tangent);
    const double last = 0.5 * (mesh_.position[along[2]] - v).dot(tangent);
    double offset = 0;
    for (const Index cluster : along) {
      for (Index i = 0; i < clusters_.size(cluster); ++i) {
        const Vec3 d = points_.position[clusters_.data(cluster)[i]] - v;
        const double place = d.dot(tangent);
        if (place >= first && place <= last) offset = std::max(offset, d.dot(outward));
      }
    }
    return offset;
  }

  const PointSet& points_;
  const IndexLists& clusters_;
  const RefinedMesh& mesh_;
};

// Takes a saw out of the targets, along the outward directions.
void evenOut(Loop& loop) {
  constexpr int kPasses = 2;
  constexpr std::size_t kFewest = 6;
  if (loop.size() < kFewest) return;
  for (int pass = 0; pass < kPasses; ++pass) {
    const std::vector<Vec3> q = loop.target;
    const auto cornerAt = [&](std::size_t i) { return isCorner(q[loop.at(i, -1)], q[i], q[loop.at(i, 1)]); };
    for (std::size_t i = 0; i < loop.size(); ++i) {
      if (cornerAt(loop.at(i, -1)) || cornerAt(i) || cornerAt(loop.at(i, 1))) continue;
      const Vec3 fourth =
          q[loop.at(i, -2)] - 4 * q[loop.at(i, -1)] + 6 * q[i] - 4 * q[loop.at(i, 1)] + q[loop.at(i, 2)];
      loop.target[i] -= fourth.dot(loop.outward[i]) / 16 * loop.outward[i];
    }
  }
}

// Where the border vertices went, and which of them go back.
class Moves {
 public:
  Moves(const PointSet& points, const MlsSurface& surface, const HalfEdgeMesh& level, RefinedMesh& mesh)
      : points_(points), surface_(surface), level_(level), mesh_(mesh), before_(mesh.position) {}

  void make(const std::vector<Loop>& loops) {
    for (const Loop& loop : loops) {
      for (std::size_t i = 0; i < loop.size(); ++i) {
        if (!loop.outward[i].isZero()) move(loop.vertex[i], loop.target[i], loop.reach[i]);
      }
    }
  }

  /// Moved vertices whose triangles turn, rise off the surface or are degenerate.
  std::set<Index> folded(const std::vector<Index>& triangles) const {
    std::set<Index> vertices;
    for (const Index t : triangles) {
      if (!liesWell(level_.corners(t))) noteMoved(t, vertices);
    }
    return vertices;
  }

  void noteMoved(Index triangle, std::set<Index>& vertices) const {
    for (const Index v : level_.corners(triangle)) {
      if (isMoved(v)) vertices.insert(v);
    }
  }

  /// Puts the vertices back and returns the triangles that this changes, ascending.
  std::vector<Index> undo(const std::set<Index>& vertices) {
    for (const Index v : vertices) mesh_.position[v] = before_[v];
    return trianglesAt(vertices);
  }

  std::vector<Index> trianglesAt(const std::set<Index>& vertices) const {
    std::set<Index> triangles;
    for (const Index v : vertices) {
      for (Index h = level_.firstOutgoing(v); h != kNone; h = level_.nextOutgoing(h))
        triangles.insert(HalfEdgeMesh::triangleOf(h));
    }
    return {triangles.begin(), triangles.end()};
  }

  std::set<Index> moved() const {
    std::set<Index> vertices;
    for (Index v = 0; v < level_.vertexCount(); ++v) {
      if (isMoved(v)) vertices.insert(v);
    }
    return vertices;
  }

  /// Gives the vertices that have moved what belongs to their new places.
  void describe() {
    for (const Index v : moved()) {
      const Vec3& position = mesh_.position[v];
      double squared = 0;
      mesh_.kind[v] = VertexKind::Border;
      surface_.search().nearest(position, 1, &mesh_.nearest[v], &squared);
      const Vec3 normal = surface_.project(position).normal;
      if (normal.allFinite()) mesh_.normal[v] = normal.dot(mesh_.normal[v]) < 0 ? Vec3(-normal) : normal;
    }
  }

 private:
  bool liesWell(const Triangle& corners) const {
    constexpr double kFlat = 0.7;  // cosine of the angle to the surface that a triangle may rise to
    const auto [a, b, c] = corners;
    const Vec3 &x = mesh_.position[a], &y = mesh_.position[b], &z = mesh_.position[c];
    if (isDegenerate(x, y, z)) return false;
    const Vec3 before = unitNormal(before_[a], before_[b], before_[c]), now = unitNormal(x, y, z);
    if (before.dot(now) <= kStraight) return false;
    const Vec3 surface = (mesh_.normal[a] + mesh_.normal[b] + mesh_.normal[c]).normalized();
    return now.dot(surface) >= std::min(kFlat, before.dot(surface));
  }
  bool isMoved(Index v) const { return mesh_.position[v] != before_[v]; }

  // To the surface below the target, no farther than `reach`.
  void move(Index v, Vec3 target, double reach) {
    const Projection projection = surface_.project(target);
    const double height = (projection.position - target).dot(projection.normal);
    if (std::abs(height) < 0.5 * reach) target += height * projection.normal;
    const Vec3 step = target - before_[v];
    const double length = step.norm();
    if (!std::isfinite(length)) return;
    mesh_.position[v] = points_.stored(before_[v] + (length > reach ? reach / length : 1.0) * step);
  }

  const PointSet& points_;
  const MlsSurface& surface_;
  const HalfEdgeMesh& level_;
  RefinedMesh& mesh_;
  const std::vector<Vec3> before_;
};

// Undoes moves until no moved vertex has a triangle that folds or meets another.
void keepSound(const std::vector<Triangle>& triangles, const HalfEdgeMesh& level, const Context& context,
               Moves& moves, RefinedMesh& mesh) {
  std::vector<Index> changed = moves.trianglesAt(moves.moved());
  for (auto bad = moves.folded(changed); !bad.empty(); bad = moves.folded(changed)) changed = moves.undo(bad);
  const std::vector<Index> touched = moves.trianglesAt(moves.moved());
  if (touched.empty()) return;
  SelfIntersections search(mesh.position, triangles, context, &level);
  changed = touched;
  while (!changed.empty()) {
    context.checkCancelled();
    std::set<Index> bad = moves.folded(changed);
    for (const TrianglePair& pair : search.involving(changed)) {
      for (const Index t : pair) moves.noteMoved(t, bad);
    }
    changed = moves.undo(bad);
    search.update(changed);
  }
  const bool clean = mesh.level_intersections[0] && *mesh.level_intersections[0] == 0;
  mesh.level_intersections[0] = clean ? 0 : search.count();
}

// Second derivative, by length, of the curve through three points, at the middle one.
Vec3 curvature(const Vec3& before, const Vec3& at, const Vec3& after) {
  const double in = (at - before).norm(), out = (after - at).norm();
  return ((after - at) / out - (at - before) / in) * (2 / (in + out));
}

Index previousBorder(const HalfEdgeMesh& mesh, Index half_edge) {
  Index h = HalfEdgeMesh::previous(half_edge);
  while (!mesh.isBorder(h)) h = HalfEdgeMesh::previous(mesh.twin(h));
  return h;
}

}  // namespace

Index smoothBorders(const PointSet& points, const MlsSurface& surface, const IndexLists& clusters,
                    const Context& context, RefinedMesh& mesh) {
  const std::vector<Triangle>& triangles = mesh.level_triangles[0];
  HalfEdgeMesh level;
  std::string why;
  if (!buildMesh(static_cast<Index>(mesh.position.size()), triangles, level, &why, context))
    throw Failure(StatusCode::Internal, "the triangulation is not a manifold: " + why);
  const std::vector<std::vector<Index>> borders = level.borderLoops();
  if (borders.empty()) return 0;
  const RimFinder finder(points, clusters, mesh);
  std::vector<Loop> loops(borders.size());
  parallelBlocks(context, borders.size(), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      loops[i] = finder.find(borders[i]);
      evenOut(loops[i]);
    }
  });
  Moves moves(points, surface, level, mesh);
  moves.make(loops);
  keepSound(triangles, level, context, moves, mesh);
  moves.describe();
  return static_cast<Index>(moves.moved().size());
}

Vec3 borderCurveOffset(const HalfEdgeMesh& mesh, const std::vector<Vec3>& position, Index half_edge) {
  const Vec3 &before = position[mesh.origin(previousBorder(mesh, half_edge))],
             &u = position[mesh.origin(half_edge)], &v = position[mesh.target(half_edge)],
             &after = position[mesh.target(mesh.nextBorder(half_edge))];
  if (isCorner(before, u, v) || isCorner(u, v, after)) return Vec3::Zero();
  return -(curvature(before, u, v) + curvature(u, v, after)) * (v - u).squaredNorm() / 16;
}

}  // namespace mlsmesh::core
