// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
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
/// that names file and line where a line has another form or a key comes twice.
std::vector<ConfigEntry> readConfigFile(const std::filesystem::path& file);

}  // namespace mlsmesh::apps
