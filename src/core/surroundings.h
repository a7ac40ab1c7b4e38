// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <utility>

#include "mlsmesh/core/multiresolution.h"

namespace mlsmesh::core {

/// The cloud as the steps see it: its points, denoised and without outliers where that was needed, the search
/// over them, and their surface.
class Surroundings {
 public:
  Surroundings(PointSet set, const SearchFactory& makeSearch)
      : points(std::move(set)), makeSearch_(makeSearch) {
    renewSearch();
  }

  const NeighborSearch& search() const { return *search_; }
  const MlsSurface& surface() const { return *surface_; }

  void renewSearch() { search_ = makeSearch_(points); }
  void renewSurface(const ProjectionParameters& parameters, double residual_limit) {
    surface_ = std::make_unique<MlsSurface>(points.position, *search_, parameters, residual_limit);
  }

  PointSet points;

 private:
  const SearchFactory& makeSearch_;
  std::unique_ptr<NeighborSearch> search_;
  std::unique_ptr<MlsSurface> surface_;
};

/// The surface of the points as they are now, fitted as the noise asks for.
inline void renewSurface(const NoiseAdaptation& noise, Surroundings& cloud) {
  cloud.renewSurface(noise.parameters.projection, noise.passes > 0 ? 0 : noise.residual_limit);
}

}  // namespace mlsmesh::core
