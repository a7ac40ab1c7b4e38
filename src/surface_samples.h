// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "mlsmesh/core/types.h"

namespace mlsmesh {

/// Points on the triangles of a soup, and the triangle that each lies on.
struct SurfaceSamples {
  std::vector<core::Vec3> position;
  std::vector<core::Index> triangle;
};

/// `count` points, uniform by area: the area is cut into as many equal parts, in the order of the triangles,
/// and each has one point. The same for the same input. None if the area is 0. Corners must be
/// vertices, and finite.
SurfaceSamples sampleSurface(const std::vector<core::Vec3>& vertices,
                             const std::vector<core::Triangle>& triangles, std::size_t count);

}  // namespace mlsmesh
