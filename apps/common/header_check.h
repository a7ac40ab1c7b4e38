// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>

namespace mlsmesh::apps {

// What PCL's readers take on trust: that a file is of the type its name says, that its header makes
// sense, and that the file is long enough for what the header announces (they allocate by the header, and
// read garbage, or crash). Each throws AppError that names the file, the fault and the remedy.

/// Returns the bytes that its points take in memory.
std::uintmax_t checkPcdHeader(const std::filesystem::path& file);
/// Also refuses names that come twice. Returns the number of vertices announced. In text, rows of
/// vertices must be numbers, as many as there are properties.
std::size_t checkPlyHeader(const std::filesystem::path& file);

}  // namespace mlsmesh::apps
