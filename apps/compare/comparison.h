// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "compare/compare_options.h"

namespace mlsmesh::apps {

/// Runs the comparison and writes its folder, which is as it was before if it throws AppError. Rows are
/// printed on stdout as they come, unless quiet.
void compare(const CompareOptions& options);

}  // namespace mlsmesh::apps
