// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "compare/results.h"

#include <string>

namespace mlsmesh::apps {

/// The comparison as one HTML page that needs nothing beside it: styles, script and pictures (read from their
/// files) are inside. All but the sorting of its tables and the enlarging of pictures works without scripts.
/// Throws AppError if a picture cannot be read.
std::string reportPage(const Comparison& comparison);

}  // namespace mlsmesh::apps
