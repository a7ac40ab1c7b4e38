// SPDX-License-Identifier: BSD-3-Clause
// This work is based on B. Mederos, L. Velho, L. H. de Figueiredo, "Moving least squares multiresolution
// surface approximation", SIBGRAPI 2003, section 2.4, and C. L. Lawson, "Software for C1 surface
// interpolation", 1977 (min-angle flips). Departure: flips by length alone, as printed, fold the mesh; the
// default guards them and maximises the smallest angle.
#include "edge_flips.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "mlsmesh/core/parallel.h"
#include "overlap_tests.h"
#include "patch_edges.h"

namespace mlsmesh::core {
namespace {

constexpr int kRounds = 10;
constexpr double kMayTurn = 0.5;         // cosine of 60 degrees
constexpr double kHarmlessBend = 0.966;  // cosine of 15 degrees
constexpr double kGain = 1e-9;           // an angle's cosine must fall by more, so that rounds end

// The quad around an edge u -> v: w is the apex of its triangle, x that of its twin's.
struct Quad {
  Vec3 u, v, w, x;
};

// Cosine of the smallest angle of a triangle, its largest: from its edges, turned to run around it, and one
// over their lengths.
double sharpest(const Vec3& ab, double per_ab, const Vec3& bc, double per_bc, const Vec3& ca, double per_ca) {
  return -std::min(
      {ab.dot(bc) * (per_ab * per_bc), bc.dot(ca) * (per_bc * per_ca), ca.dot(ab) * (per_ca * per_ab)});
}

bool isBetter(const Quad& q, FlipRule rule) {
  const Vec3 uv = q.v - q.u, wx = q.x - q.w;
  if (rule == FlipRule::Length) return uv.squaredNorm() > wx.squaredNorm() * (1 + kGain);
  const Vec3 vw = q.w - q.v, wu = q.u - q.w, ux = q.x - q.u, xv = q.v - q.x;
  const double per_uv = 1 / uv.norm(), per_wx = 1 / wx.norm(), per_vw = 1 / vw.norm(), per_wu = 1 / wu.norm(),
               per_ux = 1 / ux.norm(), per_xv = 1 / xv.norm();
  const double before =
      std::max(sharpest(uv, per_uv, vw, per_vw, wu, per_wu), sharpest(-uv, per_uv, ux, per_ux, xv, per_xv));
  const double after =
      std::max(sharpest(-wx, per_wx, wu, per_wu, ux, per_ux), sharpest(wx, per_wx, xv, per_xv, vw, per_vw));
  return after < before - kGain;
}

Vec3 normalBeyond(const HalfEdgeMesh& mesh, const std::vector<Vec3>& position, Index half_edge,
                  const Vec3& otherwise) {
  const Index g = mesh.twin(half_edge);
  return g == kNone
             ? otherwise
             : unitNormal(position[mesh.origin(g)], position[mesh.target(g)], position[mesh.opposite(g)]);
}

// Smallest cosine between the normals of the triangles on either side of the five edges of the quad.
bool bendsNoWorse(const HalfEdgeMesh& mesh, const std::vector<Vec3>& position, Index h, const Quad& q) {
  const Index g = mesh.twin(h);
  const Vec3 uvw = unitNormal(q.u, q.v, q.w), vux = unitNormal(q.v, q.u, q.x);
  const Vec3 xwu = unitNormal(q.x, q.w, q.u), wxv = unitNormal(q.w, q.x, q.v);
  const auto beyond = [&](Index half_edge, const Vec3& own) {
    return normalBeyond(mesh, position, half_edge, own);
  };
  const Vec3 vw = beyond(HalfEdgeMesh::next(h), uvw), wu = beyond(HalfEdgeMesh::previous(h), uvw);
  const Vec3 ux = beyond(HalfEdgeMesh::next(g), vux), xv = beyond(HalfEdgeMesh::previous(g), vux);
  const double before = std::min({uvw.dot(vux), uvw.dot(vw), uvw.dot(wu), vux.dot(ux), vux.dot(xv)});
  const double after = std::min({xwu.dot(wxv), wxv.dot(vw), xwu.dot(wu), xwu.dot(ux), wxv.dot(xv)});
  return after >= std::min(before, kHarmlessBend);
}

bool isConvexAndUpright(const Quad& q) {
  const Vec3 mean = (unitNormal(q.u, q.v, q.w) + unitNormal(q.v, q.u, q.x)).normalized();
  const auto turnsLeft = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    return (b - a).cross(c - b).dot(mean) > 0;
  };
  if (!turnsLeft(q.u, q.x, q.v) || !turnsLeft(q.x, q.v, q.w) || !turnsLeft(q.v, q.w, q.u) ||
      !turnsLeft(q.w, q.u, q.x)) {
    return false;
  }
  return unitNormal(q.x, q.w, q.u).dot(mean) >= kMayTurn && unitNormal(q.w, q.x, q.v).dot(mean) >= kMayTurn;
}

bool touchesCrease(const std::vector<VertexKind>& kinds, const std::array<Index, 4>& corners) {
  return std::any_of(corners.begin(), corners.end(), [&](Index v) { return kinds[v] == VertexKind::Crease; });
}

bool staysFlat(const Quad& q) {
  const Vec3 uvw = unitNormal(q.u, q.v, q.w), vux = unitNormal(q.v, q.u, q.x);
  const Vec3 xwu = unitNormal(q.x, q.w, q.u), wxv = unitNormal(q.w, q.x, q.v);
  return std::min({uvw.dot(vux), xwu.dot(wxv), xwu.dot(uvw), xwu.dot(vux)}) >= kHarmlessBend;
}

bool keepsFan(const HalfEdgeMesh& mesh, Index vertex) {
  return mesh.degree(vertex) > (mesh.isInterior(vertex) ? 3 : 1);
}

bool mayFlip(const HalfEdgeMesh& mesh, const std::vector<Vec3>& position, Index h, const Quad& q,
             bool guard) {
  if (isDegenerate(q.x, q.w, q.u) || isDegenerate(q.w, q.x, q.v)) return false;
  if (guard && (!isConvexAndUpright(q) || !bendsNoWorse(mesh, position, h, q))) return false;
  return keepsFan(mesh, mesh.origin(h)) && keepsFan(mesh, mesh.target(h));
}

// The half-edge on the other side, if there is one and its number is higher; else kNone.
Index beyondLower(const HalfEdgeMesh& mesh, Index h) {
  const Index g = mesh.alive(HalfEdgeMesh::triangleOf(h)) ? mesh.twin(h) : kNone;
  return g < h ? kNone : g;
}

std::array<Index, 4> cornersAround(const HalfEdgeMesh& mesh, Index h, Index g) {
  return {mesh.origin(h), mesh.target(h), mesh.opposite(h), mesh.opposite(g)};
}

Quad quadOf(const std::vector<Vec3>& position, const std::array<Index, 4>& corners) {
  return {position[corners[0]], position[corners[1]], position[corners[2]], position[corners[3]]};
}

// Which edges are better turned. Looked at in parallel before the first flip; where flips have changed a
// triangle since, it is looked at again.
class Gains {
 public:
  Gains(const HalfEdgeMesh& mesh, const std::vector<Vec3>& position, FlipRule rule, const Context& context)
      : rule_(rule),
        is_better_(3 * static_cast<std::size_t>(mesh.slotCount()), 0),
        changed_(static_cast<std::size_t>(mesh.slotCount()), 0) {
    parallelBlocks(context, is_better_.size(), 4096, [&](std::size_t first, std::size_t last) {
      for (Index h = static_cast<Index>(first); h < static_cast<Index>(last); ++h) {
        const Index g = beyondLower(mesh, h);
        if (g != kNone) is_better_[h] = isBetter(quadOf(position, cornersAround(mesh, h, g)), rule);
      }
    });
  }

  bool isKnown(Index h, Index g) const {
    return !changed_[HalfEdgeMesh::triangleOf(h)] && !changed_[HalfEdgeMesh::triangleOf(g)];
  }
  bool isGain(Index h, Index g, const Quad& quad) const {
    return isKnown(h, g) ? is_better_[h] != 0 : isBetter(quad, rule_);
  }
  bool isKnownLoss(Index h, Index g) const { return is_better_[h] == 0 && isKnown(h, g); }
  void noteFlip(Index h, Index g) {
    changed_[HalfEdgeMesh::triangleOf(h)] = changed_[HalfEdgeMesh::triangleOf(g)] = 1;
  }

 private:
  const FlipRule rule_;
  std::vector<char> is_better_;
  std::vector<char> changed_;
};

// The edges that may look different from when they were last left as they are, by their lower half-edge: all
// that decides about an edge hangs on the triangles around the four corners of its quad. Taken in order;
// those that a flip adds behind the current one still in this round, the others in the next.
class Disturbed {
 public:
  explicit Disturbed(const HalfEdgeMesh& mesh)
      : mesh_(mesh), now_(3 * static_cast<std::size_t>(mesh.slotCount()), 1), next_(now_.size(), 0) {}

  void startRound() {
    now_.swap(next_);
    std::fill(next_.begin(), next_.end(), 0);
  }
  /// The first one from `half_edge` on, which is so no longer, or the number of half-edges.
  Index take(Index half_edge) {
    const std::size_t from = static_cast<std::size_t>(half_edge);
    void* const place = from < now_.size() ? std::memchr(&now_[from], 1, now_.size() - from) : nullptr;
    if (!place) return static_cast<Index>(now_.size());
    char* const found = static_cast<char*>(place);
    *found = 0;
    return static_cast<Index>(found - now_.data());
  }
  void noteFlip(const std::array<Index, 4>& corners) {
    for (const Index v : corners) {
      for (Index h = mesh_.firstOutgoing(v); h != kNone; h = mesh_.nextOutgoing(h)) {
        const Index first = 3 * HalfEdgeMesh::triangleOf(h);
        for (Index side = first; side < first + 3; ++side) {
          const Index lower = mesh_.isBorder(side) ? side : std::min(side, mesh_.twin(side));
          now_[lower] = next_[lower] = 1;
        }
      }
    }
  }

 private:
  const HalfEdgeMesh& mesh_;
  std::vector<char> now_;
  std::vector<char> next_;
};

}  // namespace

Index flipEdges(HalfEdgeMesh& mesh, const std::vector<Vec3>& position, FlipRule rule, bool guard,
                const Context& context, const std::vector<VertexKind>* kinds,
                std::vector<FlippedPair>* flips) {
  if (rule == FlipRule::NoFlips) return 0;
  Index total = 0;
  Gains gains(mesh, position, rule, context);
  Disturbed disturbed(mesh);
  const Index end = 3 * mesh.slotCount();
  for (int round = 0; round < kRounds; ++round) {
    context.checkCancelled();
    Index flipped = 0;
    CancelCheck check(context);
    for (Index h = disturbed.take(0); h < end; h = disturbed.take(h + 1)) {
      check();
      const Index g = beyondLower(mesh, h);
      if (g == kNone || gains.isKnownLoss(h, g)) continue;
      const std::array<Index, 4> corners = cornersAround(mesh, h, g);
      const Quad q = quadOf(position, corners);
      if (!gains.isGain(h, g, q)) continue;
      if (kinds && touchesCrease(*kinds, corners) && !staysFlat(q)) continue;
      if (kinds && !PatchEdges(mesh, *kinds).mayFlip(h)) continue;
      if (!mayFlip(mesh, position, h, q, guard) || !mesh.flip(h)) continue;
      ++flipped;
      gains.noteFlip(h, g);
      disturbed.noteFlip(corners);
      if (flips) flips->push_back({HalfEdgeMesh::triangleOf(h), HalfEdgeMesh::triangleOf(g)});
    }
    total += flipped;
    if (flipped == 0) break;
    disturbed.startRound();
  }
  return total;
}

}  // namespace mlsmesh::core
