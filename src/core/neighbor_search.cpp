// SPDX-License-Identifier: BSD-3-Clause
#include "mlsmesh/core/neighbor_search.h"

#include <algorithm>
#include <string>

#include "kd_tree.h"
#include "mlsmesh/core/failure.h"
#include "mlsmesh/core/parallel.h"

namespace mlsmesh::core {

namespace {

constexpr std::size_t kQueryBlock = 2048;
constexpr int kSpacingNeighbors = 6;
constexpr std::size_t kSpacingSamples = 5000;

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

std::unique_ptr<NeighborSearch> makeKdTree(const std::vector<Vec3>& points, const Context& context) {
  return std::make_unique<KdTree>(points, true, context);
}

std::unique_ptr<NeighborSearch> makeKdTreeOver(const std::vector<Vec3>& points, const Context& context) {
  return std::make_unique<KdTree>(points, false, context);
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
