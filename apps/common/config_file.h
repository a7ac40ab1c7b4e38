// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace mlsmesh::apps {

/// One "key = value" of a config file.
struct ConfigEntry {
  std::string key;
  std::string value;
  std::string place;  ///< "FILE:LINE", for errors
};

/// Reads "key = value" lines; '#' starts a comment, empty lines are skipped. Throws AppError (kExitUsage)
/// that names file and line where a line has another form or a key that is not `repeatable` comes twice.
std::vector<ConfigEntry> readConfigFile(const std::filesystem::path& file,
                                        const std::set<std::string>& repeatable = {});

/// Takes the entries with those keys out of `entries`, in their order.
std::vector<ConfigEntry> takeEntries(const std::set<std::string>& keys, std::vector<ConfigEntry>& entries);

}  // namespace mlsmesh::apps
