// SPDX-License-Identifier: BSD-3-Clause
#include "step_data.h"

#include "mlsmesh/core/bsp_clustering.h"

namespace mlsmesh::bench {

const core::PointSet& StepData::points() {
  if (!points_) points_ = core::makePointSet(world_, core::StoredAs::Float, nullptr, context_);
  return *points_;
}

const core::NeighborSearch& StepData::search() {
  if (!search_) search_ = core::makeKdTree(points().position);
  return *search_;
}

double StepData::spacing() {
  return core::medianSpacing(points().position, search(), context_);
}

const core::MlsSurface& StepData::surface() {
  if (!surface_) surface_.emplace(points().position, search(), ProjectionParameters{});
  return *surface_;
}

const core::IndexLists& StepData::clusters() {
  if (!clusters_) clusters_ = core::clusterPoints(points().position, ClusteringParameters{}, context_);
  return *clusters_;
}

const StepData::Reduced& StepData::reduced() {
  if (!reduced_) {
    reduced_.emplace();
    reduced_->clusters = clusters();
    reduced_->representatives =
        core::reducePoints(points(), surface(), reduced_->clusters, ReductionParameters{}, context_);
  }
  return *reduced_;
}

const core::Reconstruction& StepData::levelZero() {
  if (!level_zero_) {
    MultiresolutionParameters parameters;
    parameters.refinement.levels = 0;
    level_zero_ = core::reconstruct(core::PointSet(points()), nullptr, parameters, context_);
  }
  return *level_zero_;
}

const core::NeighborSearch& StepData::levelZeroSearch() {
  if (!level_zero_search_) level_zero_search_ = core::makeKdTree(levelZero().points.position);
  return *level_zero_search_;
}

const core::MlsSurface& StepData::levelZeroSurface() {
  if (!level_zero_surface_) {
    const core::NoiseAdaptation& noise = levelZero().noise;
    level_zero_surface_.emplace(levelZero().points.position, levelZeroSearch(), noise.parameters.projection,
                                noise.residual_limit);
  }
  return *level_zero_surface_;
}

}  // namespace mlsmesh::bench
