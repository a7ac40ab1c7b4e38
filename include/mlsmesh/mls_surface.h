// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/mls_surface.h"
#include "mlsmesh/core/parameter_check.h"
#include "mlsmesh/detail/step.h"
#include "mlsmesh/parameters.h"

#include <limits>
#include <memory>
#include <optional>
#include <string>

namespace mlsmesh {

/// The moving-least-squares surface of a cloud, to be asked at any place: the projection Psi, the normal, the
/// residual.
///
/// compute() takes a copy of what it needs, so the cloud may change afterwards; it must be called again after
/// parameters or input changed. The questions are const and may be asked from several threads at once, if a
/// user's search method allows that (see PclSearch).
template <typename PointT>
class MlsSurface : public detail::SearchingStep<pcl::PCLBase<PointT>> {
 public:
  using Ptr = pcl::shared_ptr<MlsSurface<PointT>>;
  using ConstPtr = pcl::shared_ptr<const MlsSurface<PointT>>;

  MlsSurface() = default;

  ProjectionParameters& parameters() { return parameters_; }
  const ProjectionParameters& parameters() const { return parameters_; }

  /// Prepares points and search; returns status().ok(). Fails with NoInput, EmptyInput, TooFewPoints,
  /// DegenerateInput, InvalidIndices, IndexOverflow, InvalidParameter, Cancelled, OutOfMemory. O(n log n).
  bool compute() {
    surface_.reset();
    search_.reset();
    this->run([&](core::Context& context) {
      core::check(parameters_);
      points_ = this->preparePoints(core::StoredAs::Double, context);
      search_ = this->prepareSearch(points_, context);
      spacing_ = core::medianSpacing(points_.position, *search_, context);
      surface_.emplace(points_.position, *search_, parameters_);
    });
    if (!this->status().ok()) surface_.reset();
    return this->status().ok();
  }

  /// True after a compute() that succeeded.
  bool ready() const { return surface_.has_value(); }

  /// Psi(x) and what was learnt on the way: `x` and the result's position in the coordinates of the input
  /// cloud, `nearest` an index into it. Unless ready(), or where x is not finite: NaN, and nearest =
  /// core::kNone. O(k log n).
  core::Projection project(const core::Vec3& x) const {
    core::Projection result;
    const bool answered = ready() && x.allFinite() && core::guarded([&] {
                                                        result = surface_->project(x - points_.origin);
                                                        result.nearest = points_.source[result.nearest];
                                                        result.position += points_.origin;
                                                      }).ok();
    return answered ? result : nowhere();
  }

  /// ||Psi(x) - x||, 0 on the surface; NaN where project() has no answer.
  double residual(const core::Vec3& x) const { return (project(x).position - x).norm(); }

  /// Median distance of a point to its nearest other, the unit of global lengths; 0 before compute().
  double spacing() const { return spacing_; }

  std::string getClassName() const { return "MlsSurface"; }

 private:
  static core::Projection nowhere() {
    core::Projection result;
    result.position.setConstant(std::numeric_limits<double>::quiet_NaN());
    result.normal = result.mean_difference = result.position;
    return result;
  }

  ProjectionParameters parameters_;
  core::PointSet points_;
  std::unique_ptr<core::NeighborSearch> search_;
  std::optional<core::MlsSurface> surface_;  // refers to points_ and *search_
  double spacing_ = 0;
};

}  // namespace mlsmesh
