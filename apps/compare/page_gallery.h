// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "compare/results.h"

#include <string>

namespace mlsmesh::apps {

/// The pictures of a cloud and of all its meshes as parts of the page: surfaces, and distances both ways,
/// with their legends; one sentence if none were made. Throws AppError if a picture cannot be read.
std::string galleries(const CloudResult& cloud);

}  // namespace mlsmesh::apps
