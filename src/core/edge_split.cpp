// SPDX-License-Identifier: BSD-3-Clause
// This work is based on B. Mederos, L. Velho, L. H. de Figueiredo, "Moving least squares multiresolution
// surface approximation", SIBGRAPI 2003, section 2.4. Departures: all marked edges of a triangle are split at
// once by template, which keeps children well shaped and does not depend on an order; and a child that folds
// back pulls its new vertices in (a fold guard), because a projection near a second sheet can turn a child
// over.
#include "edge_split.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mlsmesh/core/parallel.h"
#include "overlap_tests.h"

namespace mlsmesh::core {
namespace {

constexpr double kRadians = 3.14159265358979323846 / 180.0;
constexpr double kDegenerate = 1e-9;  // twice the area over the squared longest edge
constexpr int kOnMidpoint = 3;  // stages of a pulled vertex: 1/2, 1/4, 0 of its displacement, then unmarked
constexpr int kUnmarked = 4;

double squaredLongest(const Vec3& a, const Vec3& b, const Vec3& c) {
  return std::max({(a - b).squaredNorm(), (b - c).squaredNorm(), (c - a).squaredNorm()});
}

// Whether child (a, b, c) is degenerate or turned farther from `normal` than the limit.
class ChildTest {
 public:
  explicit ChildTest(double fold_angle)
      : guards_folds_(fold_angle >= 0), least_cosine_(std::cos(fold_angle * kRadians)) {}

  bool isBad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& normal) const {
    const Vec3 area = (b - a).cross(c - a);
    const double size = area.norm();
    if (!(size > kDegenerate * squaredLongest(a, b, c))) return true;
    return guards_folds_ && area.dot(normal) < least_cosine_ * size;
  }

 private:
  bool guards_folds_;
  double least_cosine_;
};

// One triangle with its three edges; new vertices are named by ~edge until they have a number.
class Template {
 public:
  Template(const HalfEdgeMesh& mesh, const std::vector<Vec3>& position, const std::vector<Index>& edge_of,
           const std::vector<SplitEdge>& edges, Index triangle)
      : position_(position), edges_(edges), corner_(mesh.corners(triangle)) {
    for (int i = 0; i < 3; ++i) edge_[i] = edge_of[3 * triangle + i];
  }

  const Vec3& at(Index name) const { return name >= 0 ? position_[name] : edges_[~name].position; }
  Index edge(int i) const { return edge_[i]; }
  Vec3 parentNormal() const { return unitNormal(at(corner_[0]), at(corner_[1]), at(corner_[2])); }

  /// Appends the children.
  void divide(std::vector<Triangle>& children) const {
    const bool marked[3] = {isMarked(0), isMarked(1), isMarked(2)};
    const int count = marked[0] + marked[1] + marked[2];
    if (count == 0) {
      children.push_back(corner_);
    } else if (count == 1) {
      divideOnce(marked[0] ? 0 : marked[1] ? 1 : 2, children);
    } else if (count == 2) {
      divideTwice(!marked[0] ? 0 : !marked[1] ? 1 : 2, children);
    } else {
      for (int i = 0; i < 3; ++i) children.push_back({corner_[i], middle(i), middle((i + 2) % 3)});
      children.push_back({middle(0), middle(1), middle(2)});
    }
  }

 private:
  bool isMarked(int i) const { return edges_[edge_[i]].marked; }
  Index middle(int i) const { return ~edge_[i % 3]; }

  void divideOnce(int side, std::vector<Triangle>& children) const {
    const Index a = corner_[side], b = corner_[(side + 1) % 3], c = corner_[(side + 2) % 3], m = middle(side);
    children.push_back({a, m, c});
    children.push_back({m, b, c});
  }

  // `whole` is the side that is not split; the corner opposite to it is cut off and the quad halved.
  void divideTwice(int whole, std::vector<Triangle>& children) const {
    const Index a = corner_[whole], b = corner_[(whole + 1) % 3], c = corner_[(whole + 2) % 3];
    const Index on_bc = middle(whole + 1), on_ca = middle(whole + 2);
    children.push_back({on_ca, on_bc, c});
    const double from_a = (at(a) - at(on_bc)).squaredNorm();
    const double from_b = (at(b) - at(on_ca)).squaredNorm();
    const bool cut_from_a = from_a != from_b ? from_a < from_b : a < b;
    if (cut_from_a) {
      children.push_back({a, b, on_bc});
      children.push_back({a, on_bc, on_ca});
    } else {
      children.push_back({a, b, on_ca});
      children.push_back({b, on_bc, on_ca});
    }
  }

  const std::vector<Vec3>& position_;
  const std::vector<SplitEdge>& edges_;
  Triangle corner_;
  std::array<Index, 3> edge_{};
};

bool usesNew(const Triangle& child, Index edge) {
  return std::find(child.begin(), child.end(), ~edge) != child.end();
}

void pull(SplitEdge& edge, int stage, const Vec3& full, Rounding rounding) {
  constexpr double kShare[] = {1, 0.5, 0.25, 0};
  if (stage >= kUnmarked) {
    edge.marked = false;
    return;
  }
  edge.kind = VertexKind::FoldGuarded;
  edge.position = stage == kOnMidpoint
                      ? edge.midpoint
                      : rounding.stored(edge.midpoint + kShare[stage] * (full - edge.midpoint));
}

// Marks in `bad` the edges whose new vertices belong to a bad child.
void findBad(const HalfEdgeMesh& mesh, const std::vector<Vec3>& position, const std::vector<Index>& edge_of,
             const std::vector<SplitEdge>& edges, const ChildTest& test, const Context& context,
             std::vector<char>& bad_children) {
  parallelBlocks(
      context, static_cast<std::size_t>(mesh.slotCount()), 1024, [&](std::size_t first, std::size_t last) {
        std::vector<Triangle> children;
        for (std::size_t t = first; t < last; ++t) {
          const Template pattern(mesh, position, edge_of, edges, static_cast<Index>(t));
          children.clear();
          pattern.divide(children);
          char bad = 0;
          if (children.size() > 1) {
            const Vec3 normal = pattern.parentNormal();
            for (const Triangle& child : children) {
              if (!test.isBad(pattern.at(child[0]), pattern.at(child[1]), pattern.at(child[2]), normal))
                continue;
              for (int i = 0; i < 3; ++i)
                bad = static_cast<char>(bad | (usesNew(child, pattern.edge(i)) << i));
            }
          }
          bad_children[t] = bad;
        }
      });
}

void guardFolds(const HalfEdgeMesh& mesh, const std::vector<Vec3>& position,
                const std::vector<Index>& edge_of, const ChildTest& test, Rounding rounding,
                const Context& context, std::vector<SplitEdge>& edges) {
  std::vector<char> bad_children(static_cast<std::size_t>(mesh.slotCount()));
  std::vector<char> stage(edges.size(), 0);
  std::vector<Vec3> full(edges.size());
  for (std::size_t e = 0; e < edges.size(); ++e) full[e] = edges[e].position;
  for (bool changed = true; changed;) {
    changed = false;
    findBad(mesh, position, edge_of, edges, test, context, bad_children);
    std::vector<char> pulled(edges.size(), 0);
    for (Index t = 0; t < mesh.slotCount(); ++t) {
      for (int i = 0; i < 3; ++i) {
        const Index e = edge_of[3 * t + i];
        if (!(bad_children[t] >> i & 1) || pulled[e] || !edges[e].marked) continue;
        pulled[e] = 1;
        changed = true;
        pull(edges[e], ++stage[e], full[e], rounding);
      }
    }
  }
}

double edgeRatio(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double x = (a - b).norm(), y = (b - c).norm(), z = (c - a).norm();
  return std::min({x, y, z}) / std::max({x, y, z});
}

}  // namespace

std::vector<Triangle> splitByTemplates(const HalfEdgeMesh& mesh, const std::vector<Vec3>& position,
                                       const std::vector<Index>& edge_of, double fold_angle,
                                       Rounding rounding, const Context& context,
                                       std::vector<SplitEdge>& edges) {
  guardFolds(mesh, position, edge_of, ChildTest(fold_angle), rounding, context, edges);
  std::vector<Index> number(edges.size());
  Index next = static_cast<Index>(position.size());
  for (std::size_t e = 0; e < edges.size(); ++e) number[e] = edges[e].marked ? next++ : kNone;
  std::vector<Triangle> triangles;
  triangles.reserve(4 * static_cast<std::size_t>(mesh.slotCount()));
  for (Index t = 0; t < mesh.slotCount(); ++t) {
    const std::size_t first = triangles.size();
    Template(mesh, position, edge_of, edges, t).divide(triangles);
    for (std::size_t i = first; i < triangles.size(); ++i) {
      for (Index& name : triangles[i]) name = name >= 0 ? name : number[~name];
    }
  }
  return triangles;
}

std::vector<Triangle> splitOneByOne(const HalfEdgeMesh& mesh, const std::vector<Vec3>& position,
                                    double min_edge_ratio, double fold_angle, Rounding rounding,
                                    std::vector<SplitEdge>& edges) {
  HalfEdgeMesh work = mesh;
  std::vector<Vec3> at = position;
  const ChildTest test(fold_angle);
  const auto mayDivide = [&](Index h, const Vec3& middle) {
    const Vec3 &u = at[work.origin(h)], &v = at[work.target(h)], &w = at[work.opposite(h)];
    const Vec3 normal = unitNormal(u, v, w);
    return edgeRatio(u, v, w) >= min_edge_ratio && !test.isBad(u, middle, w, normal) &&
           !test.isBad(middle, v, w, normal);
  };
  for (SplitEdge& edge : edges) {
    if (!edge.marked) continue;
    const Index u = mesh.origin(edge.half_edge), v = mesh.target(edge.half_edge);
    const Index sides[2] = {work.find(u, v), work.find(v, u)};
    const auto fits = [&] {
      return std::all_of(sides, sides + 2,
                         [&](Index h) { return h == kNone || mayDivide(h, edge.position); });
    };
    const Vec3 full = edge.position;
    int stage = 0;
    while (edge.marked && !fits()) pull(edge, fold_angle >= 0 ? ++stage : kUnmarked, full, rounding);
    if (!edge.marked) continue;
    const Index middle = work.addVertex();
    at.push_back(edge.position);
    for (const Index h : sides) {
      if (h == kNone) continue;
      const Index from = work.origin(h), to = work.target(h), apex = work.opposite(h);
      work.removeTriangle(HalfEdgeMesh::triangleOf(h));
      work.addTriangle(from, middle, apex);
      work.addTriangle(middle, to, apex);
    }
  }
  return work.triangles();
}

}  // namespace mlsmesh::core
