// SPDX-License-Identifier: BSD-3-Clause
// No published test is followed. That an orientation cannot be carried around a one-sided surface is A. F.
// Moebius's rule of edges (1865): triangles that agree run through their common edge in opposite directions.
// Here it is asked of edges beside each other, because a mesh that is oriented at all times has no edge that
// breaks the rule: it has a gap instead.
#include "seams.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "disjoint_sets.h"
#include "mlsmesh/core/neighbor_search.h"

namespace mlsmesh::core {
namespace {

constexpr double kReach = 3;        // widest gap, in the mean edge lengths of the triangles at it
constexpr double kOpposite = -0.5;  // cosine between the normals of the two sides, at most
constexpr double kAhead = 0.5;    // cosine between the way across the gap and the way over the edge, at least
constexpr double kRise = 0.5;     // sine of the gap's angle with the surface, at most
constexpr double kLying = 0.7;    // cosine between the normals of a triangle and of the surface, at least
constexpr int kNearest = 24;      // border edges that are looked at around each
constexpr int kSteps = 30;        // from triangle to triangle, within which two of them are parts of one fold
constexpr Index kLeastEdges = 4;  // of a seam, both sides together
constexpr Index kLeastShare = 3;  // one in so many edges of a seam is far from the other side on the mesh

// An edge of the border, and how the surface lies there.
struct Rim {
  Vec3 middle;
  Vec3 along;    // unit
  Vec3 normal;   // of the surface, unit, on the side that the triangle calls its outside
  Vec3 outward;  // over the edge, away from the triangle, unit
  double length = 0;
  double size = 0;   // mean edge length of the triangle
  double lying = 0;  // cosine between the normals of the triangle and of the surface
  Index triangle = kNone;
  Index component = kNone;
};

Rim rimAt(const HalfEdgeMesh& mesh, const std::vector<Vec3>& x, const std::vector<Vec3>& normal, Index h) {
  const Index u = mesh.origin(h), v = mesh.target(h), w = mesh.opposite(h);
  Rim rim;
  rim.middle = (x[u] + x[v]) / 2;
  rim.length = (x[v] - x[u]).norm();
  rim.along = (x[v] - x[u]) / rim.length;
  rim.size = (rim.length + (x[w] - x[v]).norm() + (x[u] - x[w]).norm()) / 3;
  const Vec3 facing = (x[v] - x[u]).cross(x[w] - x[u]).normalized();
  Vec3 sum = Vec3::Zero();
  for (const Index p : {u, v, w}) sum += normal[p].dot(facing) < 0 ? Vec3(-normal[p]) : normal[p];
  rim.normal = sum.normalized();
  rim.lying = facing.dot(rim.normal);
  rim.outward = rim.along.cross(rim.normal).normalized();
  rim.triangle = HalfEdgeMesh::triangleOf(h);
  return rim;
}

std::vector<Rim> rimsOf(const HalfEdgeMesh& mesh, const std::vector<Vec3>& points,
                        const std::vector<Vec3>& normal, const Context& context) {
  CancelCheck check(context);
  std::vector<Rim> rims;
  for (Index h = 0; h < 3 * mesh.slotCount(); ++h) {
    check();
    if (mesh.alive(HalfEdgeMesh::triangleOf(h)) && mesh.isBorder(h))
      rims.push_back(rimAt(mesh, points, normal, h));
  }
  if (rims.empty()) return rims;
  const std::vector<Index> component = mesh.components(nullptr, context);
  for (Rim& rim : rims) rim.component = component[rim.triangle];
  return rims;
}

// One sheet goes on from a to b, but their triangles lie on it with opposite sides up.
bool contradict(const Rim& a, const Rim& b) {
  if (a.normal.dot(b.normal) > kOpposite || a.along.dot(b.along) < -kOpposite) return false;
  if (std::min(a.lying, b.lying) < kLying) return false;
  const Vec3 gap = b.middle - a.middle;
  const double length = gap.norm();
  const double rise = std::max(std::abs(gap.dot(a.normal)), std::abs(gap.dot(b.normal)));
  const double ahead = std::min(gap.dot(a.outward), -gap.dot(b.outward));
  return rise <= kRise * length && ahead >= kAhead * length;
}

// Which triangles are within kSteps of one. Thin folds and hems have borders that face each other too, but
// then the mesh leads from one to the other on a short way; around a one-sided surface it is long.
class Vicinity {
 public:
  explicit Vicinity(const HalfEdgeMesh& mesh) : mesh_(mesh) {}

  void centreOn(Index triangle) {
    mark_.resize(static_cast<std::size_t>(mesh_.slotCount()), kNone);
    centre_ = triangle;
    mark_[triangle] = centre_;
    reached_.assign(1, triangle);
    std::size_t begin = 0;
    for (int step = 0; step < kSteps; ++step) {
      for (const std::size_t end = reached_.size(); begin < end; ++begin) reachFrom(reached_[begin]);
    }
  }

  bool contain(Index triangle) const { return mark_[triangle] == centre_; }

 private:
  void reachFrom(Index triangle) {
    for (Index h = 3 * triangle; h < 3 * triangle + 3; ++h) {
      if (mesh_.isBorder(h)) continue;
      const Index beyond = HalfEdgeMesh::triangleOf(mesh_.twin(h));
      if (mark_[beyond] != centre_) reached_.push_back(beyond);
      mark_[beyond] = centre_;
    }
  }

  const HalfEdgeMesh& mesh_;
  std::vector<Index> mark_;  // the centre that reached it last
  std::vector<Index> reached_;
  Index centre_ = kNone;
};

class Seams {
 public:
  Seams(const HalfEdgeMesh& mesh, std::vector<Rim> rims, const Context& context)
      : mesh_(mesh),
        context_(context),
        rims_(std::move(rims)),
        role_(rims_.size(), NoSeam),
        groups_(rims_.size()) {}

  SeamCount count() {
    std::vector<Vec3> middles;
    middles.reserve(rims_.size());
    for (const Rim& rim : rims_) middles.push_back(rim.middle);
    const auto search = makeKdTree(middles, context_);
    findSides(*search);
    join(*search);
    return sum();
  }

 private:
  enum Role : unsigned char { NoSeam, NearSide, FarSide };  // of an edge; near: the mesh is a fold there

  // The other edges of the same component that are near.
  std::vector<Index> around(const NeighborSearch& search, Index i) const {
    Index near[kNearest];
    double squared[kNearest];
    const int found = search.nearest(rims_[i].middle, kNearest, near, squared);
    std::vector<Index> result;
    for (int k = 0; k < found; ++k) {
      const Rim& other = rims_[near[k]];
      const double reach = kReach * std::min(rims_[i].size, other.size);
      const bool apart = other.component != rims_[i].component || squared[k] > reach * reach;
      if (near[k] != i && !apart) result.push_back(near[k]);
    }
    return result;
  }

  void findSides(const NeighborSearch& search) {
    constexpr Index kBetween = 64;  // edges between two looks at the handle
    Vicinity vicinity(mesh_);
    for (Index i = 0; i < static_cast<Index>(rims_.size()); ++i) {
      if (i % kBetween == 0) context_.checkCancelled();
      std::vector<Index> across = around(search, i);
      across.erase(std::remove_if(across.begin(), across.end(),
                                  [&](Index j) { return !contradict(rims_[i], rims_[j]); }),
                   across.end());
      if (!across.empty()) vicinity.centreOn(rims_[i].triangle);
      for (const Index j : across) {
        const Role role = vicinity.contain(rims_[j].triangle) ? NearSide : FarSide;
        role_[i] = std::max(role_[i], role);
        role_[j] = std::max(role_[j], role);
      }
    }
  }

  void join(const NeighborSearch& search) {
    CancelCheck check(context_);
    for (Index i = 0; i < static_cast<Index>(rims_.size()); ++i) {
      check();
      if (role_[i] == NoSeam) continue;
      for (const Index j : around(search, i)) {
        if (role_[j] != NoSeam) groups_.join(i, j);
      }
    }
  }

  SeamCount sum() {
    std::vector<Index> edges(rims_.size(), 0), far(rims_.size(), 0);
    std::vector<double> length(rims_.size(), 0);
    for (Index i = 0; i < static_cast<Index>(rims_.size()); ++i) {
      if (role_[i] == NoSeam) continue;
      const Index group = groups_.leader(i);
      ++edges[group];
      far[group] += role_[i] == FarSide ? 1 : 0;
      length[group] += rims_[i].length / 2;
    }
    SeamCount count;
    for (std::size_t g = 0; g < rims_.size(); ++g) {
      if (far[g] < kLeastEdges || kLeastShare * far[g] < edges[g]) continue;
      ++count.seams;
      count.edges += edges[g];
      count.length += length[g];
    }
    return count;
  }

  const HalfEdgeMesh& mesh_;
  const Context& context_;
  const std::vector<Rim> rims_;
  std::vector<Role> role_;
  DisjointSets groups_;
};

}  // namespace

SeamCount countSeams(const HalfEdgeMesh& mesh, const std::vector<Vec3>& points,
                     const std::vector<Vec3>& normal, const Context& context) {
  std::vector<Rim> rims = rimsOf(mesh, points, normal, context);
  if (static_cast<Index>(rims.size()) < kLeastEdges) return {};
  return Seams(mesh, std::move(rims), context).count();
}

}  // namespace mlsmesh::core
