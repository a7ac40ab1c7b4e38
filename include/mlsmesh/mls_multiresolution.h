// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/multiresolution.h"
#include "mlsmesh/core/parameter_check.h"
#include "mlsmesh/detail/step.h"
#include "mlsmesh/parameters.h"
#include "mlsmesh/vertex_cloud.h"

#include <pcl/surface/reconstruction.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mlsmesh {

/// All four steps: from a raw cloud to oriented manifold meshes at several resolutions.
///
/// Level 0 is made of the representatives of the clusters (or of the input points, with parameters().reduce =
/// false), and each further level refines the one before; the vertices of a level are the first vertices of
/// the next one. Every vertex is used by a triangle, has a normal on the side the triangles face, a
/// curvature, and all other fields of PointT: colour and intensity averaged, the rest from the nearest input
/// point. O(n log n).
template <typename PointT>
class MlsMultiresolution : public detail::Step<pcl::SurfaceReconstruction<PointT>> {
 public:
  using Ptr = pcl::shared_ptr<MlsMultiresolution<PointT>>;
  using ConstPtr = pcl::shared_ptr<const MlsMultiresolution<PointT>>;

  MlsMultiresolution() { this->check_tree_ = false; }

  MultiresolutionParameters& parameters() { return parameters_; }
  const MultiresolutionParameters& parameters() const { return parameters_; }
  /// Writes parameters().refinement.levels: the number of refinement steps.
  void setLevels(int steps) { parameters_.refinement.levels = steps; }
  /// Writes parameters().projection.degree.
  void setPolynomialOrder(int degree) { parameters_.projection.degree = degree; }

  /// Replaces `output` by the finest level. Empty on failure: NoInput, EmptyInput, TooFewPoints,
  /// DegenerateInput, NoTriangles, InvalidIndices, IndexOverflow, InvalidParameter, Cancelled, OutOfMemory.
  void reconstruct(pcl::PolygonMesh& output) override { performReconstruction(output); }

  /// Replaces `points` and `polygons` by the finest level; both are empty on failure.
  void reconstruct(pcl::PointCloud<PointT>& points, std::vector<pcl::Vertices>& polygons) override {
    performReconstruction(points, polygons);
  }

  /// Runs the steps and makes no mesh of PCL's, which takes 56 bytes a triangle and a copy of the vertices
  /// beside the 12 bytes a triangle of reconstruction().mesh.level_triangles. getLevel() makes one when
  /// asked.
  void compute() {
    build([](const core::Context&) {});
  }

  /// The same as reconstruct().
  void compute(pcl::PolygonMesh& output) { reconstruct(output); }
  void compute(pcl::PointCloud<PointT>& points, std::vector<pcl::Vertices>& polygons) {
    reconstruct(points, polygons);
  }

  /// Refinement steps + 1 after a run that succeeded, else 0.
  int getLevelCount() const { return static_cast<int>(reconstruction().mesh.levelCount()); }

  /// Replaces `output` by level `level`; empties it and returns false if there is no such level.
  bool getLevel(int level, pcl::PolygonMesh& output) const {
    detail::clear(output);
    const Status made =
        core::guarded([&] { makePolygonMesh(reconstruction().mesh, level, vertices({}), output); });
    if (!made.ok()) detail::clear(output);
    return made.ok();
  }

  /// Topology of every level of the last run.
  const std::vector<MeshReport>& reports() const { return reconstruction().reports; }
  /// Wall-clock time of every stage of the last run, in order.
  const std::vector<core::StageTime>& stages() const { return reconstruction().stages; }
  /// All that the last run made, as plain data; empty if it failed.
  const core::Reconstruction& reconstruction() const { return reconstruction_ ? *reconstruction_ : nothing_; }

  std::string getClassName() const override { return "MlsMultiresolution"; }

 protected:
  void performReconstruction(pcl::PolygonMesh& output) override {
    detail::clear(output);
    build([&](const core::Context& context) {
      makePolygonMesh(reconstruction().mesh, getLevelCount() - 1, vertices(context), output, context);
    });
    if (!this->status().ok()) detail::clear(output);
  }

  void performReconstruction(pcl::PointCloud<PointT>& points, std::vector<pcl::Vertices>& polygons) override {
    detail::clear(points);
    polygons.clear();
    build([&](const core::Context& context) {
      polygons = toPolygons(reconstruction().mesh.level_triangles.back(), context);
      detail::fromBlob(vertices(context), points);
    });
    if (this->status().ok()) return;
    detail::clear(points);
    polygons.clear();
  }

 private:
  // Runs the four steps, then hands over the result by write(context).
  template <typename Write>
  void build(const Write& write) {
    reset();
    this->run([&](core::Context& context) {
      core::check(parameters_);
      core::PointSet points = this->preparePoints(detail::storedAs<PointT>(), context);
      const core::SearchFactory factory = [&](const core::PointSet& set) {
        return makeSearch<PointT>(set, this->tree_, context);
      };
      reconstruction_.emplace(core::reconstruct(std::move(points), factory, parameters_, context));
      computed_ = this->input_;
      context.progress.enterStage("output", 1.0);
      write(context);
    });
    if (!this->status().ok()) reset();
  }

  // Of the finest level, with the fields of the cloud that was computed; made when first asked for.
  const pcl::PCLPointCloud2& vertices(const core::Context& context) const {
    if (vertices_.fields.empty() && getLevelCount() > 0) {
      pcl::PCLPointCloud2 input, made;
      detail::toBlob(*computed_, input);
      makeLevelCloud(reconstruction(), reconstruction().mesh.levelCount() - 1, input, made, context);
      vertices_ = std::move(made);
    }
    return vertices_;
  }

  // Takes no memory, which may be what has run out.
  void reset() {
    reconstruction_.reset();
    vertices_ = {};
    computed_.reset();
  }

  MultiresolutionParameters parameters_;
  const core::Reconstruction nothing_;
  std::optional<core::Reconstruction> reconstruction_;
  typename pcl::PointCloud<PointT>::ConstPtr computed_;
  mutable pcl::PCLPointCloud2 vertices_;
};

}  // namespace mlsmesh
