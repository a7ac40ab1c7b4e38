// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/mls_reduction.h"
#include "mlsmesh/core/mls_surface.h"
#include "mlsmesh/core/parameter_check.h"
#include "mlsmesh/detail/cluster_lists.h"
#include "mlsmesh/detail/step.h"
#include "mlsmesh/parameters.h"
#include "mlsmesh/vertex_cloud.h"

#include <pcl/PointIndices.h>
#include <pcl/surface/processing.h>

#include <string>
#include <utility>
#include <vector>

namespace mlsmesh {

/// Step 2: one point per cluster, projected on the moving-least-squares surface of the whole input.
///
/// Output points have a position, and, as far as PointOutT has the fields: normal (unit, sign arbitrary),
/// curvature (the surface variation sigma, 0 .. 1/3), cluster_size (uint32), colour and intensity averaged
/// over the cluster, and every other field of PointInT from the nearest input point. Without clusters every
/// distinct finite point is projected itself, in the order of the input, as pcl::MovingLeastSquares does.
/// Representatives that coincide are kept once. O(n log n) for the search, then O(1) a representative.
template <typename PointInT, typename PointOutT>
class MlsReduction : public detail::SearchingStep<pcl::CloudSurfaceProcessing<PointInT, PointOutT>> {
 public:
  using Ptr = pcl::shared_ptr<MlsReduction<PointInT, PointOutT>>;
  using ConstPtr = pcl::shared_ptr<const MlsReduction<PointInT, PointOutT>>;
  using PointCloudOut = pcl::PointCloud<PointOutT>;

  MlsReduction() = default;

  ReductionParameters& parameters() { return parameters_; }
  const ReductionParameters& parameters() const { return parameters_; }
  /// Of the MLS surface on which the points are projected.
  ProjectionParameters& projection() { return projection_; }
  const ProjectionParameters& projection() const { return projection_; }
  /// Writes projection().degree.
  void setPolynomialOrder(int degree) { projection_.degree = degree; }

  /// Groups of indices into the whole input cloud, such as those of BspClustering; an empty list (default)
  /// projects every point itself. Members that are not finite, or that setIndices leaves out, do not count; a
  /// cluster with no other member gives no representative.
  void setClusters(const std::vector<pcl::PointIndices>& clusters) { clusters_ = clusters; }

  /// Number of distinct input points behind each output point of the last run.
  const std::vector<core::Index>& clusterSizes() const { return cluster_sizes_; }

  /// Replaces `output` by the representatives. Empty on failure: NoInput, EmptyInput, TooFewPoints,
  /// DegenerateInput, InvalidIndices (also for a cluster that names points the cloud does not have),
  /// IndexOverflow, InvalidParameter, Cancelled, OutOfMemory.
  void process(PointCloudOut& output) override { performProcessing(output); }

  /// The same as process().
  void compute(PointCloudOut& output) { process(output); }

  std::string getClassName() const { return "MlsReduction"; }

 protected:
  void performProcessing(PointCloudOut& output) override {
    detail::clear(output);
    cluster_sizes_.clear();
    this->run([&](core::Context& context) {
      core::check(projection_);
      const core::PointSet points = this->preparePoints(detail::storedAs<PointOutT>(), context);
      core::IndexLists clusters = detail::clusterLists(points, clusters_, this->input_->size(), context);
      const auto search = this->prepareSearch(points, context);
      context.progress.enterStage("reduction", 1.0);
      const core::MlsSurface surface(points.position, *search, projection_);
      const core::Representatives representatives =
          core::reducePoints(points, surface, clusters, parameters_, context);
      context.progress.enterStage("output", 1.0);
      write(points, clusters, representatives, context, output);
    });
    if (this->status().ok()) return;
    detail::clear(output);
    cluster_sizes_.clear();
  }

 private:
  void write(const core::PointSet& points, const core::IndexLists& clusters,
             const core::Representatives& representatives, const core::Context& context,
             PointCloudOut& output) {
    core::CancelCheck check(context);
    VertexData data;
    VertexSources sources;
    data.stored_as = points.stored_as;
    data.normal = representatives.normal;
    data.curvature = representatives.variation;
    for (core::Index i = 0; i < representatives.size(); ++i) {
      check();
      data.position.push_back(points.world(representatives.position[i]));
      data.cluster_size.push_back(clusters.size(i));
      sources.nearest.push_back(points.source[representatives.nearest[i]]);
    }
    sources.members = inputIndices(points, clusters, context);
    pcl::PCLPointCloud2 input, vertices;
    detail::toBlob(*this->input_, input);
    makeVertexCloud(input, data, sources, vertices, context);
    cluster_sizes_ = std::move(data.cluster_size);
    detail::fromBlob(vertices, output);
  }

  ReductionParameters parameters_;
  ProjectionParameters projection_;
  std::vector<pcl::PointIndices> clusters_;
  std::vector<core::Index> cluster_sizes_;
};

}  // namespace mlsmesh
