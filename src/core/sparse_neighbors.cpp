// SPDX-License-Identifier: BSD-3-Clause
#include "sparse_neighbors.h"

#include <algorithm>

#include "mlsmesh/core/failure.h"
#include "mlsmesh/core/parallel.h"

namespace mlsmesh::core {
namespace {

constexpr int kSpacingNeighbors = 6;

double meanDistance(const std::vector<Vec3>& points, const Index* row, int k) {
  const int last = std::min(kSpacingNeighbors, k - 1);
  double sum = 0;
  for (int i = 1; i <= last; ++i) sum += (points[row[i]] - points[row[0]]).norm();
  return sum / last;
}

}  // namespace

SparseNeighbors::SparseNeighbors(const std::vector<Vec3>& points, const NeighborSearch& search, int k)
    : points_(points), search_(search), k_(k), slot_(points.size(), kNone) {}

void SparseNeighbors::add(const std::vector<Index>& points, const Context& context) {
  const std::size_t before = point_.size();
  for (const Index p : points) {
    if (slot_[p] != kNone) continue;
    slot_[p] = static_cast<Index>(point_.size());
    point_.push_back(p);
  }
  const std::size_t width = static_cast<std::size_t>(k_);
  neighbor_.resize(point_.size() * width);
  spacing_.resize(point_.size());
  parallelBlocks(context, point_.size() - before, 256, [&](std::size_t first, std::size_t last) {
    std::vector<double> squared_distance(width);
    for (std::size_t s = before + first; s < before + last; ++s) {
      Index* row = neighbor_.data() + s * width;
      if (search_.nearest(points_[point_[s]], k_, row, squared_distance.data()) != k_) {
        throw Failure(StatusCode::Internal, "the neighbour search returned too few points");
      }
      std::iter_swap(row, std::find(row, row + k_ - 1, point_[s]));
      spacing_[s] = meanDistance(points_, row, k_);
    }
  });
}

std::vector<Index> SparseNeighbors::grown(const std::vector<Index>& points, int count) const {
  std::vector<char> seen(points_.size(), 0);
  std::vector<Index> all;
  for (const Index p : points) {
    const Index* first = row(p);
    for (const Index* q = first; q < first + std::min(count, k_); ++q) {
      if (!seen[*q]) all.push_back(*q);
      seen[*q] = 1;
    }
  }
  std::sort(all.begin(), all.end());
  return all;
}

}  // namespace mlsmesh::core
