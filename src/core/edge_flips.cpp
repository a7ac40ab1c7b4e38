// SPDX-License-Identifier: BSD-3-Clause
// This work is based on B. Mederos, L. Velho, L. H. de Figueiredo, "Moving least squares multiresolution
// surface approximation", SIBGRAPI 2003, section 2.4, and C. L. Lawson, "Software for C1 surface
// interpolation", 1977 (min-angle flips). Departure: flips by length alone, as printed, fold the mesh; the
// default guards them and maximises the smallest angle.
#include "edge_flips.h"

#include <algorithm>
#include <array>
#include <cmath>

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

double cosineAt(const Vec3& apex, const Vec3& a, const Vec3& b) {
  return (a - apex).dot(b - apex) / std::sqrt((a - apex).squaredNorm() * (b - apex).squaredNorm());
}

// Cosine of the smallest angle of a triangle: the largest cosine.
double sharpest(const Vec3& a, const Vec3& b, const Vec3& c) {
  return std::max({cosineAt(a, b, c), cosineAt(b, c, a), cosineAt(c, a, b)});
}

bool isBetter(const Quad& q, FlipRule rule) {
  if (rule == FlipRule::Length) return (q.u - q.v).squaredNorm() > (q.w - q.x).squaredNorm() * (1 + kGain);
  const double before = std::max(sharpest(q.u, q.v, q.w), sharpest(q.v, q.u, q.x));
  const double after = std::max(sharpest(q.x, q.w, q.u), sharpest(q.w, q.x, q.v));
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

// Whether an edge may look different from when it was last left as it is: all that decides about it hangs on
// the triangles around the four corners of its quad.
class Disturbed {
 public:
  explicit Disturbed(Index vertices) : round_(static_cast<std::size_t>(vertices), -1) {}

  bool any(const std::array<Index, 4>& corners, int round) const {
    return std::any_of(corners.begin(), corners.end(), [&](Index v) { return round_[v] + 1 >= round; });
  }
  void note(const std::array<Index, 4>& corners, int round) {
    for (const Index v : corners) round_[v] = round;
  }

 private:
  std::vector<int> round_;  // of the last flip at every vertex
};

}  // namespace

Index flipEdges(HalfEdgeMesh& mesh, const std::vector<Vec3>& position, FlipRule rule, bool guard,
                const std::vector<VertexKind>* kinds, std::vector<FlippedPair>* flips) {
  if (rule == FlipRule::NoFlips) return 0;
  Index total = 0;
  Disturbed disturbed(mesh.vertexCount());
  for (int round = 0; round < kRounds; ++round) {
    Index flipped = 0;
    for (Index h = 0; h < 3 * mesh.slotCount(); ++h) {
      const Index g = mesh.alive(HalfEdgeMesh::triangleOf(h)) ? mesh.twin(h) : kNone;
      if (g == kNone || g < h) continue;
      const std::array<Index, 4> corners = {mesh.origin(h), mesh.target(h), mesh.opposite(h),
                                            mesh.opposite(g)};
      if (!disturbed.any(corners, round)) continue;
      const Quad q{position[corners[0]], position[corners[1]], position[corners[2]], position[corners[3]]};
      if (kinds && touchesCrease(*kinds, corners) && !staysFlat(q)) continue;
      if (kinds && !PatchEdges(mesh, *kinds).mayFlip(h)) continue;
      if (!isBetter(q, rule) || !mayFlip(mesh, position, h, q, guard) || !mesh.flip(h)) continue;
      ++flipped;
      disturbed.note(corners, round);
      if (flips) flips->push_back({HalfEdgeMesh::triangleOf(h), HalfEdgeMesh::triangleOf(g)});
    }
    total += flipped;
    if (flipped == 0) break;
  }
  return total;
}

}  // namespace mlsmesh::core
