// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/failure.h"
#include "mlsmesh/core/point_set.h"

#include <pcl/PointIndices.h>

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

namespace mlsmesh::detail {

/// Every point of the set in a list of its own, in the order of the input.
inline core::IndexLists singletons(const core::PointSet& points, const core::Context& context) {
  core::CancelCheck check(context);
  core::IndexLists lists;
  lists.items.resize(points.size());
  lists.begin.resize(points.size() + 1);
  std::iota(lists.items.begin(), lists.items.end(), 0);
  std::iota(lists.begin.begin(), lists.begin.end(), 0);
  std::sort(lists.items.begin(), lists.items.end(), [&](core::Index a, core::Index b) {
    check();
    return points.source[a] < points.source[b];
  });
  return lists;
}

/// Point of the set that stands for each of `count` input points, core::kNone for those left out of it.
inline std::vector<core::Index> pointOfInput(const core::PointSet& points, std::size_t count) {
  std::vector<core::Index> point_of(count, core::kNone);
  for (core::Index point = 0; point < points.size(); ++point) {
    const core::Index* inputs = points.duplicates_of.data(point);
    for (core::Index i = 0; i < points.duplicates_of.size(point); ++i) point_of[inputs[i]] = point;
  }
  return point_of;
}

/// Clusters of input indices (of a cloud of `count` points) as lists of points of the set: each ascending and
/// without repeats, empty ones left out; singletons() if `clusters` is empty. Throws
/// core::Failure(InvalidIndices, EmptyInput, Cancelled).
inline core::IndexLists clusterLists(const core::PointSet& points,
                                     const std::vector<pcl::PointIndices>& clusters, std::size_t count,
                                     const core::Context& context) {
  if (clusters.empty()) return singletons(points, context);
  core::CancelCheck check(context);
  const std::vector<core::Index> point_of = pointOfInput(points, count);
  core::IndexLists lists;
  std::vector<core::Index> members;
  for (const pcl::PointIndices& cluster : clusters) {
    check();
    members.clear();
    for (const auto index : cluster.indices) {
      if (index < 0 || static_cast<std::size_t>(index) >= count) {
        throw core::Failure(StatusCode::InvalidIndices,
                            "setClusters: index " + std::to_string(index) + " is not in the input cloud of " +
                                std::to_string(count) + " points; cluster the cloud that is reduced");
      }
      if (point_of[index] != core::kNone) members.push_back(point_of[index]);
    }
    if (members.empty()) continue;
    std::sort(members.begin(), members.end());
    members.erase(std::unique(members.begin(), members.end()), members.end());
    lists.items.insert(lists.items.end(), members.begin(), members.end());
    lists.begin.push_back(static_cast<core::Index>(lists.items.size()));
  }
  if (lists.count() == 0)
    throw core::Failure(StatusCode::EmptyInput, "setClusters: no cluster holds a usable point");
  return lists;
}

}  // namespace mlsmesh::detail
