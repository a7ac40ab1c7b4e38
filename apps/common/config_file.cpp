// SPDX-License-Identifier: BSD-3-Clause
#include "common/config_file.h"

#include "common/app_error.h"
#include "common/file_bytes.h"

#include <algorithm>
#include <iterator>
#include <sstream>

namespace mlsmesh::apps {

namespace {

std::string trimmed(const std::string& text) {
  const char* blanks = " \t\r";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

ConfigEntry parseLine(const std::string& line, const std::string& place) {
  const std::size_t equals = line.find('=');
  ConfigEntry entry{trimmed(line.substr(0, equals)), {}, place};
  if (equals != std::string::npos) entry.value = trimmed(line.substr(equals + 1));
  if (entry.key.empty() || entry.value.empty()) {
    throw AppError(kExitUsage, place + ": '" + line + "' is not of the form key = value; correct the line");
  }
  return entry;
}

std::string readText(const std::filesystem::path& file) {
  try {
    return readBytes(file);
  } catch (const AppError& error) {
    throw AppError(kExitUsage, error.what());
  }
}

}  // namespace

std::vector<ConfigEntry> readConfigFile(const std::filesystem::path& file,
                                        const std::set<std::string>& repeatable) {
  std::istringstream lines(readText(file));
  std::vector<ConfigEntry> entries;
  std::set<std::string> seen;
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const std::string content = trimmed(line.substr(0, line.find('#')));
    if (content.empty()) continue;
    entries.push_back(parseLine(content, file.string() + ":" + std::to_string(number)));
    if (!seen.insert(entries.back().key).second && repeatable.count(entries.back().key) == 0) {
      throw AppError(kExitUsage,
                     entries.back().place + ": '" + entries.back().key + "' comes twice; keep one");
    }
  }
  return entries;
}

std::vector<ConfigEntry> takeEntries(const std::set<std::string>& keys, std::vector<ConfigEntry>& entries) {
  const auto first = std::stable_partition(
      entries.begin(), entries.end(), [&](const ConfigEntry& entry) { return keys.count(entry.key) == 0; });
  std::vector<ConfigEntry> taken(std::make_move_iterator(first), std::make_move_iterator(entries.end()));
  entries.erase(first, entries.end());
  return taken;
}

}  // namespace mlsmesh::apps
