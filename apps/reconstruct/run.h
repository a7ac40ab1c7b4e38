// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "reconstruct/options.h"

namespace mlsmesh::apps {

/// Reads the cloud, reconstructs it, writes the meshes and the JSON, prints the summary. Outputs appear when
/// all are complete; otherwise AppError is thrown and none is left.
void reconstructFile(const Options& options);

}  // namespace mlsmesh::apps
