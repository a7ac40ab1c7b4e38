// SPDX-License-Identifier: BSD-3-Clause
// This work is based on N. Dyn, K. Hormann, S.-J. Kim, D. Levin, "Optimizing 3D triangulations using discrete
// curvature analysis", 2001: edges are flipped where that lowers a cost, largest gain first. Departure: the
// cost compares triangles with the normals of the cloud at their corners, of which a crease vertex has two or
// three.
#include "side_flips.h"

#include <algorithm>
#include <cmath>

#include "overlap_tests.h"

namespace mlsmesh::core {
namespace {

constexpr int kPasses = 4;
constexpr double kLeastGain = 0.05;
constexpr double kSliverCost = 5;
constexpr double kSliver = 0.02;       // twice the area over the sum of the squared edges
constexpr double kSharpest = -0.5;     // cosine between the two new triangles
constexpr double kSharpestOut = -0.7;  // cosine between a new triangle and one around it, or as before

struct Flip {
  double gain;
  Index half_edge;
};

class SideFlips {
 public:
  SideFlips(HalfEdgeMesh& mesh, const std::vector<Vec3>& position, const std::vector<VertexSides>& sides)
      : mesh_(mesh), x_(position), sides_(sides) {}

  Index pass() {
    std::vector<Flip> flips;
    for (Index h = 0; h < 3 * mesh_.slotCount(); ++h) {
      if (mesh_.isBorder(h) || mesh_.twin(h) < h) continue;
      const double gain = gainOf(h);
      if (gain > kLeastGain) flips.push_back({gain, h});
    }
    std::sort(flips.begin(), flips.end(), [](const Flip& a, const Flip& b) {
      return a.gain > b.gain || (a.gain == b.gain && a.half_edge < b.half_edge);
    });
    Index done = 0;
    for (const Flip& flip : flips) {
      if (gainOf(flip.half_edge) > kLeastGain && mesh_.flip(flip.half_edge)) ++done;
    }
    return done;
  }

 private:
  double costAt(Index corner, const Vec3& normal) const {
    const VertexSides& sides = sides_[corner];
    double least = 1;
    for (int i = 0; i < sides.count; ++i) {
      least = std::min(least, 1 - std::abs(sides.normal[static_cast<std::size_t>(i)].dot(normal)));
    }
    return least;
  }

  double costOf(Index a, Index b, Index c) const {
    const Vec3 area = (x_[b] - x_[a]).cross(x_[c] - x_[a]);
    const double squares =
        (x_[b] - x_[a]).squaredNorm() + (x_[c] - x_[b]).squaredNorm() + (x_[a] - x_[c]).squaredNorm();
    const double size = area.norm();
    if (!(size >= kSliver * squares)) return kSliverCost;
    const Vec3 normal = area / size;
    return costAt(a, normal) + costAt(b, normal) + costAt(c, normal);
  }

  // What flipping the edge saves; nothing where it may not be flipped.
  double gainOf(Index h) const {
    const Index g = mesh_.twin(h);
    if (g == kNone) return 0;
    const Index u = mesh_.origin(h), v = mesh_.target(h), w = mesh_.opposite(h), x = mesh_.opposite(g);
    for (const Index corner : {u, v, w, x}) {
      if (sides_[corner].count == 0) return 0;
    }
    const double gain = costOf(u, v, w) + costOf(v, u, x) - costOf(x, w, u) - costOf(w, x, v);
    return gain > kLeastGain && mayFlip(h, g) ? gain : 0;
  }

  Vec3 normalOf(Index a, Index b, Index c) const { return unitNormal(x_[a], x_[b], x_[c]); }

  Vec3 beyond(Index half_edge, const Vec3& otherwise) const {
    const Index g = mesh_.twin(half_edge);
    return g == kNone ? otherwise : normalOf(mesh_.origin(g), mesh_.target(g), mesh_.opposite(g));
  }

  bool keepsFan(Index vertex) const { return mesh_.degree(vertex) > (mesh_.isInterior(vertex) ? 3 : 1); }

  bool mayFlip(Index h, Index g) const {
    const Index u = mesh_.origin(h), v = mesh_.target(h), w = mesh_.opposite(h), x = mesh_.opposite(g);
    if (!keepsFan(u) || !keepsFan(v)) return false;
    const Vec3 uvw = normalOf(u, v, w), vux = normalOf(v, u, x);
    const Vec3 xwu = normalOf(x, w, u), wxv = normalOf(w, x, v);
    if (xwu.dot(wxv) < kSharpest) return false;
    const Vec3 vw = beyond(HalfEdgeMesh::next(h), uvw), wu = beyond(HalfEdgeMesh::previous(h), uvw);
    const Vec3 ux = beyond(HalfEdgeMesh::next(g), vux), xv = beyond(HalfEdgeMesh::previous(g), vux);
    const double before = std::min({uvw.dot(vw), uvw.dot(wu), vux.dot(ux), vux.dot(xv)});
    const double after = std::min({wxv.dot(vw), xwu.dot(wu), xwu.dot(ux), wxv.dot(xv)});
    return after >= std::min(before, kSharpestOut);
  }

  HalfEdgeMesh& mesh_;
  const std::vector<Vec3>& x_;
  const std::vector<VertexSides>& sides_;
};

}  // namespace

Index flipToSides(HalfEdgeMesh& mesh, const std::vector<Vec3>& position,
                  const std::vector<VertexSides>& sides) {
  SideFlips flips(mesh, position, sides);
  Index total = 0;
  for (int pass = 0; pass < kPasses; ++pass) {
    const Index done = flips.pass();
    total += done;
    if (done == 0) break;
  }
  return total;
}

}  // namespace mlsmesh::core
