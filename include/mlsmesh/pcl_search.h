// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/failure.h"
#include "mlsmesh/core/neighbor_search.h"
#include "mlsmesh/core/point_set.h"
#include "mlsmesh/detail/cloud.h"

#include <pcl/point_cloud.h>
#include <pcl/search/search.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace mlsmesh {

/// A user's pcl::search::Search as the core's search. The search is given a cloud of its own: the distinct
/// finite points, relative to a local origin, in canonical order; it still holds that cloud afterwards. PCL
/// searches in floats, so a few more points than wanted are asked for, their distances are computed again in
/// doubles, and the request grows until no point that was left out can belong to the answer. An exact search
/// therefore gives the result of core::makeKdTree to the last bit, ties included; an approximate one gives
/// what it finds.
///
/// nearest() is called from several threads at once: the search's nearestKSearch must allow that, as those of
/// PCL's KdTree, Octree, BruteForce and FlannSearch do; otherwise use setNumberOfThreads(1).
template <typename PointT>
class PclSearch final : public core::NeighborSearch {
 public:
  using SearchPtr = typename pcl::search::Search<PointT>::Ptr;

  /// Copies the points and hands them to `search`, which must not be null.
  PclSearch(const std::vector<core::Vec3>& points, SearchPtr search)
      : points_(points), search_(std::move(search)) {
    typename pcl::PointCloud<PointT>::Ptr cloud(new pcl::PointCloud<PointT>);
    cloud->resize(points_.size());
    for (std::size_t i = 0; i < points_.size(); ++i) {
      detail::setPosition((*cloud)[i], points_[i]);
      extent_ = std::max(extent_, points_[i].norm());
    }
    search_->setInputCloud(cloud);
  }

  core::Index size() const override { return static_cast<core::Index>(points_.size()); }

  /// Throws core::Failure(InvalidParameter) if the search returns fewer points than it was asked for, or no
  /// valid ones.
  int nearest(const core::Vec3& query, int k, core::Index* indices,
              double* squared_distances) const override {
    thread_local std::vector<Candidate> candidates;
    const int wanted = std::min(k, size());
    if (wanted <= 0) return 0;
    for (int asked = std::min(wanted + kSpare, size());; asked = asked > size() / 2 ? size() : 2 * asked) {
      const double reach = ask(query, asked, candidates);
      if (asked == size() || candidates[wanted - 1].first < reach * reach) break;
    }
    for (int i = 0; i < wanted; ++i) {
      squared_distances[i] = candidates[i].first;
      indices[i] = candidates[i].second;
    }
    return wanted;
  }

 private:
  using Candidate = std::pair<double, core::Index>;
  static constexpr int kSpare = 4;

  // Fills `candidates` with what the search finds, in order; returns a distance below which nothing was left
  // out.
  double ask(const core::Vec3& query, int asked, std::vector<Candidate>& candidates) const {
    thread_local pcl::Indices found;
    thread_local std::vector<float> found_squared;
    found.resize(asked);
    found_squared.resize(asked);
    PointT point;
    detail::setPosition(point, query);
    if (search_->nearestKSearch(point, asked, found, found_squared) < asked)
      fail("returned fewer points than asked for");
    candidates.clear();
    float farthest = 0;
    for (int i = 0; i < asked; ++i) {
      const auto index = static_cast<core::Index>(found[i]);
      if (index < 0 || index >= size()) fail("returned an index that its cloud does not have");
      candidates.emplace_back((points_[index] - query).squaredNorm(), index);
      farthest = std::max(farthest, found_squared[i]);
    }
    std::sort(candidates.begin(), candidates.end());
    if (!std::isfinite(farthest)) return 0;
    constexpr double eps = std::numeric_limits<float>::epsilon();
    return std::max(
        0.0, std::sqrt(static_cast<double>(farthest)) * (1 - 4 * eps) - eps * (query.norm() + extent_));
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw core::Failure(StatusCode::InvalidParameter, "setSearchMethod: the search '" + search_->getName() +
                                                          "' " + what + "; use pcl::search::KdTree or none");
  }

  std::vector<core::Vec3> points_;
  SearchPtr search_;
  double extent_ = 0;  // largest distance of a point from the local origin
};

/// The search to use over `points`: the user's through PclSearch, or the built-in k-d tree if `search` is
/// null. PCL's OrganizedNeighbor cannot search points that are no longer organised: the built-in tree, which
/// finds the same points, takes its place, with a warning. The points must outlive it.
template <typename PointT>
std::unique_ptr<core::NeighborSearch> makeSearch(const core::PointSet& points,
                                                 const typename pcl::search::Search<PointT>::Ptr& search,
                                                 core::Context& context) {
  if (!search) return core::makeKdTreeOver(points.position, context);
  if (search->getName() == "OrganizedNeighbor") {
    context.warnings.emplace_back(
        "setSearchMethod: OrganizedNeighbor searches organised clouds only; the built-in k-d tree was used "
        "instead");
    return core::makeKdTreeOver(points.position, context);
  }
  return std::make_unique<PclSearch<PointT>>(points.position, search);
}

}  // namespace mlsmesh
