// SPDX-License-Identifier: BSD-3-Clause
#include "common/reconstruction_options.h"

#include "common/app_error.h"
#include "common/name_match.h"
#include "common/parameter_table.h"

namespace mlsmesh::apps {

namespace {

namespace po = boost::program_options;

constexpr int kMostThreads = 1024;

/// One value for one name, from a config file (`place` = "FILE:LINE: ") or the command line (`place` empty).
struct Setting {
  std::string name;
  std::string value;
  std::string place;
};

AppError usage(const std::string& place, const std::string& what) {
  return {kExitUsage, place + what + (place.empty() ? "; see --help" : "")};
}

/// The program's own names first: of names that are equally near, the first is suggested.
std::vector<std::string> configNames(const std::set<std::string>& others) {
  std::vector<std::string> names(others.begin(), others.end());
  names.insert(names.end(), {"preset", "levels", "threads", "hole-size", "all-levels", "no-reduction"});
  for (const Parameter& parameter : parameterTable()) names.push_back(parameter.name);
  return names;
}

std::string suggestion(const std::string& name, const std::set<std::string>& others) {
  const std::string nearest = nearestName(name, configNames(others));
  if (!nearest.empty()) return "; did you mean '" + nearest + "'?";
  if (others.empty()) return "; --list-parameters prints all names";
  std::string list;
  for (const std::string& other : others) list += other + ", ";
  return "; there are " + list + "and those that mlsmesh_reconstruct --list-parameters prints";
}

bool readFlag(const Setting& setting) {
  bool value = false;
  if (!booleanFromText(setting.value, value)) {
    throw usage(setting.place,
                "'" + setting.name + "' cannot be '" + setting.value + "'; allowed: true or false");
  }
  return value;
}

int readThreads(const Setting& setting) {
  const std::string& text = setting.value;
  const bool digits =
      !text.empty() && text.size() < 6 && text.find_first_not_of("0123456789") == std::string::npos;
  const int value = digits ? std::stoi(text) : -1;
  if (value < 0 || value > kMostThreads) {
    throw usage(setting.place,
                "'threads' cannot be '" + text + "'; allowed: a whole number, 0 .. 1024 (0 = all)");
  }
  return value;
}

/// False if there is nothing of that name.
bool apply(const Setting& setting, ReconstructionOptions& options) {
  if (setting.name == "threads") {
    options.threads = readThreads(setting);
  } else if (setting.name == "all-levels") {
    options.all_levels = readFlag(setting);
  } else if (setting.name == "no-reduction") {
    options.parameters.reduce = !readFlag(setting);
  } else if (const Parameter* parameter = findParameter(setting.name)) {
    try {
      setFromText(*parameter, setting.value, options.parameters);
    } catch (const ParameterError& error) {
      throw usage(setting.place, error.what());
    }
  } else {
    return setting.name == "preset";
  }
  return true;
}

/// What one setting changes, so that two names of one thing cannot contradict each other.
std::string subjectOf(const std::string& name) {
  if (name == "no-reduction") return "reduce";
  const Parameter* parameter = findParameter(name);
  return parameter ? parameter->name : name;
}

void applyAll(const std::vector<Setting>& settings, const std::set<std::string>& others,
              ReconstructionOptions& options) {
  std::set<std::string> subjects;
  for (const Setting& setting : settings) {
    if (!apply(setting, options)) {
      throw usage(setting.place, "unknown name '" + setting.name + "'" + suggestion(setting.name, others));
    }
    if (!subjects.insert(subjectOf(setting.name)).second) {
      throw usage(setting.place, "'" + setting.name + "' sets what was set before; keep one");
    }
  }
}

void choosePreset(const std::vector<Setting>& settings, ReconstructionOptions& options) {
  for (const Setting& setting : settings) {
    if (setting.name != "preset") continue;
    const Preset* preset = findPreset(setting.value);
    if (preset == nullptr) {
      throw usage(setting.place,
                  "unknown preset '" + setting.value + "'; allowed: default, paper or printed");
    }
    options.preset = preset->name;
    options.parameters = preset->make();
  }
}

std::vector<Setting> configSettings(const std::vector<ConfigEntry>& entries) {
  std::vector<Setting> settings;
  for (const ConfigEntry& entry : entries) {
    settings.push_back({entry.key, entry.value, entry.place + ": "});
  }
  return settings;
}

/// What says how to reconstruct; other options say what to do.
bool isSetting(const std::string& name) {
  static const std::set<std::string> kGeneral = {"preset", "threads", "all-levels", "no-reduction"};
  return kGeneral.count(name) != 0 || findParameter(name) != nullptr;
}

bool isFlag(const std::string& name) {
  return name == "all-levels" || name == "no-reduction";
}

std::vector<Setting> commandLineSettings(const po::variables_map& values) {
  std::vector<Setting> settings;
  for (const auto& [name, value] : values) {
    if (isSetting(name)) settings.push_back({name, isFlag(name) ? "true" : value.as<std::string>(), ""});
  }
  return settings;
}

}  // namespace

void addReconstructionOptions(po::options_description& options) {
  const auto text = [](const char* name) { return po::value<std::string>()->value_name(name); };
  auto add = options.add_options();
  add("levels", text("N"),
      "refinement steps (refinement.levels), default 2; there is one mesh more than steps");
  add("hole-size", text("SIZE"),
      "close holes of at most so many spacings around (hole_size), default 0 = only the gaps of a few edges");
  add("watertight", text("BOOL")->implicit_value("true"),
      "close all holes, so that the mesh has no border (watertight)");
  add("no-reduction", "triangulate the input points themselves (reduce = false)");
  add("preset", text("NAME"), "default, paper or printed");
  add("config", text("FILE"), "read 'name = value' lines; what the command line says wins over the file");
  add("threads", text("N"), "threads, default 0 = all; the result is the same");
}

void addParameterOptions(po::options_description& options) {
  for (const Parameter& parameter : parameterTable()) {
    if (options.find_nothrow(parameter.name, false)) continue;
    options.add_options()(parameter.name.c_str(), po::value<std::string>(), parameter.help.c_str());
  }
}

ReconstructionOptions reconstructionOptions(const po::variables_map& values) {
  std::vector<ConfigEntry> entries;
  if (values.count("config")) entries = readConfigFile(values["config"].as<std::string>());
  return reconstructionOptions(values, entries, {});
}

ReconstructionOptions reconstructionOptions(const po::variables_map& values,
                                            const std::vector<ConfigEntry>& entries,
                                            const std::set<std::string>& others) {
  ReconstructionOptions options;
  const std::vector<Setting> from_file = configSettings(entries);
  const std::vector<Setting> from_user = commandLineSettings(values);
  choosePreset(from_file, options);
  choosePreset(from_user, options);
  applyAll(from_file, others, options);
  applyAll(from_user, others, options);
  return options;
}

}  // namespace mlsmesh::apps
