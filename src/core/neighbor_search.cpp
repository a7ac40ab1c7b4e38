// SPDX-License-Identifier: BSD-3-Clause
// This work is based on:
// Marius Muja, David Lowe. Scalable Nearest Neighbor Algorithms for High Dimensional Data. IEEE TPAMI, 2014
// (FLANN).
#include "mlsmesh/core/neighbor_search.h"

#include <flann/algorithms/dist.h>
#include <flann/algorithms/kdtree_single_index.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "mlsmesh/core/failure.h"
#include "mlsmesh/core/parallel.h"

namespace mlsmesh::core {

namespace {

constexpr int kLeafSize = 15;
constexpr std::size_t kQueryBlock = 2048;
constexpr int kSpacingNeighbors = 6;
constexpr std::size_t kSpacingSamples = 5000;

/// FLANN's flann::L2_Simple for the three coordinates that all our points have: no loop.
struct SquaredDistance {
  using is_kdtree_distance = bool;
  using ElementType = double;
  using ResultType = double;

  double operator()(const double* a, const double* b, std::size_t, double = -1) const {
    const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return x * x + y * y + z * z;
  }
  double accum_dist(double a, double b, int) const { return (a - b) * (a - b); }
};

/// The k best in the caller's arrays, by (squared distance, index).
class BestK final : public flann::ResultSet<double> {
 public:
  BestK(int capacity, Index* indices, double* squared_distances)
      : capacity_(capacity), indices_(indices), distances_(squared_distances) {}

  int size() const { return size_; }
  bool full() const override { return size_ == capacity_; }

  void addPoint(double distance, std::size_t point) override {
    const Index index = static_cast<Index>(point);
    if (full() && !comesBefore(distance, index, size_ - 1)) return;
    int place = full() ? size_ - 1 : size_++;
    for (; place > 0 && comesBefore(distance, index, place - 1); --place) {
      distances_[place] = distances_[place - 1];
      indices_[place] = indices_[place - 1];
    }
    distances_[place] = distance;
    indices_[place] = index;
  }

  /// A little beyond the k-th distance: FLANN passes only what is strictly nearer, and its bounds of subtrees
  /// carry the rounding of one sum a level, while a tie at the k-th distance must still reach addPoint.
  double worstDist() const override {
    if (!full()) return std::numeric_limits<double>::infinity();
    return distances_[size_ - 1] * kSlack + std::numeric_limits<double>::denorm_min();
  }

 private:
  static constexpr double kSlack = 1 + 1e-12;

  bool comesBefore(double distance, Index index, int place) const {
    return distance < distances_[place] || (distance == distances_[place] && index < indices_[place]);
  }

  const int capacity_;
  int size_ = 0;
  Index* const indices_;
  double* const distances_;
};

/// With `copy` FLANN's tree takes the points over in its own order while it is built and never looks at ours
/// again.
class KdTree final : public NeighborSearch {
 public:
  KdTree(const std::vector<Vec3>& points, bool copy)
      : size_(static_cast<Index>(points.size())), tree_(flann::KDTreeSingleIndexParams(kLeafSize, copy)) {
    if (points.empty()) return;
    double* const coordinates = const_cast<double*>(points.front().data());
    tree_.buildIndex(flann::Matrix<double>(coordinates, points.size(), 3));
  }

  Index size() const override { return size_; }

  int nearest(const Vec3& query, int k, Index* indices, double* squared_distances) const override {
    if (size_ == 0 || k <= 0) return 0;
    BestK best(k, indices, squared_distances);
    tree_.findNeighbors(best, query.data(), parameters_);
    return best.size();
  }

 private:
  const Index size_;
  const flann::SearchParams parameters_;
  flann::KDTreeSingleIndex<SquaredDistance> tree_;
};

/// Room for the answers of one thread's queries.
struct Answer {
  explicit Answer(int k) : indices(k), squared_distances(k) {}

  std::vector<Index> indices;
  std::vector<double> squared_distances;
};

int ask(const NeighborSearch& search, const Vec3& query, Answer& answer) {
  return search.nearest(query, static_cast<int>(answer.indices.size()), answer.indices.data(),
                        answer.squared_distances.data());
}

/// The first k of the answer without the point itself.
void copyOthers(const Answer& answer, int found, Index point, int k, Index* row) {
  int copied = 0;
  for (int i = 0; i < found && copied < k; ++i)
    if (answer.indices[i] != point) row[copied++] = answer.indices[i];
  if (copied == k) return;
  throw Failure(StatusCode::Internal, "the neighbour search returned " + std::to_string(copied) + " of the " +
                                          std::to_string(k) + " other points nearest to point " +
                                          std::to_string(point));
}

double distanceToNearestOther(const std::vector<Vec3>& points, const NeighborSearch& search, Index point,
                              Answer& answer) {
  const int found = ask(search, points[point], answer);
  Index other = kNone;
  copyOthers(answer, found, point, 1, &other);
  return (points[other] - points[point]).norm();
}

}  // namespace

std::unique_ptr<NeighborSearch> makeKdTree(const std::vector<Vec3>& points) {
  return std::make_unique<KdTree>(points, true);
}

std::unique_ptr<NeighborSearch> makeKdTreeOver(const std::vector<Vec3>& points) {
  return std::make_unique<KdTree>(points, false);
}

NeighborTable nearestOfAll(const std::vector<Vec3>& points, const NeighborSearch& search, int k,
                           const Context& context) {
  NeighborTable table;
  table.k = static_cast<int>(std::min<std::ptrdiff_t>(k, static_cast<std::ptrdiff_t>(points.size()) - 1));
  table.k = std::max(table.k, 0);
  table.indices.resize(points.size() * table.k);
  parallelBlocks(context, points.size(), kQueryBlock, [&](std::size_t first, std::size_t last) {
    Answer answer(table.k + 1);
    for (std::size_t i = first; i < last; ++i) {
      const int found = ask(search, points[i], answer);
      copyOthers(answer, found, static_cast<Index>(i), table.k, table.indices.data() + i * table.k);
    }
  });
  return table;
}

std::vector<double> localSpacings(const std::vector<Vec3>& points, const NeighborTable& neighbors,
                                  const Context& context) {
  const int k = std::min(neighbors.k, kSpacingNeighbors);
  std::vector<double> spacing(points.size(), 0.0);
  if (k == 0) return spacing;
  parallelBlocks(context, points.size(), kQueryBlock, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const Index* const row = neighbors.row(static_cast<Index>(i));
      double sum = 0;
      for (int j = 0; j < k; ++j) sum += (points[row[j]] - points[i]).norm();
      spacing[i] = sum / k;
    }
  });
  return spacing;
}

double medianSpacing(const std::vector<Vec3>& points, const NeighborSearch& search, const Context& context) {
  if (points.size() < 2) return 0;
  const std::size_t samples = std::min(points.size(), kSpacingSamples);
  std::vector<double> distance(samples);
  parallelBlocks(context, samples, kQueryBlock, [&](std::size_t first, std::size_t last) {
    Answer answer(2);
    for (std::size_t i = first; i < last; ++i) {
      const Index point = static_cast<Index>(i * points.size() / samples);
      distance[i] = distanceToNearestOther(points, search, point, answer);
    }
  });
  const auto middle = distance.begin() + static_cast<std::ptrdiff_t>(samples / 2);
  std::nth_element(distance.begin(), middle, distance.end());
  return *middle;
}

}  // namespace mlsmesh::core
