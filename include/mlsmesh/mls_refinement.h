// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/mls_refinement.h"
#include "mlsmesh/core/mls_surface.h"
#include "mlsmesh/core/parameter_check.h"
#include "mlsmesh/detail/input_mesh.h"
#include "mlsmesh/detail/step.h"
#include "mlsmesh/parameters.h"
#include "mlsmesh/vertex_cloud.h"

#include <pcl/surface/processing.h>

#include <string>
#include <utility>
#include <vector>

namespace mlsmesh {

/// Step 4: refines a mesh towards the moving-least-squares surface of a cloud, in levels.
///
/// Level 0 is the input mesh with all its vertices, used or not, where they are. Each further level splits
/// edges where the surface departs from the mesh; the vertices of a level are the first vertices of the next
/// one and stay in place. Vertices keep all fields of the mesh's cloud and get normals, oriented as the
/// triangles are; a new vertex averages the colour of the two ends of its edge and takes every other field
/// from the nearer end. Coordinates keep the mesh's type (float32 or float64).
///
/// Calling process() through a pointer to pcl::MeshProcessing works, except that PCL's function, which is not
/// virtual, reads the mesh before it gets here: without a mesh it crashes.
template <typename PointInT>
class MlsRefinement : public detail::SearchingStep<pcl::PCLBase<PointInT>>, public pcl::MeshProcessing {
 public:
  using Ptr = pcl::shared_ptr<MlsRefinement<PointInT>>;
  using ConstPtr = pcl::shared_ptr<const MlsRefinement<PointInT>>;

  MlsRefinement() = default;

  RefinementParameters& parameters() { return parameters_; }
  const RefinementParameters& parameters() const { return parameters_; }
  /// Of the MLS surface that new vertices are projected on.
  ProjectionParameters& projection() { return projection_; }
  const ProjectionParameters& projection() const { return projection_; }
  /// Writes parameters().levels: the number of refinement steps.
  void setLevels(int steps) { parameters_.levels = steps; }

  /// Replaces `output` by the finest level. Needs setInputMesh (an oriented triangle 2-manifold) and
  /// setInputCloud (the points that the mesh approximates). Empty on failure: NoMesh, InvalidMesh, NoInput,
  /// EmptyInput, TooFewPoints, DegenerateInput, InvalidIndices, IndexOverflow, InvalidParameter, Cancelled,
  /// OutOfMemory.
  void process(pcl::PolygonMesh& output) { performProcessing(output); }

  /// The same as process().
  void compute(pcl::PolygonMesh& output) { process(output); }

  /// Refinement steps + 1 after a run that succeeded, else 0.
  int getLevelCount() const { return static_cast<int>(mesh_.levelCount()); }

  /// Replaces `output` by level `level`; empties it and returns false if there is no such level.
  bool getLevel(int level, pcl::PolygonMesh& output) const {
    detail::clear(output);
    const Status made = core::guarded([&] { makePolygonMesh(mesh_, level, vertices_, output); });
    if (!made.ok()) detail::clear(output);
    return made.ok();
  }

  /// The levels as plain data; positions are relative to origin().
  const core::RefinedMesh& refinedMesh() const { return mesh_; }
  const core::Vec3& origin() const { return origin_; }

  std::string getClassName() const override { return "MlsRefinement"; }

 protected:
  /// What pcl::MeshProcessing::process asks first; the checks are made in performProcessing, which reports
  /// them.
  bool initCompute() override { return true; }
  void deinitCompute() override {}

  void performProcessing(pcl::PolygonMesh& output) override {
    detail::clear(output);
    mesh_ = {};
    vertices_ = {};
    this->run([&](core::Context& context) {
      core::RefinedMesh mesh = refine(context);
      makePolygonMesh(mesh, mesh.levelCount() - 1, vertices_, output, context);
      mesh_ = std::move(mesh);
    });
    if (this->status().ok()) return;
    detail::clear(output);
    mesh_ = {};
    vertices_ = {};
  }

 private:
  core::RefinedMesh refine(core::Context& context) {
    core::check(parameters_);
    core::check(projection_);
    const detail::InputMesh input = detail::readMesh(this->input_mesh_, context);
    core::PointSet points = this->preparePoints(input.stored_as, context);
    const auto search = this->prepareSearch(points, context);
    const core::MlsSurface surface(points.position, *search, projection_);
    core::RefinedMesh mesh = detail::levelZero(input, points, surface, context);
    const double spacing = core::medianSpacing(points.position, *search, context);
    const double begin = context.progress.fraction();
    for (int level = 1; level <= parameters_.levels; ++level) {
      context.progress.enterStage("refinement " + std::to_string(level),
                                  begin + (1 - begin) * level / parameters_.levels);
      core::addLevel(points, surface, spacing, parameters_, context, mesh);
    }
    origin_ = points.origin;
    context.progress.enterStage("output", 1.0);
    makeVertices(input, points, mesh, context);
    return mesh;
  }

  void makeVertices(const detail::InputMesh& input, const core::PointSet& points,
                    const core::RefinedMesh& mesh, const core::Context& context) {
    core::CancelCheck check(context);
    VertexData data;
    VertexSources sources;
    data.stored_as = input.stored_as;
    data.position = input.position;
    data.normal = mesh.normal;
    sources.parents = mesh.parents;
    for (std::size_t i = 0; i < mesh.position.size(); ++i) {
      check();
      if (i < input.position.size()) {
        sources.nearest.push_back(static_cast<core::Index>(i));
        continue;
      }
      data.position.push_back(points.world(mesh.position[i]));
      const auto [a, b] = mesh.parents[i];
      const double to_a = (mesh.position[i] - mesh.position[a]).squaredNorm();
      const double to_b = (mesh.position[i] - mesh.position[b]).squaredNorm();
      sources.nearest.push_back(sources.nearest[to_b < to_a ? b : a]);
    }
    makeVertexCloud(this->input_mesh_->cloud, data, sources, vertices_, context);
  }

  RefinementParameters parameters_;
  ProjectionParameters projection_;
  core::RefinedMesh mesh_;
  core::Vec3 origin_ = core::Vec3::Zero();
  pcl::PCLPointCloud2 vertices_;
};

}  // namespace mlsmesh
