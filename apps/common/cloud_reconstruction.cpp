// SPDX-License-Identifier: BSD-3-Clause
#include "common/cloud_reconstruction.h"

#include "mlsmesh/vertex_cloud.h"

#include <chrono>
#include <utility>

namespace mlsmesh::apps {

core::Reconstruction reconstructCloud(const pcl::PCLPointCloud2& cloud,
                                      const MultiresolutionParameters& parameters, core::Context& context) {
  const auto start = std::chrono::steady_clock::now();
  context.progress.enterStage("prepare", 0.02);
  core::StoredAs stored_as = core::StoredAs::Float;
  std::vector<core::Vec3> positions = worldPositions(cloud, stored_as);
  core::PointSet points = core::makePointSet(std::move(positions), stored_as, nullptr, context);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  core::Reconstruction result = core::reconstruct(std::move(points), nullptr, parameters, context);
  result.stages.insert(result.stages.begin(), {"prepare", seconds.count()});
  return result;
}

}  // namespace mlsmesh::apps
