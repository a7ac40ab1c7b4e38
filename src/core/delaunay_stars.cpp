// SPDX-License-Identifier: BSD-3-Clause
// This work is based on:
// - M. Gopi, S. Krishnan, C. T. Silva, "Surface reconstruction based on lower dimensional localized Delaunay
//   triangulation", Eurographics 2000: stars in tangent planes.
// - U. Adamy, J. Giesen, M. John, "Surface reconstruction using umbrella filters", 2002.
// - D. Boltcheva, B. Levy, "Surface reconstruction by computing restricted Voronoi cells in parallel", 2017:
// cells by
//   clipping, and the agreement of all three corners.
// The bisectors take the distances in space, not in the plane: the cells are then those of a power diagram,
// on which neighbouring points agree more often. Cocircular points (lattices, CAD grids) are ties, which
// every point would break in its own way; a weight of 1e-5 squared spacings that depends on the point alone
// breaks them in the same way for all.
#include "delaunay_stars.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "mlsmesh/core/parallel.h"

namespace mlsmesh::core {
namespace {

using Vec2 = Eigen::Vector2d;

constexpr int kMaxCorners = 64;
constexpr int kNormalNeighbors = 12;
constexpr double kTieWeight = 1e-5;
constexpr double kReachSlack = 1.01;  // a tied neighbour may still cut the cell by its weight

// A convex polygon round the origin; edge i runs from corner i to corner i + 1 and belongs to neighbour
// label[i].
class Cell {
 public:
  explicit Cell(double half_width) {
    push(now(), Vec2(-half_width, -half_width), kNone);
    push(now(), Vec2(half_width, -half_width), kNone);
    push(now(), Vec2(half_width, half_width), kNone);
    push(now(), Vec2(-half_width, half_width), kNone);
  }

  int size() const { return now().count; }
  Index label(int edge) const { return now().label[edge]; }

  double squaredRadius() const {
    double radius = 0;
    for (int i = 0; i < size(); ++i) radius = std::max(radius, now().corner[i].squaredNorm());
    return radius;
  }

  // Keeps the side <direction, x> <= offset; false where that is all of the cell.
  bool clip(const Vec2& direction, double offset, Index neighbor) {
    const Polygon& whole = now();
    std::array<double, kMaxCorners> excess;
    double most = 0;
    for (int i = 0; i < whole.count; ++i) {
      excess[i] = direction.dot(whole.corner[i]) - offset;
      most = std::max(most, excess[i]);
    }
    if (!(most > 0) || whole.count + 2 > kMaxCorners) return false;
    now_ = 1 - now_;
    now().count = 0;
    for (int i = 0; i < whole.count; ++i) {
      const int j = i + 1 < whole.count ? i + 1 : 0;
      const bool inside = excess[i] <= 0;
      if (inside) push(now(), whole.corner[i], whole.label[i]);
      if (inside == (excess[j] <= 0)) continue;
      const double t = excess[i] / (excess[i] - excess[j]);
      const Vec2 crossing = whole.corner[i] + t * (whole.corner[j] - whole.corner[i]);
      push(now(), crossing, inside ? neighbor : whole.label[i]);
    }
    return true;
  }

 private:
  struct Polygon {
    std::array<Vec2, kMaxCorners> corner;
    std::array<Index, kMaxCorners> label;
    int count = 0;
  };

  const Polygon& now() const { return polygon_[now_]; }
  Polygon& now() { return polygon_[now_]; }

  static void push(Polygon& polygon, const Vec2& position, Index neighbor) {
    polygon.corner[polygon.count] = position;
    polygon.label[polygon.count++] = neighbor;
  }

  std::array<Polygon, 2> polygon_;  // each cut writes what it leaves of one into the other
  std::size_t now_ = 0;
};

double tieWeight(Index point, double spacing) {
  std::uint32_t x = static_cast<std::uint32_t>(point) * 2654435769u;  // Knuth's multiplicative hash
  x ^= x >> 15;
  x *= 2246822519u;
  x ^= x >> 13;
  return kTieWeight * spacing * spacing * (x / 4294967296.0);
}

class StarBuilder {
 public:
  StarBuilder(const std::vector<Vec3>& points, const std::vector<Vec3>& normals,
              const NeighborTable& neighbors, const std::vector<double>& spacing, double length_factor)
      : points_(points),
        normals_(normals),
        neighbors_(neighbors),
        spacing_(spacing),
        length_factor_(length_factor) {}

  void appendStar(Index p, std::vector<Index>& ring) const {
    const Vec3& normal = normals_[p];
    const Vec3 u = normal.unitOrthogonal();
    const Vec3 v = normal.cross(u);
    Cell cell(length_factor_ * spacing_[p]);
    double squared_radius = cell.squaredRadius();
    const double own_weight = tieWeight(p, spacing_[p]);
    const Index* row = neighbors_.row(p);
    for (int i = 0; i < neighbors_.k; ++i) {
      const Index q = row[i];
      const Vec3 d = points_[q] - points_[p];
      const double squared = d.squaredNorm();
      if (squared > kReachSlack * 4 * squared_radius) break;
      const double limit = length_factor_ * std::max(spacing_[p], spacing_[q]);
      if (squared > limit * limit) continue;
      const double offset = squared + own_weight - tieWeight(q, spacing_[q]);
      if (cell.clip(Vec2(2 * d.dot(u), 2 * d.dot(v)), offset, q)) squared_radius = cell.squaredRadius();
    }
    appendLabels(cell, ring);
  }

 private:
  static void appendLabels(const Cell& cell, std::vector<Index>& ring) {
    const std::size_t first = ring.size();
    for (int i = 0; i < cell.size(); ++i) {
      if (ring.size() == first || ring.back() != cell.label(i)) ring.push_back(cell.label(i));
    }
    if (ring.size() > first + 1 && ring.back() == ring[first]) ring.pop_back();
  }

  const std::vector<Vec3>& points_;
  const std::vector<Vec3>& normals_;
  const NeighborTable& neighbors_;
  const std::vector<double>& spacing_;
  const double length_factor_;
};

// A position in the ring of a point: the pair (ring[slot], ring[slot + 1]) spans a triangle with it.
Index nextInRing(const StarRings& stars, Index point, Index slot) {
  const Index size = stars.size(point);
  return slot + 1 < size ? slot + 1 : slot + 1 - size;
}

// The slot of `point` that spans a triangle with a and b, in either order, or kNone.
Index slotOf(const StarRings& stars, Index point, Index a, Index b) {
  const Index* ring = stars.data(point);
  for (Index slot = 0; slot < stars.size(point); ++slot) {
    const Index x = ring[slot];
    const Index y = ring[nextInRing(stars, point, slot)];
    if ((x == a && y == b) || (x == b && y == a)) return slot;
  }
  return kNone;
}

// A triangle of the stars of all its corners: its lowest corner, and its places in their rings, counted over
// all rings; that of the lowest corner first, then those of the two that follow there.
struct AgreedTriangle {
  Index lowest;
  std::array<Index, 3> slot;
};

// Every slot of every ring gets the agreed triangle that it spans, or kNone.
struct AgreedTriangles {
  std::vector<AgreedTriangle> triangles;
  std::vector<Index> of_slot;

  Index count() const { return static_cast<Index>(triangles.size()); }
};

// Where the two others have the triangle that a slot spans with its point, which is the lowest of the three:
// slots counted in their own rings, which are short.
struct OtherSlots {
  static constexpr std::uint8_t kNowhere = 255;
  static_assert(kMaxCorners < kNowhere);

  std::uint8_t at_first = kNowhere;  // unless all agree
  std::uint8_t at_second = kNowhere;
};

OtherSlots otherSlots(const StarRings& stars, Index p, Index slot) {
  const Index a = stars.data(p)[slot];
  const Index b = stars.data(p)[nextInRing(stars, p, slot)];
  if (a <= p || b <= p || a == b) return {};  // kNone is below every point
  const Index at_a = slotOf(stars, a, b, p);
  const Index at_b = at_a == kNone ? kNone : slotOf(stars, b, p, a);
  if (at_b == kNone) return {};
  return {static_cast<std::uint8_t>(at_a), static_cast<std::uint8_t>(at_b)};
}

AgreedTriangles findAgreed(const StarRings& stars, const Context& context) {
  std::vector<OtherSlots> others(stars.items.size());
  parallelBlocks(context, static_cast<std::size_t>(stars.count()), 4096,
                 [&](std::size_t first, std::size_t last) {
                   for (Index p = static_cast<Index>(first); p < static_cast<Index>(last); ++p) {
                     for (Index slot = 0; slot < stars.size(p); ++slot)
                       others[stars.begin[p] + slot] = otherSlots(stars, p, slot);
                   }
                 });
  AgreedTriangles agreed;
  agreed.triangles.reserve(
      static_cast<std::size_t>(std::count_if(others.begin(), others.end(), [](const OtherSlots& slots) {
        return slots.at_first != OtherSlots::kNowhere;
      })));
  agreed.of_slot.assign(stars.items.size(), kNone);
  CancelCheck check(context);
  for (Index p = 0; p < stars.count(); ++p) {
    check();
    for (Index slot = 0; slot < stars.size(p); ++slot) {
      const OtherSlots& other = others[stars.begin[p] + slot];
      if (other.at_first == OtherSlots::kNowhere) continue;
      const Index a = stars.data(p)[slot];
      const Index b = stars.data(p)[nextInRing(stars, p, slot)];
      const AgreedTriangle triangle{
          p, {stars.begin[p] + slot, stars.begin[a] + other.at_first, stars.begin[b] + other.at_second}};
      for (const Index place : triangle.slot) agreed.of_slot[place] = agreed.count();
      agreed.triangles.push_back(triangle);
    }
  }
  return agreed;
}

// Islands found by walking from triangle to triangle over the edges that they share.
class IslandWalk {
 public:
  IslandWalk(const StarRings& stars, const AgreedTriangles& agreed, const Context& context)
      : stars_(stars),
        agreed_(agreed),
        check_(context),
        island_(agreed.triangles.size(), kNone),
        turned_(agreed.triangles.size(), 0) {}

  Islands run() {
    for (Index start = 0; start < agreed_.count(); ++start) {
      check_();
      if (island_[start] == kNone) walkFrom(start);
    }
    return collect();
  }

 private:
  void walkFrom(Index start) {
    const Index island = static_cast<Index>(size_.size());
    island_[start] = island;
    open_.assign(1, start);
    for (std::size_t next = 0; next < open_.size(); ++next) {
      check_();
      const Triangle corners = oriented(open_[next]);
      for (int i = 0; i < 3; ++i) {
        const Index other = across(open_[next], corners[i], corners[(i + 1) % 3]);
        if (other == kNone || island_[other] != kNone) continue;
        island_[other] = island;
        turned_[other] = runs(cornersOf(other), corners[i], corners[(i + 1) % 3]);
        open_.push_back(other);
      }
    }
    size_.push_back(static_cast<Index>(open_.size()));
  }

  // The lowest first, counter-clockwise about its normal.
  Triangle cornersOf(Index triangle) const {
    const auto& [lowest, slot] = agreed_.triangles[triangle];
    const Index next = slot[0] + 1 == stars_.begin[lowest + 1] ? stars_.begin[lowest] : slot[0] + 1;
    return {lowest, stars_.items[slot[0]], stars_.items[next]};
  }

  Triangle oriented(Index triangle) const {
    const auto [a, b, c] = cornersOf(triangle);
    return turned_[triangle] ? Triangle{b, a, c} : Triangle{a, b, c};
  }

  static bool runs(const Triangle& corner, Index v, Index w) {
    return (corner[0] == v && corner[1] == w) || (corner[1] == v && corner[2] == w) ||
           (corner[2] == v && corner[0] == w);
  }

  // The agreed triangle beyond the edge from v to w: in the ring of v it is on the other side of w.
  Index across(Index triangle, Index v, Index w) const {
    const Triangle corners = cornersOf(triangle);
    const std::array<Index, 3>& slots = agreed_.triangles[triangle].slot;
    const Index slot = slots[corners[0] == v ? 0 : corners[1] == v ? 1 : 2];
    const Index begin = stars_.begin[v], end = stars_.begin[v + 1];
    const bool is_first = stars_.items[slot] == w;
    if (is_first) return agreed_.of_slot[slot == begin ? end - 1 : slot - 1];
    return agreed_.of_slot[slot + 1 == end ? begin : slot + 1];
  }

  // The triangles of each island in their order, the largest island first.
  Islands collect() {
    std::vector<Index> order(size_.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return size_[a] > size_[b]; });
    Islands islands;
    std::vector<Index> place(size_.size());
    for (const Index island : order) {
      place[island] = islands.begin.back();
      islands.begin.push_back(islands.begin.back() + size_[island]);
    }
    islands.triangles.resize(agreed_.triangles.size());
    for (Index t = 0; t < agreed_.count(); ++t) {
      check_();
      islands.triangles[place[island_[t]]++] = oriented(t);
    }
    return islands;
  }

  const StarRings& stars_;
  const AgreedTriangles& agreed_;
  CancelCheck check_;
  std::vector<Index> island_;
  std::vector<char> turned_;
  std::vector<Index> size_;
  std::vector<Index> open_;
};

}  // namespace

std::vector<Vec3> tangentNormals(const std::vector<Vec3>& points, const NeighborTable& neighbors,
                                 const Context& context, std::vector<char>* on_line) {
  constexpr double kLine = 0.1;  // ratio of the spreads
  std::vector<Vec3> normals(points.size());
  if (on_line) on_line->assign(points.size(), 0);
  const int count = std::min(kNormalNeighbors, neighbors.k);
  parallelBlocks(context, points.size(), 2048, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const Index* row = neighbors.row(static_cast<Index>(i));
      Vec3 mean = Vec3::Zero();
      for (int j = 0; j < count; ++j) mean += points[row[j]] - points[i];
      mean /= count + 1;
      Eigen::Matrix3d covariance = mean * mean.transpose();
      for (int j = 0; j < count; ++j) {
        const Vec3 d = points[row[j]] - points[i] - mean;
        covariance.noalias() += d * d.transpose();
      }
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
      solver.computeDirect(covariance);
      normals[i] = solver.eigenvectors().col(0);
      const Vec3 spread = solver.eigenvalues();
      if (on_line) (*on_line)[i] = spread[1] < kLine * spread[2];
    }
  });
  return normals;
}

StarRings localStars(const std::vector<Vec3>& points, const std::vector<Vec3>& normals,
                     const NeighborTable& neighbors, const std::vector<double>& spacing, double length_factor,
                     const Context& context) {
  constexpr std::size_t kBlock = 2048;
  const std::size_t blocks = (points.size() + kBlock - 1) / kBlock;
  std::vector<std::vector<Index>> items(blocks);
  StarRings stars;
  stars.begin.assign(points.size() + 1, 0);
  const StarBuilder builder(points, normals, neighbors, spacing, length_factor);
  parallelBlocks(context, points.size(), kBlock, [&](std::size_t first, std::size_t last) {
    std::vector<Index>& ring = items[first / kBlock];
    ring.reserve(8 * (last - first));
    for (std::size_t i = first; i < last; ++i) {
      const std::size_t before = ring.size();
      builder.appendStar(static_cast<Index>(i), ring);
      stars.begin[i + 1] = static_cast<Index>(ring.size() - before);
    }
  });
  std::partial_sum(stars.begin.begin(), stars.begin.end(), stars.begin.begin());
  stars.items.reserve(static_cast<std::size_t>(stars.begin.back()));
  for (auto& block : items) {
    context.checkCancelled();
    stars.items.insert(stars.items.end(), block.begin(), block.end());
    std::vector<Index>().swap(block);
  }
  return stars;
}

Islands agreedIslands(const StarRings& stars, const Context& context) {
  const AgreedTriangles agreed = findAgreed(stars, context);
  return IslandWalk(stars, agreed, context).run();
}

}  // namespace mlsmesh::core
