// SPDX-License-Identifier: BSD-3-Clause
#include "ours.h"

#include <stdexcept>
#include <utility>

#include "mlsmesh/core/noise.h"
#include "mlsmesh/mls_multiresolution.h"

namespace mlsmesh::bench {
namespace {

core::PointSet pointSetOf(const Cloud::ConstPtr& cloud, core::Context& context) {
  return detail::pointSetOf<pcl::PointXYZ>(cloud, nullptr, core::StoredAs::Float, context);
}

}  // namespace

std::size_t makePolygonMesh(const Cloud::ConstPtr& cloud, const PipelineRun& run,
                            const std::function<void()>& while_held) {
  MlsMultiresolution<pcl::PointXYZ> pipeline;
  pipeline.setInputCloud(cloud);
  pipeline.setNumberOfThreads(run.threads);
  pipeline.parameters().reduce = run.reduce;
  pipeline.setLevels(run.levels);
  pcl::PolygonMesh mesh;
  pipeline.compute(mesh);
  if (!pipeline.status().ok()) throw std::runtime_error(pipeline.status().message);
  while_held();
  return mesh.polygons.size();
}

std::size_t makeFlatTriangles(const Cloud::ConstPtr& cloud, const PipelineRun& run,
                              const std::function<void()>& while_held) {
  core::Context context;
  context.threads = run.threads;
  MultiresolutionParameters parameters;
  parameters.reduce = run.reduce;
  parameters.refinement.levels = run.levels;
  const core::Reconstruction result =
      core::reconstruct(pointSetOf(cloud, context), nullptr, parameters, context);
  while_held();
  return result.mesh.level_triangles.back().size();
}

std::size_t projectEveryPoint(const Cloud::ConstPtr& cloud, int threads) {
  core::Context context;
  context.threads = threads;
  const core::PointSet points = pointSetOf(cloud, context);
  const auto search = core::makeKdTree(points.position);
  const ProjectionParameters parameters;
  const std::vector<core::Vec3> on_surface =
      core::projectAll(points.position, *search, parameters, 0, context);
  Cloud projected = *cloud;
  for (core::Index i = 0; i < points.size(); ++i) {
    projected[points.source[i]].getVector3fMap() = points.world(on_surface[i]).cast<float>();
  }
  return projected.size();
}

}  // namespace mlsmesh::bench
