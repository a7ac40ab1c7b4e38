// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace mlsmesh::apps {

/// Whether a file of VTK's XML format (.vtp) can hold what it announces: VTK's reader makes arrays as long as
/// the attributes NumberOf... and the heads of compressed blocks say. Throws AppError that names the file,
/// what it announces, and the remedy; also if it is of another type.
void checkVtp(const std::filesystem::path& file);

}  // namespace mlsmesh::apps
