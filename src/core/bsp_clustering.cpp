// SPDX-License-Identifier: BSD-3-Clause
// This work is based on:
// - M. Pauly, M. Gross, L. P. Kobbelt, "Efficient simplification of point-sampled surfaces", Visualization
// 2002: the
//   hierarchical clustering by surface variation, split by the plane normal to v3.
// - B. Mederos, L. Velho, L. H. de Figueiredo, "Moving least squares multiresolution surface approximation",
//   SIBGRAPI 2003, section 2.1.
// Departures: the printed split along the regression plane and the printed rule "and" are options; the first
// cuts slabs through the whole model, the second leaves clusters of hundreds of points on flat parts. A cut
// that would leave fewer than min_leaf points on a side moves inwards, and leaves that bridge a gap are cut
// at the gap.
#include "mlsmesh/core/bsp_clustering.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "mlsmesh/core/failure.h"
#include "mlsmesh/core/parallel.h"

namespace mlsmesh::core {
namespace {

constexpr Index kTaskSize = 4096;    // parts below are worked off by one thread
constexpr Index kMaxGapPoints = 32;  // larger leaves (printed rules only) are not searched for gaps

struct Shape {
  Vec3 centroid;
  Vec3 split_normal;
  double variation = 0;
  bool is_point = true;
};

class Splitter {
 public:
  Splitter(const std::vector<Vec3>& points, const ClusteringParameters& parameters, const Context& context)
      : points_(points),
        parameters_(parameters),
        context_(context),
        order_(points.size()),
        starts_(points.size(), 0) {
    std::iota(order_.begin(), order_.end(), 0);
  }

  IndexLists run() {
    const Index count = static_cast<Index>(points_.size());
    const std::vector<Part> parts = splitLarge({0, count});
    parallelBlocks(context_, parts.size(), 1,
                   [&](std::size_t i, std::size_t) { split(parts[i].first, parts[i].last); });
    IndexLists clusters;
    for (Index i = 1; i < count; ++i) {
      if (starts_[i]) clusters.begin.push_back(i);
    }
    if (count > 0) clusters.begin.push_back(count);
    clusters.items = std::move(order_);
    return clusters;
  }

 private:
  struct Part {
    Index first = 0, last = 0;

    Index size() const { return last - first; }
  };

  // Splits large parts as long as there are any, all of a round at a time; returns the others.
  std::vector<Part> splitLarge(const Part& whole) {
    std::vector<Part> small, large = {whole};
    while (!large.empty()) {
      std::vector<Index> middle(large.size());
      parallelBlocks(context_, large.size(), 1, [&](std::size_t i, std::size_t) {
        middle[i] = splitOnce(large[i].first, large[i].last);
      });
      std::vector<Part> next;
      for (std::size_t i = 0; i < large.size(); ++i) {
        if (middle[i] == large[i].last) continue;
        for (const Part& part : {Part{large[i].first, middle[i]}, Part{middle[i], large[i].last}}) {
          (part.size() > kTaskSize ? next : small).push_back(part);
        }
      }
      large.swap(next);
    }
    return small;
  }

  Shape shapeOf(Index first, Index last) const {
    Shape shape;
    const Vec3 reference = points_[order_[first]];
    Vec3 sum = Vec3::Zero();
    for (Index i = first; i < last; ++i) sum += points_[order_[i]] - reference;
    shape.centroid = reference + sum / (last - first);
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    for (Index i = first; i < last; ++i) {
      const Vec3 d = points_[order_[i]] - shape.centroid;
      covariance.noalias() += d * d.transpose();
    }
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    solver.computeDirect(covariance);
    const Vec3 values = solver.eigenvalues().cwiseMax(0.0);
    const double total = values.sum();
    shape.is_point = !(total > 0);
    shape.variation = shape.is_point ? 0 : values[0] / total;
    shape.split_normal =
        solver.eigenvectors().col(parameters_.split_plane == SplitPlane::LargestSpread ? 2 : 0);
    return shape;
  }

  bool wantsSplit(Index count, const Shape& shape) const {
    const bool large = count > parameters_.max_size;
    const bool curved = shape.variation > parameters_.max_variation;
    return parameters_.split_rule == SplitRule::SizeOrVariation ? large || curved : large && curved;
  }

  // Reorders [first, last) and returns where its second part begins, or `last` when no legal cut exists.
  Index cut(Index first, Index last, const Shape& shape) {
    const Index least = parameters_.min_leaf;
    if (last - first < 2 * least) return last;
    const auto side = [&](Index i) { return (points_[i] - shape.centroid).dot(shape.split_normal); };
    const auto begin = order_.begin() + first;
    const auto end = order_.begin() + last;
    const Index middle = static_cast<Index>(
        std::stable_partition(begin, end, [&](Index i) { return side(i) < 0; }) - order_.begin());
    if (middle - first >= least && last - middle >= least) return middle;
    const Index moved = middle - first < least ? first + least : last - least;
    std::nth_element(begin, order_.begin() + moved, end, [&](Index a, Index b) {
      return std::make_pair(side(a), a) < std::make_pair(side(b), b);
    });
    std::sort(begin, order_.begin() + moved);
    std::sort(order_.begin() + moved, end);
    return moved;
  }

  void split(Index first, Index last) {
    const Index middle = splitOnce(first, last);
    if (middle == last) return;
    split(first, middle);
    split(middle, last);
  }

  // Where the second part of a cluster that is to be split begins; `last` for one that is done.
  Index splitOnce(Index first, Index last) {
    if (first == last) return last;
    starts_[first] = 1;
    const Index count = last - first;
    if (count == 1) return last;
    const Shape shape = shapeOf(first, last);
    if (shape.is_point) return last;
    const Index middle = wantsSplit(count, shape) ? cut(first, last, shape) : last;
    if (middle == last) cutAtGap(first, last);
    return middle;
  }

  // Prim's minimum spanning tree over the few points of a leaf; cuts it at its longest edge if that stands
  // out.
  void cutAtGap(Index first, Index last) {
    const Index count = last - first;
    if (parameters_.max_gap <= 0 || count < 3 || count > kMaxGapPoints) return;
    std::array<double, kMaxGapPoints> distance;  // from the tree, squared while it grows
    std::array<Index, kMaxGapPoints> parent;
    std::array<Index, kMaxGapPoints> visit;  // positions in the order in which the tree reaches them
    std::array<bool, kMaxGapPoints> done{};
    std::fill_n(distance.begin(), count, std::numeric_limits<double>::max());
    distance[0] = 0;
    parent[0] = 0;
    for (Index round = 0; round < count; ++round) {
      Index best = kNone;
      for (Index i = 0; i < count; ++i) {
        if (!done[i] && (best == kNone || distance[i] < distance[best])) best = i;
      }
      done[best] = true;
      visit[round] = best;
      for (Index i = 0; i < count; ++i) {
        if (done[i]) continue;
        const double d = (points_[order_[first + i]] - points_[order_[first + best]]).squaredNorm();
        if (d < distance[i]) {
          distance[i] = d;
          parent[i] = best;
        }
      }
    }
    for (Index i = 1; i < count; ++i) distance[i] = std::sqrt(distance[i]);
    std::array<double, kMaxGapPoints> edges;
    std::copy_n(distance.begin() + 1, count - 1, edges.begin());
    std::nth_element(edges.begin(), edges.begin() + (count - 1) / 2, edges.begin() + count - 1);
    const Index far = static_cast<Index>(std::max_element(distance.begin() + 1, distance.begin() + count) -
                                         distance.begin());
    if (distance[far] <= parameters_.max_gap * edges[(count - 1) / 2]) return;
    std::array<bool, kMaxGapPoints> beyond{};  // the subtree behind the longest edge
    for (Index round = 0; round < count; ++round) {
      const Index i = visit[round];
      beyond[i] = i == far || (i != 0 && beyond[parent[i]]);
    }
    const Index middle = separate(first, last, beyond.data());
    split(first, middle);
    split(middle, last);
  }

  // Moves the marked positions of [first, last) behind the others, each part in its order.
  Index separate(Index first, Index last, const bool* marked) {
    std::array<Index, kMaxGapPoints> behind;
    Index kept = first;
    Index moved = 0;
    for (Index i = first; i < last; ++i) {
      if (marked[i - first]) {
        behind[moved++] = order_[i];
      } else {
        order_[kept++] = order_[i];
      }
    }
    std::copy_n(behind.begin(), moved, order_.begin() + kept);
    return kept;
  }

  const std::vector<Vec3>& points_;
  const ClusteringParameters& parameters_;
  const Context& context_;
  std::vector<Index> order_;
  std::vector<char> starts_;
};

}  // namespace

IndexLists clusterPoints(const std::vector<Vec3>& points, const ClusteringParameters& parameters,
                         const Context& context) {
  context.checkCancelled();
  return Splitter(points, parameters, context).run();
}

}  // namespace mlsmesh::core
