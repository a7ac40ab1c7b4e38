// SPDX-License-Identifier: BSD-3-Clause
// This work is based on P. Liepa, "Filling holes in meshes", SGP 2003. Departure: patches are tested,
// exactly, against the mesh, themselves and one another, and give way until no triangles meet.
#include "mlsmesh/core/hole_patches.h"

#include <algorithm>
#include <set>

#include "hole_patch.h"
#include "mlsmesh/core/failure.h"
#include "mlsmesh/core/self_intersections.h"
#include "overlap_tests.h"

namespace mlsmesh::core {
namespace {

using Loop = std::vector<Index>;  // border half-edges in walking order

// Finds shapes for patches that were just added to a mesh.
class Settlement {
 public:
  Settlement(const HalfEdgeMesh& mesh, const std::vector<HolePatch>& patches, std::vector<Vec3>& position,
             const Context& context)
      : patches_(patches),
        position_(position),
        context_(context),
        triangles_(mesh.triangles()),
        owner_(triangles_.size(), kNone),
        members_(patches.size()),
        shape_(patches.size(), -1) {
    Index live = 0, patch = 0;
    for (Index t = 0; t < mesh.slotCount(); ++t) {
      if (!mesh.alive(t)) continue;
      while (patch < count() && t >= patches[patch].end_triangle) ++patch;
      if (patch < count() && t >= patches[patch].first_triangle) {
        owner_[live] = patch;
        members_[patch].push_back(live);
      }
      ++live;
    }
  }

  /// Moves the vertices of the patches to shapes that fit. Returns the patches that have none.
  std::vector<Index> run() {
    std::vector<Index> changed;
    for (Index patch = 0; patch < count(); ++patch) takeNextShape(patch, changed);
    SelfIntersections search(position_, triangles_, context_);
    while (!changed.empty()) {
      context_.checkCancelled();
      const std::set<Index> bad = patchesThatMeet(search, changed);
      changed.clear();
      for (const Index patch : bad) takeNextShape(patch, changed);
      search.update(changed);
    }
    std::vector<Index> given_up;
    for (Index patch = 0; patch < count(); ++patch) {
      if (isGivenUp(patch)) given_up.push_back(patch);
    }
    return given_up;
  }

 private:
  Index count() const { return static_cast<Index>(patches_.size()); }
  bool isGivenUp(Index patch) const {
    return shape_[patch] >= static_cast<int>(patches_[patch].shapes.size());
  }

  void takeNextShape(Index patch, std::vector<Index>& changed) {
    ++shape_[patch];
    if (isGivenUp(patch)) return;
    const std::vector<Vec3>& shape = patches_[patch].shapes[static_cast<std::size_t>(shape_[patch])];
    std::copy(shape.begin(), shape.end(), position_.begin() + patches_[patch].first_vertex);
    changed.insert(changed.end(), members_[patch].begin(), members_[patch].end());
  }

  std::set<Index> patchesThatMeet(const SelfIntersections& search, const std::vector<Index>& changed) const {
    std::set<Index> bad;
    for (const Index t : changed) {
      const auto [a, b, c] = triangles_[t];
      if (isDegenerate(position_[a], position_[b], position_[c])) bad.insert(owner_[t]);
    }
    for (const auto& [t, s] : search.involving(changed)) {
      if (isAbsent(t) || isAbsent(s)) continue;
      for (const Index patch : {owner_[t], owner_[s]}) {
        if (patch != kNone) bad.insert(patch);
      }
    }
    return bad;
  }

  bool isAbsent(Index triangle) const { return owner_[triangle] != kNone && isGivenUp(owner_[triangle]); }

  const std::vector<HolePatch>& patches_;
  std::vector<Vec3>& position_;
  const Context& context_;
  const std::vector<Triangle> triangles_;
  std::vector<Index> owner_;  // patch of every triangle
  std::vector<std::vector<Index>> members_;
  std::vector<int> shape_;  // that a patch has now
};

class Closing {
 public:
  Closing(const PointSet& points, const Context& context, RefinedMesh& refined, std::vector<Index>& source)
      : points_(points),
        context_(context),
        refined_(refined),
        position_(refined.position),
        source_(source),
        first_own_(static_cast<Index>(refined.position.size())) {
    std::string why;
    if (!buildMesh(first_own_, refined.level_triangles.back(), mesh_, &why, context))
      throw Failure(StatusCode::InvalidMesh, why);
    first_patch_ = mesh_.slotCount();
  }

  PatchCount run(double longest, const NeighborSearch& search) {
    PatchCount count;
    std::vector<Loop> loops = loopsUpTo(longest);
    const std::size_t asked = loops.size();
    if (asked == 0) return count;
    loops = closeLoops(loops, {PatchStyle::Smooth, PatchStyle::Plain});
    if (trimRims(loops)) loops = closeLoops(loopsUpTo(longest), {PatchStyle::Smooth, PatchStyle::Plain});
    loops = closeLoops(loops, {PatchStyle::Shell});
    const Index restored = restoreRims();
    count.open_loops = static_cast<Index>(loops.size());
    count.closed_loops = static_cast<Index>(asked - loops.size());
    if (count.closed_loops == 0) return count;
    turnOutward();
    count.vertices = append(search);
    for (Index t = first_patch_; t < mesh_.slotCount(); ++t) count.triangles += mesh_.alive(t) ? 1 : 0;
    count.triangles -= restored;
    return count;
  }

 private:
  double lengthOf(const Loop& loop) const {
    double sum = 0;
    for (const Index h : loop) sum += (position_[mesh_.target(h)] - position_[mesh_.origin(h)]).norm();
    return sum;
  }

  std::vector<Loop> loopsUpTo(double longest) const {
    std::vector<Loop> loops;
    for (Loop& loop : mesh_.borderLoopEdges(context_)) {
      if (lengthOf(loop) <= longest) loops.push_back(std::move(loop));
    }
    return loops;
  }

  // Tries one style after the other; returns the loops that stay open.
  std::vector<Loop> closeLoops(std::vector<Loop> loops, std::initializer_list<PatchStyle> styles) {
    for (const PatchStyle style : styles) {
      if (!loops.empty()) loops = closeLoops(loops, style);
    }
    return loops;
  }

  std::vector<Loop> closeLoops(const std::vector<Loop>& loops, PatchStyle style) {
    std::vector<HolePatch> patches;
    for (const Loop& loop : loops) {
      context_.checkCancelled();
      patches.push_back(makePatch(points_, loop, style, mesh_, position_));
    }
    std::vector<Loop> open;
    for (const Index patch : Settlement(mesh_, patches, position_, context_).run()) {
      open.push_back(loops[patch]);
      for (Index t = patches[patch].first_triangle; t < patches[patch].end_triangle; ++t) {
        if (mesh_.alive(t)) mesh_.removeTriangle(t);
      }
    }
    for (const HolePatch& patch : patches)
      rim_vertex_.insert(rim_vertex_.end(), patch.source.begin(), patch.source.end());
    return open;
  }

  // Takes off triangles beside the loops that are folded back on the mesh: nothing clears those. False if
  // there are none.
  bool trimRims(const std::vector<Loop>& loops) {
    for (const Loop& loop : loops) {
      for (const Index h : loop) {
        const Index next = HalfEdgeMesh::next(h), previous = HalfEdgeMesh::previous(h);
        if (mesh_.isBorder(next) || mesh_.isBorder(previous) || !mesh_.isInterior(mesh_.opposite(h)))
          continue;
        if (!isFolded(next) && !isFolded(previous)) continue;
        trimmed_.push_back(mesh_.corners(HalfEdgeMesh::triangleOf(h)));
        mesh_.removeTriangle(HalfEdgeMesh::triangleOf(h));
      }
    }
    return !trimmed_.empty();
  }

  // Puts back what was taken off beside loops that stay open all the same.
  Index restoreRims() {
    Index restored = 0;
    for (const auto& [a, b, c] : trimmed_) restored += mesh_.addTriangle(a, b, c) != kNone ? 1 : 0;
    return restored;
  }

  bool isFolded(Index half_edge) const {
    constexpr double kFolded = 0.17;  // cosine of 80 degrees
    return normalOf(half_edge).dot(normalOf(mesh_.twin(half_edge))) < kFolded;
  }

  Vec3 normalOf(Index half_edge) const {
    return unitNormal(position_[mesh_.origin(half_edge)], position_[mesh_.target(half_edge)],
                      position_[mesh_.opposite(half_edge)]);
  }

  // What was open may have been turned inward: only closed surfaces have an outer side.
  void turnOutward() {
    Index count = 0;
    const std::vector<Index> component = mesh_.components(&count, context_);
    std::vector<double> volume(static_cast<std::size_t>(count), 0);
    std::vector<char> patched(static_cast<std::size_t>(count), 0), open(static_cast<std::size_t>(count), 0);
    std::vector<Index> seed(static_cast<std::size_t>(count), kNone);
    for (Index t = 0; t < mesh_.slotCount(); ++t) {
      if (component[t] == kNone) continue;
      const auto [a, b, c] = mesh_.corners(t);
      const Index own = component[t];
      if (seed[own] == kNone) seed[own] = a;
      const Vec3& from = position_[seed[own]];
      volume[own] += (position_[a] - from).dot((position_[b] - from).cross(position_[c] - from));
      if (t >= first_patch_) patched[own] = 1;
      for (Index h = 3 * t; h < 3 * t + 3; ++h) open[own] = static_cast<char>(open[own] | mesh_.isBorder(h));
    }
    std::vector<Index> turned;
    for (Index t = 0; t < mesh_.slotCount(); ++t) {
      const Index own = component[t];
      if (own != kNone && patched[own] && !open[own] && volume[own] < 0) turned.push_back(t);
    }
    mesh_.reverse(turned);
    turnNormals(turned);
  }

  void turnNormals(const std::vector<Index>& triangles) {
    std::set<Index> vertices;
    for (const Index t : triangles) {
      for (const Index v : mesh_.corners(t)) {
        if (v < first_own_) vertices.insert(v);
      }
    }
    for (const Index v : vertices) refined_.normal[v] = -refined_.normal[v];
  }

  // Appends the patches' vertices that are in use; returns how many.
  Index append(const NeighborSearch& search) {
    std::vector<Triangle> triangles = mesh_.triangles();
    const std::vector<Vec3> normals = vertexNormals(triangles, position_);
    std::vector<Index> number(static_cast<std::size_t>(mesh_.vertexCount() - first_own_), kNone);
    for (Index v = first_own_; v < mesh_.vertexCount(); ++v) {
      if (!mesh_.isUsed(v)) continue;
      const Index own = static_cast<Index>(refined_.position.size());
      number[v - first_own_] = own;
      Index nearest = 0;
      double squared_distance = 0;
      search.nearest(position_[v], 1, &nearest, &squared_distance);
      refined_.position.push_back(position_[v]);
      refined_.normal.push_back(normals[v]);
      refined_.kind.push_back(VertexKind::Patch);
      refined_.nearest.push_back(nearest);
      refined_.parents.push_back({own, own});
      source_.push_back(rim_vertex_[v - first_own_]);
    }
    for (Triangle& t : triangles) {
      for (Index& v : t) v = v < first_own_ ? v : number[v - first_own_];
    }
    refined_.level_triangles.back() = std::move(triangles);
    refined_.level_vertices.back() = static_cast<Index>(refined_.position.size());
    for (auto& known : refined_.level_intersections) known.reset();
    return refined_.level_vertices.back() - first_own_;
  }

  const PointSet& points_;
  const Context& context_;
  RefinedMesh& refined_;
  HalfEdgeMesh mesh_;
  std::vector<Vec3> position_;  // of refined_ and of all patches that were tried
  std::vector<Index>& source_;
  std::vector<Index> rim_vertex_;  // nearest to each vertex of the patches
  std::vector<Triangle> trimmed_;
  const Index first_own_;
  Index first_patch_ = 0;  // triangle
};

}  // namespace

PatchCount closeHoles(const PointSet& points, const NeighborSearch& search, double longest,
                      const Context& context, RefinedMesh& mesh, std::vector<Index>& source) {
  return Closing(points, context, mesh, source).run(longest, search);
}

}  // namespace mlsmesh::core
