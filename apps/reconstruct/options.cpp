// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruct/options.h"

#include "common/app_error.h"
#include "common/cloud_io.h"
#include "common/command_line.h"
#include "common/config_file.h"
#include "common/mesh_io.h"
#include "common/name_match.h"
#include "common/parameter_help.h"
#include "common/parameter_table.h"
#include "mlsmesh/version.h"

#include <boost/program_options.hpp>

#include <set>
#include <sstream>

namespace mlsmesh::apps {

namespace {

namespace po = boost::program_options;

constexpr int kMostThreads = 1024;
constexpr unsigned kHelpWidth = 100;

/// One value for one name, from a config file (`place` = "FILE:LINE: ") or the command line (`place` empty).
struct Setting {
  std::string name;
  std::string value;
  std::string place;
};

AppError usage(const std::string& place, const std::string& what) {
  return {kExitUsage, place + what + (place.empty() ? "; see --help" : "")};
}

po::options_description visibleOptions() {
  const auto text = [](const char* name) { return po::value<std::string>()->value_name(name); };
  po::options_description options("Options", kHelpWidth);
  auto add = options.add_options();
  add("levels", text("N"),
      "refinement steps (refinement.levels), default 2; there is one mesh more than steps");
  add("all-levels", "also write the mesh of every level: OUTPUT's stem with .L0, .L1, ...");
  add("hole-size", text("SIZE"),
      "close holes of at most so many spacings around (hole_size), default 0 = only the gaps of a few edges");
  add("watertight", text("BOOL")->implicit_value("true"),
      "close all holes, so that the mesh has no border (watertight)");
  add("no-reduction", "triangulate the input points themselves (reduce = false)");
  add("preset", text("NAME"), "default, paper or printed");
  add("config", text("FILE"), "read 'name = value' lines; what the command line says wins over the file");
  add("threads", text("N"), "threads, default 0 = all; the result is the same");
  add("json", text("FILE"), "write counts, times and memory as JSON");
  add("quiet", "print nothing but warnings and errors");
  add("list-parameters", text("FORMAT")->implicit_value("text"),
      "print all parameters as text, markdown or config (a config file), and end");
  add("help,h", "print this help and end");
  add("version", "print the version and end");
  return options;
}

po::options_description allOptions() {
  po::options_description options = visibleOptions();
  auto add = options.add_options();
  add("input", po::value<std::string>(), "");
  add("output", po::value<std::string>(), "");
  for (const Parameter& parameter : parameterTable()) {
    if (options.find_nothrow(parameter.name, false)) continue;
    add(parameter.name.c_str(), po::value<std::string>(), parameter.help.c_str());
  }
  return options;
}

std::string helpText() {
  std::ostringstream text;
  text << "Usage: " << kProgram << " INPUT OUTPUT [options]\n\n"
       << "Reconstructs the surface that the points of INPUT lie on as an oriented manifold mesh in levels "
          "of rising\n"
       << "resolution, and writes the finest level to OUTPUT.\n"
       << "INPUT: " << readableFormats() << "; OUTPUT: " << writableMeshFormats() << " (by extension).\n\n"
       << visibleOptions()
       << "\nParameters (lengths in multiples of spacing; also in config files as 'name = value'):\n"
       << parameterHelp()
       << "\nOptions can be written --name value, --name=value or, as in PCL's tools, -name value.\n"
       << "Exit codes: 0 done, 1 input, output or computation failed, 2 wrong usage, 130 interrupted.\n";
  return text.str();
}

std::string suggestion(const std::string& name, const std::vector<std::string>& names) {
  const std::string nearest = nearestName(name, names);
  return nearest.empty() ? "; --list-parameters prints all names" : "; did you mean '" + nearest + "'?";
}

std::vector<std::string> configNames() {
  std::vector<std::string> names = {"preset", "levels", "threads", "hole-size", "all-levels", "no-reduction"};
  for (const Parameter& parameter : parameterTable()) names.push_back(parameter.name);
  return names;
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
bool apply(const Setting& setting, Options& options) {
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

void applyAll(const std::vector<Setting>& settings, Options& options) {
  std::set<std::string> subjects;
  for (const Setting& setting : settings) {
    if (!apply(setting, options)) {
      throw usage(setting.place,
                  "unknown name '" + setting.name + "'" + suggestion(setting.name, configNames()));
    }
    if (!subjects.insert(subjectOf(setting.name)).second) {
      throw usage(setting.place, "'" + setting.name + "' sets what was set before; keep one");
    }
  }
}

void choosePreset(const std::vector<Setting>& settings, Options& options) {
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

std::vector<Setting> configSettings(const std::filesystem::path& file) {
  std::vector<Setting> settings;
  for (const ConfigEntry& entry : readConfigFile(file)) {
    settings.push_back({entry.key, entry.value, entry.place + ": "});
  }
  return settings;
}

/// Options that say what to do; the others are settings.
bool isRequest(const std::string& name) {
  static const std::set<std::string> kRequests = {"input", "output", "config",          "json",
                                                  "quiet", "help",   "list-parameters", "version"};
  return kRequests.count(name) != 0;
}

bool isFlag(const std::string& name) {
  return name == "all-levels" || name == "no-reduction";
}

std::vector<Setting> commandLineSettings(const po::variables_map& values) {
  std::vector<Setting> settings;
  for (const auto& [name, value] : values) {
    if (!isRequest(name)) settings.push_back({name, isFlag(name) ? "true" : value.as<std::string>(), ""});
  }
  return settings;
}

std::string textOf(const po::variables_map& values, const std::string& name) {
  return values.count(name) ? values[name].as<std::string>() : std::string();
}

std::string parameterList(const std::string& format, const MultiresolutionParameters& parameters) {
  if (format == "text") return parameterHelp();
  if (format == "markdown") return parameterMarkdown();
  if (format == "config") return parameterConfig(parameters);
  throw usage("", "unknown format '" + format + "' of --list-parameters; allowed: text, markdown or config");
}

/// Help, version or list, if one was asked for; otherwise empty.
std::string textToPrint(const po::variables_map& values, const MultiresolutionParameters& parameters) {
  if (values.count("help")) return helpText();
  if (values.count("version")) return std::string(kProgram) + " " + MLSMESH_VERSION + "\n";
  if (values.count("list-parameters")) return parameterList(textOf(values, "list-parameters"), parameters);
  return {};
}

void setFiles(const po::variables_map& values, Options& options) {
  options.input = textOf(values, "input");
  options.output = textOf(values, "output");
  options.json = textOf(values, "json");
  if (options.input.empty())
    throw usage("", "no INPUT and no OUTPUT given; name a point cloud and a mesh to write");
  if (options.output.empty())
    throw usage("", "no OUTPUT given; name the mesh to write, for example mesh.ply");
  if (values.count("json") && options.json.empty()) throw usage("", "--json needs the name of a file");
  checkReadableFormat(options.input);
  checkWritableMeshFormat(options.output);
}

}  // namespace

Options parseOptions(int argc, const char* const* argv) {
  po::positional_options_description positions;
  positions.add("input", 1).add("output", 1);
  const po::variables_map values = parseCommandLine(argc, argv, allOptions(), positions);
  Options options;
  options.quiet = values.count("quiet") != 0;
  options.config = textOf(values, "config");
  const std::vector<Setting> from_file =
      values.count("config") ? configSettings(options.config) : std::vector<Setting>();
  const std::vector<Setting> from_user = commandLineSettings(values);
  choosePreset(from_file, options);
  choosePreset(from_user, options);
  applyAll(from_file, options);
  applyAll(from_user, options);
  options.text = textToPrint(values, options.parameters);
  if (options.text.empty()) {
    setFiles(values, options);
  } else {
    options.action = Action::Print;
  }
  return options;
}

}  // namespace mlsmesh::apps
