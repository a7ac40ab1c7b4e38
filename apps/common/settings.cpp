// SPDX-License-Identifier: BSD-3-Clause
#include "common/settings.h"

#include "common/command_line.h"
#include "common/parameter_table.h"

#include <utility>

namespace mlsmesh::apps {

namespace po = boost::program_options;

Settings::Settings(po::variables_map values, std::vector<ConfigEntry> file)
    : values_(std::move(values)), file_(std::move(file)) {}

std::vector<std::string> Settings::texts(const std::string& name) const {
  if (values_.count(name) > 0) {
    const po::variable_value& value = values_[name];
    if (const auto* text = boost::any_cast<std::string>(&value.value())) return {*text};
    return value.as<std::vector<std::string>>();
  }
  std::vector<std::string> texts;
  for (const ConfigEntry& entry : file_)
    if (entry.key == name) texts.push_back(entry.value);
  return texts;
}

std::string Settings::text(const std::string& name, const std::string& otherwise) const {
  const std::vector<std::string> given = texts(name);
  if (given.empty()) return otherwise;
  if (given.front().empty()) throw usageError(culprit(name), "needs a value; see --help");
  return given.front();
}

bool Settings::flag(const std::string& name) const {
  const std::string given = text(name, "false");
  bool value = false;
  if (!booleanFromText(given, value))
    throw usageError(culprit(name), "cannot be '" + given + "'; allowed: true or false");
  return value;
}

std::string Settings::culprit(const std::string& name) const {
  if (values_.count(name) == 0) {
    for (const ConfigEntry& entry : file_)
      if (entry.key == name) return entry.place + ": " + name;
  }
  return "--" + name;
}

po::typed_value<std::string>* flagValue() {
  return po::value<std::string>()->value_name("BOOL")->implicit_value("true");
}

}  // namespace mlsmesh::apps
