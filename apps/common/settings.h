// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/config_file.h"

#include <boost/program_options.hpp>

#include <string>
#include <vector>

namespace mlsmesh::apps {

/// The options of a program by name: what the command line says, or else what its config file says.
class Settings {
 public:
  /// `values` has texts and lists of texts, `file` the entries whose keys are options of the program.
  Settings(boost::program_options::variables_map values, std::vector<ConfigEntry> file);

  bool has(const std::string& name) const { return !texts(name).empty(); }
  /// All values of an option that can be given several times; none if it is not given. Those of the command
  /// line replace all of the file.
  std::vector<std::string> texts(const std::string& name) const;
  /// Throws AppError (kExitUsage) if the value is empty.
  std::string text(const std::string& name, const std::string& otherwise) const;
  /// False if it is not given. Throws AppError (kExitUsage) unless it is a boolean, as parameters are.
  bool flag(const std::string& name) const;
  /// What errors of that option name: "--limit", or "FILE:LINE: limit".
  std::string culprit(const std::string& name) const;

 private:
  boost::program_options::variables_map values_;
  std::vector<ConfigEntry> file_;
};

/// For options that are on or off: "--name" and "--name=BOOL".
boost::program_options::typed_value<std::string>* flagValue();

}  // namespace mlsmesh::apps
