// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace mlsmesh::apps {

/// Size of a file that can be read. Throws AppError that says why it cannot: absent, a folder, not permitted,
/// empty.
std::uintmax_t checkReadable(const std::filesystem::path& file);

/// Its first `most` bytes, or all. Throws AppError.
std::string readBytes(const std::filesystem::path& file, std::uintmax_t most = UINTMAX_MAX);

/// The extension in lower case, without the dot.
std::string extensionOf(const std::filesystem::path& file);

}  // namespace mlsmesh::apps
