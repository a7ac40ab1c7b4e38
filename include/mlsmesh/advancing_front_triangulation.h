// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/advancing_front.h"
#include "mlsmesh/core/parameter_check.h"
#include "mlsmesh/detail/step.h"
#include "mlsmesh/parameters.h"

#include <pcl/surface/reconstruction.h>

#include <string>
#include <utility>
#include <vector>

namespace mlsmesh {

/// Step 3, and a replacement for pcl::GreedyProjectionTriangulation that needs no normals: an oriented
/// manifold mesh whose vertices are the input points.
///
/// Normals of the input, if it has any, are ignored. Polygons are triangles that index the whole input cloud,
/// also when setIndices chooses some of its points; points that are not finite, that repeat another, or where
/// no triangle fits stay unused. Every edge has one or two triangles, in opposite directions, every vertex
/// one fan; closed components face outward. Same points and parameters, same triangles, for any number of
/// threads, any exact search method, and, but for the numbers of the points, any order of the input. O(n log
/// n).
template <typename PointInT>
class AdvancingFrontTriangulation : public detail::Step<pcl::MeshConstruction<PointInT>> {
 public:
  using Ptr = pcl::shared_ptr<AdvancingFrontTriangulation<PointInT>>;
  using ConstPtr = pcl::shared_ptr<const AdvancingFrontTriangulation<PointInT>>;

  AdvancingFrontTriangulation() { this->check_tree_ = false; }

  TriangulationParameters& parameters() { return parameters_; }
  const TriangulationParameters& parameters() const { return parameters_; }
  /// How the triangles of the last run came about.
  const core::FrontStatistics& statistics() const { return statistics_; }

  /// Replaces `output` by the whole input cloud with all its fields, and the triangles. Empty on failure:
  /// NoInput, EmptyInput, TooFewPoints, DegenerateInput, NoTriangles, InvalidIndices, IndexOverflow,
  /// InvalidParameter, Cancelled, OutOfMemory.
  void reconstruct(pcl::PolygonMesh& output) override { performReconstruction(output); }

  /// Replaces `polygons` by the triangles; empty on failure.
  void reconstruct(std::vector<pcl::Vertices>& polygons) override { performReconstruction(polygons); }

  /// The same as reconstruct().
  void compute(pcl::PolygonMesh& output) { reconstruct(output); }
  void compute(std::vector<pcl::Vertices>& polygons) { reconstruct(polygons); }

  std::string getClassName() const override { return "AdvancingFrontTriangulation"; }

 protected:
  void performReconstruction(pcl::PolygonMesh& output) override {
    detail::clear(output);
    this->run([&](core::Context& context) {
      std::vector<pcl::Vertices> polygons = triangulate(context);
      detail::toBlob(*this->input_, output.cloud);
      output.header = this->input_->header;
      output.polygons.swap(polygons);
    });
    if (!this->status().ok()) detail::clear(output);
  }

  void performReconstruction(std::vector<pcl::Vertices>& polygons) override {
    polygons.clear();
    this->run([&](core::Context& context) { polygons = triangulate(context); });
    if (!this->status().ok()) polygons.clear();
  }

 private:
  std::vector<pcl::Vertices> triangulate(core::Context& context) {
    statistics_ = {};
    core::check(parameters_);
    const core::PointSet points = this->preparePoints(detail::storedAs<PointInT>(), context);
    context.progress.enterStage("search", 0.1);
    const auto search = makeSearch<PointInT>(points, this->tree_, context);
    context.progress.enterStage("triangulation", 1.0);
    core::TriangulationInput input{points.position};
    input.search = search.get();
    input.spacing = core::medianSpacing(points.position, *search, context);
    const core::Triangulation result = core::triangulate(input, parameters_, context);
    context.progress.enterStage("output", 1.0);
    core::CancelCheck check(context);
    std::vector<pcl::Vertices> polygons(result.triangles.size());
    for (std::size_t i = 0; i < polygons.size(); ++i) {
      check();
      for (const core::Index corner : result.triangles[i]) {
        polygons[i].vertices.push_back(points.source[corner]);
      }
    }
    statistics_ = result.statistics;
    return polygons;
  }

  TriangulationParameters parameters_;
  core::FrontStatistics statistics_;
};

}  // namespace mlsmesh
