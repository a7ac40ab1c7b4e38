// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "mlsmesh/core/neighbor_search.h"
#include "mlsmesh/parameters.h"

namespace mlsmesh::core {

/// The points around a place, nearest first, on the stack of whoever fits them. The distances are those from
/// the place last asked about.
struct Neighborhood {
  static constexpr int kMost = 512;

  std::array<Index, kMost> index;
  std::array<double, kMost> squared_distance;
  std::array<double, kMost> weight;
  int count = 0;
  bool is_weighted = false;

  /// None about a place that is not finite, or too far away for the square of a distance to be.
  void find(const NeighborSearch& search, const Vec3& x, int wanted);
  /// Weights exp(-d^2 / support^2) about the centre, relative to the nearest neighbour's, so that they cannot
  /// all underflow however small the support is; equal ones where even its square underflows.
  void weigh(const std::vector<Vec3>& points, const Vec3& center, double support);
  /// Forgets all but the first `most` of those that `isWanted(i)`; i counts neighbours.
  template <typename Wanted>
  void keepIf(const Wanted& isWanted, int most = kMost);

  /// d_k / sqrt(k / pi): the spacing of points spread evenly over a disc of radius d_k.
  double localSpacing() const;
  /// h, positive even where all neighbours are at one place.
  double supportRadius(double local_spacing, const ProjectionParameters& parameters) const;
  /// (1/k) sum (p - x).
  Vec3 meanDifference(const std::vector<Vec3>& points, const Vec3& x) const;
  /// The point nearest to the position; of equals the one of lower number.
  Index nearestTo(const std::vector<Vec3>& points, const Vec3& position) const;
};

template <typename Wanted>
void Neighborhood::keepIf(const Wanted& isWanted, int most) {
  int kept = 0;
  for (int i = 0; i < count && kept < most; ++i) {
    if (!isWanted(i)) continue;
    index[kept] = index[i];
    squared_distance[kept] = squared_distance[i];
    if (is_weighted) weight[kept] = weight[i];
    ++kept;
  }
  count = kept;
}

}  // namespace mlsmesh::core
