// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/multiresolution.h"

#include <pcl/PCLPointCloud2.h>

namespace mlsmesh::apps {

/// Runs all steps over a cloud whose coordinates may be floats or doubles. The first of the result's stages
/// is "prepare". Throws core::Failure.
core::Reconstruction reconstructCloud(const pcl::PCLPointCloud2& cloud,
                                      const MultiresolutionParameters& parameters, core::Context& context);

}  // namespace mlsmesh::apps
