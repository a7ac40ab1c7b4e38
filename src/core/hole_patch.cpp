// SPDX-License-Identifier: BSD-3-Clause
// This work is based on P. Liepa, "Filling holes in meshes", SGP 2003: triangulate, refine, make fair.
// Departures: refined again after fairing, because a patch that bulges is larger than the membrane that it
// was; and there are other shapes to fall back on where the fair one would meet the mesh.
#include "hole_patch.h"

#include <algorithm>
#include <cmath>

#include "patch_fairing.h"
#include "patch_outline.h"
#include "patch_shell.h"

namespace mlsmesh::core {
namespace {

constexpr int kFairings = 2;
constexpr double kPi = 3.14159265358979323846;
constexpr double kShellGaps[] = {1, 0.5, 0.25, 0.1, 0.03, 0.01};  // edge lengths between a sheet and its back
constexpr double kLifts[] = {0.5, 1, 2, 4, 8, 0.15};  // edge lengths that a cushion rises next to its rim

class PatchMaker {
 public:
  PatchMaker(const PointSet& points, HalfEdgeMesh& mesh, std::vector<Vec3>& position, HolePatch& patch)
      : points_(points), mesh_(mesh), position_(position), patch_(patch) {}

  void make(const std::vector<Index>& loop, PatchStyle style) {
    patch_.first_triangle = mesh_.slotCount();
    patch_.first_vertex = mesh_.vertexCount();
    for (const Index h : loop) patch_.rim.push_back(mesh_.origin(h));
    if (style == PatchStyle::Shell) {
      makeShell(loop);
      return;
    }
    outlinePatch(mesh_, position_, loop);
    PatchRefiner refiner(mesh_, position_, {patch_.first_triangle, patch_.first_vertex}, patch_.rim);
    refiner.splitChords();
    refiner.divide();
    const std::vector<Vec3> flat = style == PatchStyle::Smooth ? addSmoothShapes(refiner) : own();
    end();
    addShape(flat);
    addLiftedShapes(flat);
  }

 private:
  void end() {
    patch_.end_triangle = mesh_.slotCount();
    patch_.end_vertex = mesh_.vertexCount();
  }

  void makeShell(const std::vector<Index>& loop) {
    const bool fits = addShell(mesh_, position_, loop);
    end();
    if (!fits) return;
    findSources();
    const std::vector<Vec3> normal = normals();
    const std::vector<Vec3> flat = own();
    for (const double gap : kShellGaps) {
      std::vector<Vec3> shape = flat;
      for (std::size_t i = 0; i < shape.size(); ++i)
        shape[i] += gap * meanEdge(patch_.first_vertex + static_cast<Index>(i)) * normal[i];
      addShape(shape);
    }
  }

  // Adds the fair surface and the one half-way to the membrane, which is returned.
  std::vector<Vec3> addSmoothShapes(PatchRefiner& refiner) {
    put(spanned());
    refiner.flipToDelaunay();
    for (int i = 0; i < kFairings; ++i) {
      const std::vector<Vec3> before = own();
      put(fair());
      if (isTooLarge()) {
        put(before);
        break;
      }
      refiner.divide();
    }
    const std::vector<Vec3> bent = fair();
    const std::vector<Vec3> flat = spanned();
    put(bent);
    if (!isTooLarge()) addShape(bent);
    std::vector<Vec3> between(bent.size());
    for (std::size_t i = 0; i < bent.size(); ++i) between[i] = 0.5 * (bent[i] + flat[i]);
    addShape(between);
    return flat;
  }

  // A surface that may fit where its rim turns back on the mesh: lifted off `flat` to its outer side, as a
  // cushion, by so much at each of its vertices.
  void addLiftedShapes(const std::vector<Vec3>& flat) {
    put(flat);
    findSources();
    const std::vector<double> height = cushion(mesh_, position_, patch_.first_vertex);
    const std::vector<Vec3> normal = outerSide();
    double edge = 0;
    for (Index v = patch_.first_vertex; v < patch_.end_vertex; ++v) edge += meanEdge(v);
    edge /= static_cast<double>(flat.size());
    for (const double lift : kLifts) {
      std::vector<Vec3> lifted = flat;
      for (std::size_t i = 0; i < flat.size(); ++i) {
        lifted[i] += lift * edge * height[i] * normal[i];
      }
      addShape(lifted);
    }
  }

  std::vector<Vec3> own() const { return {position_.begin() + patch_.first_vertex, position_.end()}; }
  void put(const std::vector<Vec3>& own) {
    std::copy(own.begin(), own.end(), position_.begin() + patch_.first_vertex);
  }
  void addShape(std::vector<Vec3> shape) {
    const auto finite = [](const Vec3& x) { return x.allFinite(); };
    if (!std::all_of(shape.begin(), shape.end(), finite)) return;
    for (Vec3& x : shape) x = points_.stored(x);
    patch_.shapes.push_back(std::move(shape));
  }
  std::vector<Vec3> spanned() const { return membrane(mesh_, position_, patch_.first_vertex); }
  std::vector<Vec3> fair() const { return fairSurface(mesh_, position_, patch_.first_vertex, patch_.rim); }

  // A patch that blows up has seen tangents that say nothing: more than a ball on its rim would have.
  bool isTooLarge() const {
    double around = 0, area = 0;
    for (std::size_t i = 0; i < patch_.rim.size(); ++i) {
      around += (position_[patch_.rim[(i + 1) % patch_.rim.size()]] - position_[patch_.rim[i]]).norm();
    }
    for (Index t = patch_.first_triangle; t < mesh_.slotCount(); ++t) area += areaOf(t).norm();
    return !(0.5 * area <= around * around / kPi);
  }

  // Twice the area, along the normal; of a dead slot zero.
  Vec3 areaOf(Index triangle) const {
    if (!mesh_.alive(triangle)) return Vec3::Zero();
    const auto [a, b, c] = mesh_.corners(triangle);
    return (position_[b] - position_[a]).cross(position_[c] - position_[a]);
  }

  std::vector<Vec3> normals() const {
    std::vector<Vec3> sum(static_cast<std::size_t>(patch_.end_vertex - patch_.first_vertex), Vec3::Zero());
    for (Index t = patch_.first_triangle; t < patch_.end_triangle; ++t) {
      if (!mesh_.alive(t)) continue;
      for (const Index v : mesh_.corners(t)) {
        if (v >= patch_.first_vertex) sum[v - patch_.first_vertex] += areaOf(t);
      }
    }
    for (Vec3& n : sum) n.normalize();
    return sum;
  }

  // Directions that lead away from the mesh: at the rim to the back of its triangles, farther in off the
  // patch.
  std::vector<Vec3> outerSide() const {
    std::vector<Vec3> direction = position_;
    for (const Index v : patch_.rim) {
      Vec3 sum = Vec3::Zero();
      for (Index h = mesh_.firstOutgoing(v); h != kNone; h = mesh_.nextOutgoing(h)) {
        if (HalfEdgeMesh::triangleOf(h) < patch_.first_triangle) sum -= areaOf(HalfEdgeMesh::triangleOf(h));
      }
      direction[v] = sum.normalized();
    }
    std::vector<Vec3> back = membrane(mesh_, direction, patch_.first_vertex);
    const std::vector<Vec3> normal = normals();
    for (std::size_t i = 0; i < back.size(); ++i) back[i] = (back[i] + 0.5 * normal[i]).normalized();
    return back;
  }

  double meanEdge(Index vertex) const {
    double sum = 0;
    for (Index h = mesh_.firstOutgoing(vertex); h != kNone; h = mesh_.nextOutgoing(h))
      sum += (position_[mesh_.target(h)] - position_[vertex]).norm();
    return sum / mesh_.degree(vertex);
  }

  // Spreads from the rim over the patch.
  void findSources() {
    const auto count = static_cast<std::size_t>(patch_.end_vertex - patch_.first_vertex);
    patch_.source.assign(count, kNone);
    std::vector<Index> reached = patch_.rim;
    for (std::size_t i = 0; i < reached.size(); ++i) {
      const Index v = reached[i], own = v - patch_.first_vertex;
      for (Index h = mesh_.firstOutgoing(v); h != kNone; h = mesh_.nextOutgoing(h)) {
        const Index next = mesh_.target(h) - patch_.first_vertex;
        if (next < 0 || patch_.source[next] != kNone) continue;
        patch_.source[next] = own < 0 ? v : patch_.source[own];
        reached.push_back(mesh_.target(h));
      }
    }
  }

  const PointSet& points_;
  HalfEdgeMesh& mesh_;
  std::vector<Vec3>& position_;
  HolePatch& patch_;
};

}  // namespace

HolePatch makePatch(const PointSet& points, const std::vector<Index>& loop, PatchStyle style,
                    HalfEdgeMesh& mesh, std::vector<Vec3>& position) {
  HolePatch patch;
  PatchMaker(points, mesh, position, patch).make(loop, style);
  return patch;
}

}  // namespace mlsmesh::core
