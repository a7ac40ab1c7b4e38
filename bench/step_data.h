// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "mlsmesh/core/multiresolution.h"

namespace mlsmesh::bench {

/// A cloud and what each step of the pipeline finds when its turn comes, made when first asked for, on one
/// thread (others would still spin while the clock runs). Parameters are the defaults; what level 0 is made
/// of has them adapted to the noise, as in the pipeline. What a member returns stays valid and unchanged.
class StepData {
 public:
  explicit StepData(std::vector<core::Vec3> world) : world_(std::move(world)) { context_.threads = 1; }
  StepData(const StepData&) = delete;
  StepData& operator=(const StepData&) = delete;

  /// What the first two steps left: every point is in one cluster, every cluster has its representative.
  struct Reduced {
    core::IndexLists clusters;
    core::Representatives representatives;
  };

  const std::vector<core::Vec3>& world() const { return world_; }
  const core::PointSet& points();
  const core::NeighborSearch& search();
  double spacing();
  const core::MlsSurface& surface();
  const core::IndexLists& clusters();
  const Reduced& reduced();
  /// The pipeline's level 0, with the points and the representatives that it kept.
  const core::Reconstruction& levelZero();
  /// Over levelZero().points.
  const core::NeighborSearch& levelZeroSearch();
  /// That of levelZero().points.
  const core::MlsSurface& levelZeroSurface();

 private:
  std::vector<core::Vec3> world_;
  core::Context context_;  // of one thread
  std::optional<core::PointSet> points_;
  std::unique_ptr<core::NeighborSearch> search_;
  std::optional<core::MlsSurface> surface_;
  std::optional<core::IndexLists> clusters_;
  std::optional<Reduced> reduced_;
  std::optional<core::Reconstruction> level_zero_;
  std::unique_ptr<core::NeighborSearch> level_zero_search_;
  std::optional<core::MlsSurface> level_zero_surface_;
};

}  // namespace mlsmesh::bench
