// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "compare/method_input.h"
#include "compare/stage_clock.h"

#include <pcl/PolygonMesh.h>

namespace mlsmesh::apps {

// Methods that fail, each in its own way: to see that a comparison outlives what a method may do. Not among
// "all"; asked for by name only.

/// Writes where nothing is.
pcl::PolygonMesh crash(const MethodInput& input, StageClock& clock);
/// Never comes back.
pcl::PolygonMesh hang(const MethodInput& input, StageClock& clock);
/// Takes memory until there is none.
pcl::PolygonMesh exhaustMemory(const MethodInput& input, StageClock& clock);
/// Throws.
pcl::PolygonMesh throwError(const MethodInput& input, StageClock& clock);
/// Makes no face.
pcl::PolygonMesh makeNothing(const MethodInput& input, StageClock& clock);

}  // namespace mlsmesh::apps
