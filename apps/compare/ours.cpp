// SPDX-License-Identifier: BSD-3-Clause
#include "compare/reconstructors.h"
#include "mlsmesh/mls_multiresolution.h"

#include <algorithm>
#include <new>
#include <stdexcept>

namespace mlsmesh::apps {
namespace {

pcl::PolygonMesh run(const MethodInput& input, const MultiresolutionParameters& parameters,
                     StageClock& clock) {
  MlsMultiresolution<pcl::PointXYZ> multiresolution;
  multiresolution.setInputCloud(input.cloud);
  multiresolution.setNumberOfThreads(input.threads);
  multiresolution.parameters() = parameters;
  pcl::PolygonMesh mesh;
  const double begin = wallSeconds();
  multiresolution.compute(mesh);
  double rest = wallSeconds() - begin;
  if (multiresolution.status().code == StatusCode::OutOfMemory) throw std::bad_alloc();
  if (!multiresolution.status().ok()) throw std::runtime_error(multiresolution.status().message);
  for (const core::StageTime& stage : multiresolution.stages()) {
    clock.add({stage.name, stage.seconds});
    rest -= stage.seconds;
  }
  clock.add({"conversion", std::max(rest, 0.0)});
  return mesh;
}

MultiresolutionParameters toLevel(int level, MultiresolutionParameters parameters) {
  parameters.refinement.levels = level;
  return parameters;
}

}  // namespace

pcl::PolygonMesh reconstructLevel(const MethodInput& input, int level, StageClock& clock) {
  return run(input, toLevel(level, input.parameters), clock);
}

pcl::PolygonMesh reconstructPaperLevel(const MethodInput& input, int level, StageClock& clock) {
  return run(input, toLevel(level, paperPreset()), clock);
}

pcl::PolygonMesh reconstructUnreduced(const MethodInput& input, StageClock& clock) {
  MultiresolutionParameters parameters = toLevel(0, input.parameters);
  parameters.reduce = false;
  return run(input, parameters, clock);
}

}  // namespace mlsmesh::apps
