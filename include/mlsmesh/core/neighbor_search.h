// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "mlsmesh/core/context.h"
#include "mlsmesh/core/types.h"

namespace mlsmesh::core {

/// k-nearest-neighbour search over a fixed set of points.
class NeighborSearch {
 public:
  virtual ~NeighborSearch() = default;
  virtual Index size() const = 0;
  /// The min(k, size()) points nearest to `query`, in order of (squared distance, index); returns how many.
  /// Both arrays hold k entries; `query` must be finite. May be called from several threads at once.
  virtual int nearest(const Vec3& query, int k, Index* indices, double* squared_distances) const = 0;
};

/// A k-d tree over a copy of the points; exact, ties at the k-th distance go to the lowest index. O(n log n),
/// 36 bytes a point. Throws Failure(Cancelled) when the context's handle says so while it is built.
std::unique_ptr<NeighborSearch> makeKdTree(const std::vector<Vec3>& points, const Context& context = {});

/// The same without the copy, for large clouds in spatial order: the points must stay where they are and as
/// they are for as long as it is asked. 24 bytes a point less, searches a few per cent slower.
std::unique_ptr<NeighborSearch> makeKdTreeOver(const std::vector<Vec3>& points, const Context& context = {});

/// The k nearest *other* points of every point, as one flat n x k array, nearest first; rows are full unless
/// the set has fewer than k + 1 points, then `k` is smaller than asked.
struct NeighborTable {
  int k = 0;
  std::vector<Index> indices;

  const Index* row(Index point) const { return indices.data() + static_cast<std::size_t>(point) * k; }
};

/// Asks `search` (built over `points`) for every point, in parallel. Throws Failure(Internal) if it returns
/// fewer than there are. O(n k log n).
NeighborTable nearestOfAll(const std::vector<Vec3>& points, const NeighborSearch& search, int k,
                           const Context& context);

/// Mean distance of each point to its 6 nearest others (fewer if the table has fewer): its local spacing ls.
std::vector<double> localSpacings(const std::vector<Vec3>& points, const NeighborTable& neighbors,
                                  const Context& context);

/// Median (upper of two) distance of a point to its nearest other, over at most 5,000 points spread evenly
/// over the order: the spacing of the cloud, the unit of global lengths.
double medianSpacing(const std::vector<Vec3>& points, const NeighborSearch& search, const Context& context);

}  // namespace mlsmesh::core
