// SPDX-License-Identifier: BSD-3-Clause
// This work is based on:
// - J. L. Bentley, "Multidimensional binary search trees used for associative searching", 1975.
// - S. Arya, D. M. Mount, "Algorithms for fast vector quantization", 1993: distances to cells, kept up to
// date
//   axis by axis.
// - M. Muja, D. G. Lowe, "Scalable nearest neighbor algorithms for high dimensional data", 2014: FLANN, whose
//   KDTreeSingleIndex cuts where this does, in the middle of the widest side.
#include "kd_tree.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace mlsmesh::core {
namespace {

constexpr Index kLeafSize = 15;

double squared(double value) {
  return value * value;
}

}  // namespace

class KdTree::Builder {
 public:
  Builder(KdTree& tree, const Context& context) : tree_(tree), context_(context) {}

  void build() {
    const Index count = tree_.size();
    tree_.cells_.reserve(static_cast<std::size_t>(count / (kLeafSize / 4)) + 1);
    tree_.box_ = boxOf(0, count);
    divide(0, count, tree_.box_);
  }

 private:
  // Adds the cell of these points and all below it; makes the box tight.
  void divide(Index first, Index last, Box& box) {
    askNowAndThen(last - first);
    const std::size_t cell = tree_.cells_.size();
    tree_.cells_.push_back({0, 0, first, last, kNone});
    if (last - first <= kLeafSize) {
      box = boxOf(first, last);
      return;
    }
    const Cut cut = cutOf(first, last, box);
    const Index middle = partition(first, last, cut);
    Box left = box, right = box;
    left.high[cut.axis] = right.low[cut.axis] = cut.value;
    divide(first, middle, left);
    const Index right_cell = static_cast<Index>(tree_.cells_.size());
    divide(middle, last, right);
    tree_.cells_[cell] = {left.high[cut.axis], right.low[cut.axis], right_cell, kNone, cut.axis};
    box = {left.low.cwiseMin(right.low), left.high.cwiseMax(right.high)};
  }

  struct Cut {
    int axis = 0;
    double value = 0;
  };

  const Vec3& point(Index place) const { return tree_.points_[tree_.order_[place]]; }

  Box boxOf(Index first, Index last) const {
    Box box{point(first), point(first)};
    for (Index i = first + 1; i < last; ++i) {
      box.low = box.low.cwiseMin(point(i));
      box.high = box.high.cwiseMax(point(i));
    }
    return box;
  }

  // In the middle of the side on which the points spread most; a side of the box may be wider than they are.
  Cut cutOf(Index first, Index last, const Box& box) const {
    const Vec3 sides = box.high - box.low;
    int widest = 0;
    sides.maxCoeff(&widest);
    Cut cut;
    double spread = -1;
    for (const int axis : {widest, (widest + 1) % 3, (widest + 2) % 3}) {
      if (sides[axis] <= spread) continue;
      double low = point(first)[axis], high = low;
      for (Index i = first + 1; i < last; ++i) {
        low = std::min(low, point(i)[axis]);
        high = std::max(high, point(i)[axis]);
      }
      if (high - low <= spread) continue;
      spread = high - low;
      cut = {axis, std::clamp(low + 0.5 * (high - low), low, high)};
    }
    return cut;
  }

  // Points below the cut come first, those on it next; the side with fewer takes from these, up to a half.
  Index partition(Index first, Index last, const Cut& cut) {
    const auto begin = tree_.order_.begin();
    const auto& points = tree_.points_;
    const auto below =
        std::partition(begin + first, begin + last, [&](Index p) { return points[p][cut.axis] < cut.value; });
    const Index half = first + (last - first) / 2;
    if (below - begin >= half) return static_cast<Index>(below - begin);
    const auto upto =
        std::partition(below, begin + last, [&](Index p) { return points[p][cut.axis] <= cut.value; });
    return std::min(half, static_cast<Index>(upto - begin));
  }

  void askNowAndThen(Index points) {
    constexpr std::int64_t kPointsBetween = 1 << 17;
    work_ += points;
    if (work_ < kPointsBetween) return;
    work_ = 0;
    context_.checkCancelled();
  }

  KdTree& tree_;
  const Context& context_;
  std::int64_t work_ = 0;
};

/// One search: the k best so far in the caller's arrays, by (squared distance, index), while cells are
/// visited.
class KdTree::Query {
 public:
  Query(const KdTree& tree, const Vec3& place, int capacity, Index* indices, double* squared_distances)
      : tree_(tree), place_(place), capacity_(capacity), indices_(indices), distances_(squared_distances) {}

  int run() {
    for (int axis = 0; axis < 3; ++axis) {
      const double x = place_[axis];
      beside_[axis] = squared(x - std::clamp(x, tree_.box_.low[axis], tree_.box_.high[axis]));
    }
    visit(0, beside_[0] + beside_[1] + beside_[2]);
    return size_;
  }

 private:
  // `distance`: the square of that to the cell, the sum of beside_.
  void visit(std::size_t number, double distance) {
    const Cell& cell = tree_.cells_[number];
    if (cell.axis == kNone) {
      look(cell);
      return;
    }
    const double x = place_[cell.axis];
    const bool is_left = (x - cell.low) + (x - cell.high) < 0;
    const std::size_t left = number + 1, right = static_cast<std::size_t>(cell.first);
    visit(is_left ? left : right, distance);
    double& side = beside_[cell.axis];
    const double before = side;
    const double beyond = squared(x - (is_left ? cell.high : cell.low));
    if (distance + beyond - before > worst_) return;
    side = beyond;
    visit(is_left ? right : left, distance + beyond - before);
    side = before;
  }

  void look(const Cell& leaf) {
    const bool copied = !tree_.copy_.empty();
    for (Index i = leaf.first; i < leaf.last; ++i) {
      const Index index = tree_.order_[i];
      const Vec3& point = copied ? tree_.copy_[i] : tree_.points_[index];
      const double x = place_[0] - point[0], y = place_[1] - point[1], z = place_[2] - point[2];
      const double distance = x * x + y * y + z * z;
      if (distance < worst_) add(distance, index);
    }
  }

  void add(double distance, Index index) {
    if (size_ == capacity_ && !comesBefore(distance, index, size_ - 1)) return;
    int place = size_ == capacity_ ? size_ - 1 : size_++;
    for (; place > 0 && comesBefore(distance, index, place - 1); --place) {
      distances_[place] = distances_[place - 1];
      indices_[place] = indices_[place - 1];
    }
    distances_[place] = distance;
    indices_[place] = index;
    // A little beyond the k-th distance: those of cells carry the rounding of one sum a level, while a tie at
    // the k-th distance must still be seen.
    constexpr double kSlack = 1 + 1e-12;
    if (size_ == capacity_)
      worst_ = distances_[size_ - 1] * kSlack + std::numeric_limits<double>::denorm_min();
  }

  bool comesBefore(double distance, Index index, int place) const {
    return distance < distances_[place] || (distance == distances_[place] && index < indices_[place]);
  }

  const KdTree& tree_;
  const Vec3& place_;
  std::array<double, 3> beside_{};  // squares of the distance to the present cell along each axis
  const int capacity_;
  int size_ = 0;
  Index* const indices_;
  double* const distances_;
  double worst_ = std::numeric_limits<double>::infinity();
};

KdTree::KdTree(const std::vector<Vec3>& points, bool copy, const Context& context)
    : points_(points), order_(points.size()) {
  if (points.empty()) return;
  std::iota(order_.begin(), order_.end(), 0);
  Builder(*this, context).build();
  if (!copy) return;
  copy_.reserve(points.size());
  for (const Index p : order_) copy_.push_back(points[p]);
}

int KdTree::nearest(const Vec3& query, int k, Index* indices, double* squared_distances) const {
  if (order_.empty() || k <= 0) return 0;
  return Query(*this, query, k, indices, squared_distances).run();
}

}  // namespace mlsmesh::core
