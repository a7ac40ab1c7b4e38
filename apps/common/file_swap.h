// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

namespace mlsmesh::apps {

/// A finished file and the name that it gets, in the same file system; with an empty `from`, `to` is removed.
struct FileSwap {
  std::filesystem::path from;
  std::filesystem::path to;
  std::filesystem::path shown;  ///< the name for errors
};

/// Puts all files in place, or leaves all names as they were: what a name stood for is kept under a hidden
/// name beside it until the last file is in place, and comes back if one fails. Content is on the disk before
/// it gets its name, so that a crash of the machine leaves the old file or the new one, whole; and files keep
/// the permissions of those that they replace. Throws AppError that names the file.
void swapAll(const std::vector<FileSwap>& swaps);

/// A name in `folder` that no other call gives out, also not in another process: ".mlsmesh-...SUFFIX".
std::filesystem::path hiddenName(const std::filesystem::path& folder, const char* suffix);

}  // namespace mlsmesh::apps
