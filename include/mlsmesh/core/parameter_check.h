// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/parameters.h"

namespace mlsmesh::core {

/// Throw Failure(InvalidParameter) that names the first member out of its range, its value and the range.
void check(const ClusteringParameters& parameters);
void check(const FeatureParameters& parameters);
void check(const ProjectionParameters& parameters);
void check(const NoiseParameters& parameters);
void check(const OutlierParameters& parameters);
void check(const TriangulationParameters& parameters);
void check(const RefinementParameters& parameters);
void check(const MultiresolutionParameters& parameters);

}  // namespace mlsmesh::core
