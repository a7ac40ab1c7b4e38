// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <string>
#include <vector>

#include "mlsmesh/core/types.h"

namespace mlsmesh::bench {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

/// The synthetic cloud: `count` points of a bumpy sphere, radius 1 + 0.05 sin 9x sin 9y sin 9z at (x, y, z)
/// of the unit sphere, in random directions and order, without noise. The same count gives the same points
/// with every compiler and library. Closed, of genus 0.
Cloud::Ptr bumpySphere(std::size_t count);

/// Throws std::runtime_error if the file cannot be read as PCD.
Cloud::Ptr readCloud(const std::string& file);

/// The coordinates in doubles, in the order of the cloud.
std::vector<core::Vec3> positionsOf(const Cloud& cloud);

}  // namespace mlsmesh::bench
