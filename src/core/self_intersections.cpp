// SPDX-License-Identifier: BSD-3-Clause
// This work is based on T. Karras, "Maximizing parallelism in the construction of BVHs, octrees, and k-d
// trees", HPG 2012: boxes over triangles in the order of their Morton codes. Departure: the hierarchy is the
// implicit one, runs of equal length of that order, so that it needs no links and one triangle's change is
// passed up in place.
#include "mlsmesh/core/self_intersections.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "exact_predicates.h"
#include "mlsmesh/core/parallel.h"
#include "radix_sort.h"
#include "triangle_meeting.h"

namespace mlsmesh::core {
namespace {

constexpr int kCodeBits = 10;  // of a Morton code, per axis
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kMostLevels = 12;  // 8^12 is more than an index can name
constexpr std::size_t kBlock = 256;      // runs that one thread searches at a time

// The triangles at a vertex, seen along one axis.
struct FanView {
  static constexpr std::uint8_t kNoAxis = 3;

  std::uint8_t axis = kNoAxis;
  std::int8_t side = 0;    // from which they are all seen
  std::uint8_t turns = 0;  // of them, those that a ray from the vertex passes through
  bool fits = true;        // seen from one side, and closed

  /// A triangle whose edge opposite to the vertex starts and ends below it or not.
  void add(std::int8_t seen_from, bool starts_below, bool ends_below) {
    fits = fits && seen_from != 0 && seen_from != -side && turns < 2;
    side = seen_from;
    const bool rises = starts_below && !ends_below, falls = ends_below && !starts_below;
    turns = static_cast<std::uint8_t>(turns + (seen_from > 0 ? rises : falls));
  }
};

struct Place {
  std::uint32_t code;
  Index triangle;
};

// Moves bit i of a 10-bit number to bit 3 i.
std::uint32_t spread(std::uint32_t bits) {
  bits = (bits | bits << 16) & 0x030000FF;
  bits = (bits | bits << 8) & 0x0300F00F;
  bits = (bits | bits << 4) & 0x030C30C3;
  return (bits | bits << 2) & 0x09249249;
}

// A float that is not above the value (unless all are), and no farther off than two units in its last place.
float floatBelow(double value) {
  constexpr double kMost = std::numeric_limits<float>::max();
  const double below = value - std::abs(value) * 0x1p-23 - 0x1p-149;
  return static_cast<float>(std::clamp(below, -kMost, kMost));
}

}  // namespace

SelfIntersections::Box SelfIntersections::emptyBox() {
  constexpr float kInfinite = std::numeric_limits<float>::infinity();
  return {{kInfinite, kInfinite, kInfinite}, {-kInfinite, -kInfinite, -kInfinite}};
}

SelfIntersections::Box SelfIntersections::everything() {
  constexpr float kMost = std::numeric_limits<float>::max();
  return {{-kMost, -kMost, -kMost}, {kMost, kMost, kMost}};
}

SelfIntersections::Run SelfIntersections::emptyRun() {
  Run run;
  for (std::size_t lane = 0; lane < kRun; ++lane) put(emptyBox(), lane, run);
  return run;
}

// The lanes whose boxes overlap the box, as bits. Differences have the sign of what is compared, and are
// taken four at a time; no branches, which would be guessed wrong.
unsigned SelfIntersections::overlaps(const Run& run, const Box& box) {
  using Lanes = Eigen::Array<float, kRun, 1>;
  const auto lanesOf = [](const std::array<float, kRun>& values) {
    return Eigen::Map<const Lanes>(values.data());
  };
  const auto gapAlong = [&](std::size_t axis) -> Lanes {
    return (lanesOf(run.low[axis]) - box.high[axis]).max(box.low[axis] - lanesOf(run.high[axis]));
  };
  const Lanes gap = gapAlong(0).max(gapAlong(1)).max(gapAlong(2));
  unsigned bits = 0;
  for (std::size_t lane = 0; lane < kRun; ++lane) bits |= static_cast<unsigned>(gap[lane] <= 0) << lane;
  return bits;
}

SelfIntersections::Box SelfIntersections::boxIn(const Run& run, std::size_t lane) {
  Box box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.low[axis] = run.low[axis][lane];
    box.high[axis] = run.high[axis][lane];
  }
  return box;
}

void SelfIntersections::put(const Box& box, std::size_t lane, Run& run) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    run.low[axis][lane] = box.low[axis];
    run.high[axis][lane] = box.high[axis];
  }
}

SelfIntersections::View SelfIntersections::viewOf(const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto side = [&](int axis) { return static_cast<std::int8_t>(clearOrientationAlong(axis, a, b, c)); };
  return {{side(0), side(1), side(2)}, static_cast<std::uint8_t>(widestAxis(a, b, c))};
}

// That of a degenerate triangle is empty.
SelfIntersections::Box SelfIntersections::boxOf(Index triangle) const {
  const auto [i, j, k] = triangles_[triangle];
  const Vec3 &a = position_[i], &b = position_[j], &c = position_[k];
  Box box = emptyBox();
  if (view_[triangle].isOnEdge() && areCollinear(a, b, c)) return box;
  for (int axis = 0; axis < 3; ++axis) {
    box.low[axis] = floatBelow(std::min({a[axis], b[axis], c[axis]}));
    box.high[axis] = -floatBelow(-std::max({a[axis], b[axis], c[axis]}));
  }
  return box;
}

SelfIntersections::SelfIntersections(const std::vector<Vec3>& position,
                                     const std::vector<Triangle>& triangles, const Context& context,
                                     const HalfEdgeMesh* mesh)
    : position_(position), triangles_(triangles), context_(context), knows_edges_(mesh != nullptr) {
  const std::size_t count = triangles.size();
  orderByPlace();
  rank_.resize(count);
  view_.resize(count);
  levels_.emplace_back(runsOf(count), emptyRun());
  parallelBlocks(context, count, 512 * kRun, [&](std::size_t first, std::size_t last) {
    for (std::size_t rank = first; rank < last; ++rank) measure(rank);
  });
  while (levels_.back().size() > 1) {
    const std::size_t below = levels_.back().size();
    levels_.emplace_back(runsOf(below), emptyRun());
    context_.checkCancelled();
    for (std::size_t run = 0; run < below; ++run) sumUp(levels_.size() - 2, run);
  }
  spread_.resize(position.size(), 0);
  if (mesh) findSpread(*mesh);
}

// Notes the number, the view and the box of the triangle of this rank.
void SelfIntersections::measure(std::size_t rank) {
  const Index triangle = order_[rank];
  const auto [a, b, c] = triangles_[triangle];
  rank_[triangle] = static_cast<Index>(rank);
  view_[triangle] = viewOf(position_[a], position_[b], position_[c]);
  put(boxOf(triangle), rank % kRun, levels_[0][rank / kRun]);
}

// Finds the vertices whose triangles, along some axis, are seen to close up around them once, all from the
// same side: then none of these meets another outside of the edges that they share.
void SelfIntersections::findSpread(const HalfEdgeMesh& mesh) {
  const auto isSpread = [&](Index v) {
    FanView fan;
    for (Index h = mesh.firstOutgoing(v); h != kNone && fan.fits; h = mesh.nextOutgoing(h)) {
      if (mesh.isBorder(h) || mesh.isBorder(HalfEdgeMesh::previous(h))) return false;
      const View& view = view_[HalfEdgeMesh::triangleOf(h)];
      if (fan.axis == FanView::kNoAxis) fan.axis = view.widest;
      const int across = fan.axis == 0 ? 2 : fan.axis - 1;
      const double height = position_[v][across];
      fan.add(view.side[fan.axis], position_[mesh.target(h)][across] < height,
              position_[mesh.opposite(h)][across] < height);
    }
    return fan.fits && fan.turns == 1;
  };
  const std::size_t vertices = static_cast<std::size_t>(mesh.vertexCount());
  parallelBlocks(context_, vertices, 4096, [&](std::size_t first, std::size_t last) {
    for (std::size_t v = first; v < last; ++v) spread_[v] = isSpread(static_cast<Index>(v)) ? 1 : 0;
  });
}

void SelfIntersections::orderByPlace() {
  Vec3 low = Vec3::Constant(kInfinity), high = -low;
  for (const auto& [a, b, c] : triangles_) {
    const Vec3& p = position_[a];
    if (!p.allFinite()) continue;
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double cells = (1 << kCodeBits) - 1;
  Vec3 scale;
  for (int i = 0; i < 3; ++i) scale[i] = high[i] > low[i] ? cells / (high[i] - low[i]) : 0;
  std::vector<Place> places(triangles_.size());
  parallelBlocks(context_, places.size(), 4096, [&](std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last; ++t) {
      std::uint32_t code = 0;
      for (int i = 0; i < 3; ++i) {
        const double cell = (position_[triangles_[t][0]][i] - low[i]) * scale[i];
        code |= spread(cell > 0 ? static_cast<std::uint32_t>(std::min(cell, cells)) : 0) << i;
      }
      places[t] = {code, static_cast<Index>(t)};
    }
  });
  radixSort(
      places, 3 * kCodeBits, [](const Place& place) { return place.code; }, context_);
  order_.resize(places.size());
  for (std::size_t rank = 0; rank < places.size(); ++rank) order_[rank] = places[rank].triangle;
}

// Passes the box around a run up into its lane of the next level.
void SelfIntersections::sumUp(std::size_t level, std::size_t run) {
  const Run& boxes = levels_[level][run];
  Box sum = emptyBox();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    sum.low[axis] = *std::min_element(boxes.low[axis].begin(), boxes.low[axis].end());
    sum.high[axis] = *std::max_element(boxes.high[axis].begin(), boxes.high[axis].end());
  }
  put(sum, run % kRun, levels_[level + 1][run / kRun]);
}

void SelfIntersections::update(const std::vector<Index>& triangles) {
  for (const Index triangle : triangles) {
    std::size_t place = static_cast<std::size_t>(rank_[triangle]);
    measure(place);
    for (const Index v : triangles_[triangle]) spread_[v] = 0;
    for (std::size_t level = 0; level + 1 < levels_.size(); ++level) sumUp(level, place /= kRun);
  }
}

bool SelfIntersections::meet(Index a, Index b) const {
  for (const Index u : triangles_[a]) {
    for (const Index v : triangles_[b]) {
      if (u == v && spread_[u] != 0) return false;
    }
  }
  return trianglesMeet(position_, triangles_[a], triangles_[b], view_[a].widest) ||
         (knows_edges_ && doubleAnEdge(position_, triangles_[a], triangles_[b]));
}

// Visits the runs of triangles from `first_run` on with the lanes in which boxes overlap the box.
template <typename Visit>
void SelfIntersections::visitRuns(const Box& box, std::size_t first_run, const Visit& visit) const {
  struct Node {
    std::size_t level, run;
  };
  std::array<std::size_t, kMostLevels> first{};  // of every level, the run with first_run under it
  for (std::size_t level = 0, run = first_run; level < levels_.size(); ++level, run /= kRun)
    first[level] = run;
  std::array<Node, kMostLevels * kRun> stack;
  std::size_t depth = 0;
  stack[depth++] = {levels_.size() - 1, 0};
  while (depth > 0) {
    const auto [level, run] = stack[--depth];
    unsigned lanes = overlaps(levels_[level][run], box);
    if (level == 0) {
      if (lanes != 0) visit(run, lanes);
      continue;
    }
    for (std::size_t child = run * kRun; lanes != 0; lanes >>= 1, ++child) {
      if ((lanes & 1) != 0 && child >= first[level - 1]) stack[depth++] = {level - 1, child};
    }
  }
}

// Pairs of a triangle of the run and a later one.
template <typename Found>
void SelfIntersections::searchRun(std::size_t run, const Found& found) const {
  const Run& own = levels_[0][run];
  const Box around = levels_.size() > 1 ? boxIn(levels_[1][run / kRun], run % kRun) : everything();
  const std::size_t begin = run * kRun, end = std::min(order_.size(), begin + kRun);
  visitRuns(around, run, [&](std::size_t other, unsigned) {
    unsigned near = levels_.size() > 1 ? overlaps(own, boxIn(levels_[1][other / kRun], other % kRun)) : ~0u;
    for (std::size_t i = begin; i < end; ++i, near >>= 1) {
      if ((near & 1) == 0) continue;
      const unsigned later = other == run ? ~1u << (i - begin) : ~0u;
      unsigned lanes = overlaps(levels_[0][other], boxIn(own, i - begin)) & later;
      for (std::size_t j = other * kRun; lanes != 0; lanes >>= 1, ++j) {
        if ((lanes & 1) != 0 && meet(order_[i], order_[j]))
          found(std::min(order_[i], order_[j]), std::max(order_[i], order_[j]));
      }
    }
  });
}

std::vector<TrianglePair> SelfIntersections::all() const {
  std::vector<std::vector<TrianglePair>> found(levels_[0].size() / kBlock + 1);
  parallelBlocks(context_, levels_[0].size(), kBlock, [&](std::size_t first, std::size_t last) {
    for (std::size_t run = first; run < last; ++run)
      searchRun(run, [&](Index a, Index b) { found[first / kBlock].push_back({a, b}); });
  });
  std::vector<TrianglePair> pairs;
  for (const std::vector<TrianglePair>& block : found) pairs.insert(pairs.end(), block.begin(), block.end());
  CancelCheck check(context_);
  std::sort(pairs.begin(), pairs.end(), [&](const TrianglePair& a, const TrianglePair& b) {
    check();
    return a < b;
  });
  return pairs;
}

std::int64_t SelfIntersections::count() const {
  std::vector<std::int64_t> found(levels_[0].size() / kBlock + 1);
  parallelBlocks(context_, levels_[0].size(), kBlock, [&](std::size_t first, std::size_t last) {
    for (std::size_t run = first; run < last; ++run)
      searchRun(run, [&](Index, Index) { ++found[first / kBlock]; });
  });
  return std::accumulate(found.begin(), found.end(), std::int64_t{0});
}

std::vector<TrianglePair> SelfIntersections::involving(const std::vector<Index>& triangles) const {
  std::vector<TrianglePair> pairs;
  CancelCheck check(context_);
  for (const Index triangle : triangles) {
    check();
    const std::size_t rank = static_cast<std::size_t>(rank_[triangle]);
    visitRuns(boxIn(levels_[0][rank / kRun], rank % kRun), 0, [&](std::size_t run, unsigned lanes) {
      for (std::size_t i = run * kRun; lanes != 0; lanes >>= 1, ++i) {
        if ((lanes & 1) == 0 || i == rank || !meet(triangle, order_[i])) continue;
        pairs.push_back({std::min(triangle, order_[i]), std::max(triangle, order_[i])});
      }
    });
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

}  // namespace mlsmesh::core
