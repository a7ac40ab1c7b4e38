// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/bsp_clustering.h"
#include "mlsmesh/core/parameter_check.h"
#include "mlsmesh/detail/step.h"
#include "mlsmesh/parameters.h"
#include "mlsmesh/vertex_cloud.h"

#include <pcl/PointIndices.h>

#include <algorithm>
#include <string>
#include <vector>

namespace mlsmesh {

/// Step 1: groups the points of a cloud by a BSP tree until every group is small and flat enough.
///
/// Every finite point that takes part is in exactly one cluster, an exact duplicate in that of the point it
/// equals; points that are not finite are in none. Clusters come in the tree's order, which depends on the
/// set of points alone and not on their order in the cloud. Clustering asks for no neighbours: a search
/// method is accepted, as in the other steps, and stays unused. O(n log n).
template <typename PointT>
class BspClustering : public detail::SearchingStep<pcl::PCLBase<PointT>> {
 public:
  using Ptr = pcl::shared_ptr<BspClustering<PointT>>;
  using ConstPtr = pcl::shared_ptr<const BspClustering<PointT>>;

  BspClustering() = default;

  ClusteringParameters& parameters() { return parameters_; }
  const ClusteringParameters& parameters() const { return parameters_; }

  /// Replaces `clusters` by the clusters of the input, as indices into the whole input cloud, each list
  /// ascending. Empty on failure: NoInput, EmptyInput, TooFewPoints, DegenerateInput, InvalidIndices,
  /// IndexOverflow, InvalidParameter, Cancelled, OutOfMemory.
  void extract(std::vector<pcl::PointIndices>& clusters) {
    clusters.clear();
    this->run([&](core::Context& context) {
      core::check(parameters_);
      const core::PointSet points = this->preparePoints(core::StoredAs::Double, context);
      context.progress.enterStage("clustering", 1.0);
      const core::IndexLists lists =
          inputIndices(points, core::clusterPoints(points.position, parameters_, context), context);
      context.progress.enterStage("output", 1.0);
      core::CancelCheck check(context);
      std::vector<pcl::PointIndices> result(lists.count());
      for (core::Index i = 0; i < lists.count(); ++i) {
        check();
        result[i].header = this->input_->header;
        result[i].indices.assign(lists.data(i), lists.data(i) + lists.size(i));
        std::sort(result[i].indices.begin(), result[i].indices.end());
      }
      clusters.swap(result);
    });
    if (!this->status().ok()) clusters.clear();
  }

  /// The same as extract().
  void compute(std::vector<pcl::PointIndices>& clusters) { extract(clusters); }

  std::string getClassName() const { return "BspClustering"; }

 private:
  ClusteringParameters parameters_;
};

}  // namespace mlsmesh
