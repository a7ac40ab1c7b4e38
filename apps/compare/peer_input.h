// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "compare/method_input.h"
#include "compare/stage_clock.h"

namespace mlsmesh::apps {

// What PCL's methods are given beside the points.

/// Stage "spacing": mean distance of a point from its nearest other one, those at the same place left out.
/// Throws Refusal if there is none.
double meanSpacing(const MethodInput& input, StageClock& clock);

/// Stage "normals": pcl::NormalEstimation from 20 neighbours, turned towards the origin as PCL does; points
/// whose normal is not finite are left out.
OrientedCloud::Ptr withNormals(const MethodInput& input, StageClock& clock);

/// Stage "orientation": the same with normals that agree with each other (orientNormals).
OrientedCloud::Ptr withOrientedNormals(const MethodInput& input, StageClock& clock);

}  // namespace mlsmesh::apps
