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
struct Cell {
  std::array<Vec2, kMaxCorners> corner;
  std::array<Index, kMaxCorners> label;
  int count = 0;

  explicit Cell(double half_width) : count(4) {
    corner = {Vec2(-half_width, -half_width), Vec2(half_width, -half_width), Vec2(half_width, half_width),
              Vec2(-half_width, half_width)};
    label = {kNone, kNone, kNone, kNone};
  }

  double squaredRadius() const {
    double radius = 0;
    for (int i = 0; i < count; ++i) radius = std::max(radius, corner[i].squaredNorm());
    return radius;
  }

  // Keeps the side <direction, x> <= offset.
  void clip(const Vec2& direction, double offset, Index neighbor) {
    std::array<double, kMaxCorners> excess;
    bool cuts = false;
    for (int i = 0; i < count; ++i) {
      excess[i] = direction.dot(corner[i]) - offset;
      cuts = cuts || excess[i] > 0;
    }
    if (!cuts || count + 2 > kMaxCorners) return;
    const int before = count;
    std::array<Vec2, kMaxCorners> corner_before;  // a copy of the corners in use: whole cells take longer
    std::array<Index, kMaxCorners> label_before;
    std::copy_n(corner.begin(), before, corner_before.begin());
    std::copy_n(label.begin(), before, label_before.begin());
    count = 0;
    for (int i = 0; i < before; ++i) {
      const int j = i + 1 < before ? i + 1 : 0;
      const bool inside = excess[i] <= 0;
      const bool next_inside = excess[j] <= 0;
      if (inside) push(corner_before[i], label_before[i]);
      if (inside == next_inside) continue;
      const double t = excess[i] / (excess[i] - excess[j]);
      const Vec2 crossing = corner_before[i] + t * (corner_before[j] - corner_before[i]);
      push(crossing, inside ? neighbor : label_before[i]);
    }
  }

 private:
  void push(const Vec2& position, Index neighbor) {
    corner[count] = position;
    label[count++] = neighbor;
  }
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
      cell.clip(Vec2(2 * d.dot(u), 2 * d.dot(v)), squared + own_weight - tieWeight(q, spacing_[q]), q);
      squared_radius = cell.squaredRadius();
    }
    appendLabels(cell, ring);
  }

 private:
  static void appendLabels(const Cell& cell, std::vector<Index>& ring) {
    const std::size_t first = ring.size();
    for (int i = 0; i < cell.count; ++i) {
      if (ring.size() == first || ring.back() != cell.label[i]) ring.push_back(cell.label[i]);
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

// Every slot of every ring gets the agreed triangle that it spans, or kNone.
struct AgreedTriangles {
  std::vector<Triangle> triangles;  // lowest corner first, counter-clockwise about that corner's normal
  std::vector<Index> of_slot;
};

AgreedTriangles findAgreed(const StarRings& stars, const Context& context) {
  const std::size_t count = static_cast<std::size_t>(stars.count());
  AgreedTriangles agreed;
  agreed.of_slot.assign(stars.items.size(), kNone);
  std::vector<char> mine(stars.items.size(), 0);  // slots of the lowest corner, agreed by the two others
  parallelBlocks(context, count, 4096, [&](std::size_t first, std::size_t last) {
    for (Index p = static_cast<Index>(first); p < static_cast<Index>(last); ++p) {
      const Index* ring = stars.data(p);
      if (stars.size(p) < 2) continue;
      for (Index slot = 0; slot < stars.size(p); ++slot) {
        const Index a = ring[slot];
        const Index b = ring[nextInRing(stars, p, slot)];
        if (a <= p || b <= p || a == b) continue;  // kNone is below every point
        mine[stars.begin[p] + slot] = slotOf(stars, a, b, p) != kNone && slotOf(stars, b, p, a) != kNone;
      }
    }
  });
  for (Index p = 0; p < stars.count(); ++p) {
    const Index* ring = stars.data(p);
    for (Index slot = 0; slot < stars.size(p); ++slot) {
      if (!mine[stars.begin[p] + slot]) continue;
      const Index a = ring[slot];
      const Index b = ring[nextInRing(stars, p, slot)];
      const Index triangle = static_cast<Index>(agreed.triangles.size());
      agreed.triangles.push_back({p, a, b});
      agreed.of_slot[stars.begin[p] + slot] = triangle;
      agreed.of_slot[stars.begin[a] + slotOf(stars, a, b, p)] = triangle;
      agreed.of_slot[stars.begin[b] + slotOf(stars, b, p, a)] = triangle;
    }
  }
  return agreed;
}

// Agreed triangles across the edges of a triangle: on edge (v, w) the other slot of v's ring at w.
Index acrossEdge(const StarRings& stars, const AgreedTriangles& agreed, Index triangle, Index v, Index w) {
  const Index* ring = stars.data(v);
  const Index size = stars.size(v);
  for (Index slot = 0; slot < size; ++slot) {
    if (ring[slot] != w) continue;
    const Index after = agreed.of_slot[stars.begin[v] + slot];
    const Index before = agreed.of_slot[stars.begin[v] + (slot == 0 ? size - 1 : slot - 1)];
    if (after == triangle) return before;
    if (before == triangle) return after;
  }
  return kNone;
}

// The corners of `triangle` turned so that it runs along its edge with {v, w} as w -> v.
Triangle orientedAgainst(Triangle triangle, Index v, Index w) {
  for (int i = 0; i < 3; ++i) {
    if (triangle[i] == v && triangle[(i + 1) % 3] == w) std::swap(triangle[0], triangle[1]);
  }
  return triangle;
}

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
    stars.items.insert(stars.items.end(), block.begin(), block.end());
    std::vector<Index>().swap(block);
  }
  return stars;
}

Islands agreedIslands(const StarRings& stars, const Context& context) {
  const AgreedTriangles agreed = findAgreed(stars, context);
  const Index count = static_cast<Index>(agreed.triangles.size());
  std::vector<char> seen(agreed.triangles.size(), 0);
  std::vector<std::vector<Triangle>> islands;
  std::vector<std::pair<Index, Triangle>> open;
  for (Index start = 0; start < count; ++start) {
    if (seen[start]) continue;
    seen[start] = 1;
    open.assign(1, {start, agreed.triangles[start]});
    for (std::size_t next = 0; next < open.size(); ++next) {
      const auto [triangle, corners] = open[next];
      for (int i = 0; i < 3; ++i) {
        const Index v = corners[i];
        const Index w = corners[(i + 1) % 3];
        const Index other = acrossEdge(stars, agreed, triangle, v, w);
        if (other == kNone || seen[other]) continue;
        seen[other] = 1;
        open.emplace_back(other, orientedAgainst(agreed.triangles[other], v, w));
      }
    }
    std::vector<Triangle>& island = islands.emplace_back();
    island.reserve(open.size());
    for (const auto& entry : open) island.push_back(entry.second);
  }
  std::stable_sort(islands.begin(), islands.end(),
                   [](const auto& a, const auto& b) { return a.size() > b.size(); });
  Islands result;
  result.triangles.reserve(agreed.triangles.size());
  for (const auto& island : islands) {
    result.triangles.insert(result.triangles.end(), island.begin(), island.end());
    result.begin.push_back(static_cast<Index>(result.triangles.size()));
  }
  return result;
}

}  // namespace mlsmesh::core
