// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/parameters.h"

#include <string>

namespace mlsmesh::apps {

/// All parameters with defaults, ranges and explanations, for --help.
std::string parameterHelp();

/// The page docs/parameters.md: the same, and where the presets differ.
std::string parameterMarkdown();

/// A config file that sets every parameter to its value in `parameters`.
std::string parameterConfig(const MultiresolutionParameters& parameters);

}  // namespace mlsmesh::apps
