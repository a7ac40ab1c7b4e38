// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/reconstruction_options.h"
#include "compare/task.h"

#include <string>

namespace mlsmesh::apps {

/// Preset and parameters that differ from it, for people: "default parameters", or "preset paper,
/// clustering.max_size = 20".
std::string parametersText(const ReconstructionOptions& options);

/// The same for a task; parametersOf() reads it back, to the bit.
Json parametersJson(const ReconstructionOptions& options);
MultiresolutionParameters parametersOf(const Json& json);

}  // namespace mlsmesh::apps
