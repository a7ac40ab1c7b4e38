// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/multiresolution.h"

#include <array>
#include <cstdint>
#include <vector>

namespace mlsmesh::apps {

using Rgb = std::array<std::uint8_t, 3>;

/// What is drawn: points, or a mesh over them.
struct Shape {
  std::vector<core::Vec3> points;         ///< finite
  std::vector<core::Triangle> triangles;  ///< whose corners are points; none: a cloud
  std::vector<core::Vec3> normals;        ///< one a point, or none
  std::vector<Rgb> colors;                ///< one a point, or none

  bool isMesh() const { return !triangles.empty(); }
};

/// Level `level` of a reconstruction, in world coordinates, without colours.
Shape levelShape(const core::Reconstruction& reconstruction, core::Index level);

/// The points at which the reconstruction put level 0, with their normals.
Shape representativesShape(const core::Reconstruction& reconstruction);

/// The points that the reconstruction kept, where they were after denoising, coloured by their clusters:
/// clusters whose vertices an edge of level 0 joins differ, as far as kCategories colours allow. Points in
/// none are grey.
Shape clustersShape(const core::Reconstruction& reconstruction);

}  // namespace mlsmesh::apps
