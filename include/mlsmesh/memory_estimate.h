// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "mlsmesh/parameters.h"

namespace mlsmesh {

/// Bytes that a reconstruction takes at its peak, the mesh for PCL and what is written of it included, beside
/// the input cloud itself. `point_bytes`: of one point of that cloud, all fields (16 for pcl::PointXYZ).
/// Meant as an upper bound for surfaces: of our clouds, with the default thresholds, none takes more, and
/// those of 100,000 points and more take at least half. Clouds that are noise alone may take more. Rises with
/// the points and the levels.
std::uint64_t peakMemoryEstimate(std::size_t points, std::size_t point_bytes,
                                 const MultiresolutionParameters& parameters);

}  // namespace mlsmesh
