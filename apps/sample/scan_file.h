// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/types.h"

#include <filesystem>
#include <vector>

namespace mlsmesh::apps {

/// Throws AppError (kExitUsage) unless the extension is one that writeScan knows: pcd, ply or xyz.
void checkScanType(const std::filesystem::path& output);

/// Writes points, rounded to float32, with a colour each (0 .. 1) unless `colors` is empty: PCD and PLY in
/// binary, XYZ as text with 9 digits. The file appears whole or not at all. Throws AppError.
void writeScan(const std::vector<core::Vec3>& points, const std::vector<core::Vec3>& colors,
               const std::filesystem::path& output);

}  // namespace mlsmesh::apps
