// SPDX-License-Identifier: BSD-3-Clause
#include "compare/compare_options.h"

#include "common/cloud_io.h"
#include "common/command_line.h"
#include "common/mesh_reader.h"
#include "common/settings.h"
#include "common/viewpoint.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <sstream>

namespace mlsmesh::apps {
namespace {

namespace po = boost::program_options;

constexpr unsigned kHelpWidth = 100;
constexpr double kMostThreads = 1024;
constexpr double kLongestLimit = 1e6;  // seconds
constexpr double kFewestMegabytes = 64;
constexpr double kMostMegabytes = 1 << 24;
constexpr double kMemoryShare = 0.75;  // of the machine's
constexpr const char* kNoTruth = "none";
// Names of parameters that no user sets, because the methods do.
constexpr std::array<const char*, 5> kSaidByMethods = {"levels", "refinement.levels", "reduce",
                                                       "no-reduction", "all-levels"};

/// A path of a config file, which is relative to the folder of the file.
std::string besideFile(const std::string& path, const std::filesystem::path& file) {
  return (file.parent_path() / path).string();
}

/// Takes clouds out, and what was said for each of them.
void dropClouds(std::vector<ConfigEntry>& entries) {
  if (takeEntries({"cloud"}, entries).empty()) return;
  takeEntries({"truth"}, entries);
  const auto is_view = [](const ConfigEntry& entry) { return entry.key == "view"; };
  if (std::count_if(entries.begin(), entries.end(), is_view) > 1) takeEntries({"view"}, entries);
}

/// What a config file may say beside parameters.
const std::set<std::string>& namesForFiles() {
  static const std::set<std::string> kNames{"cloud",   "truth", "methods", "limit",      "memory",
                                            "threads", "view",  "up",      "no-pictures"};
  return kNames;
}

po::options_description describeOptions() {
  const auto text = [](const char* name) { return po::value<std::string>()->value_name(name); };
  const auto texts = [](const char* name) {
    return po::value<std::vector<std::string>>()->composing()->value_name(name);
  };
  po::options_description options("Options (-name value or --name=value)", kHelpWidth);
  auto add = options.add_options();
  add("output", text("FOLDER"), "where meshes and reports go; made if it is not there");
  add("truth", texts("FILE"),
      "true surface, a mesh; once for all clouds, or once for each, 'none' for one without");
  add("methods", text("LIST"), "names, separated by commas; all (default), mlsmesh, paper or pcl among them");
  add("limit", text("SECONDS"), "wall-clock time that a method may take for a cloud (default 300)");
  add("memory", text("MB"), "memory that a method may take (default three quarters of the machine's)");
  add("threads", text("N"), "threads of methods that can use several (default 1, 0 = all)");
  add("view", texts("NAME"),
      "front, back, left, right, top, bottom, iso (default), or sensor: from the origin, y down; once, or "
      "once for each cloud");
  add("up", text("AXIS"), "x, y or z points up (default y)");
  add("no-pictures", flagValue(), "draw nothing");
  add("config", text("FILE"),
      "read 'name = value' lines: options of this list, clouds, parameters; what the command line says wins");
  add("preset", text("NAME"), "of mlsmesh's methods: default, paper or printed");
  add("hole-size", text("SIZE"), "of mlsmesh's methods: close holes of at most so many spacings around");
  add("watertight", flagValue(), "of mlsmesh's methods: close all holes");
  add("quiet", po::bool_switch(), "print nothing but warnings and errors");
  add("help,h", po::bool_switch(), "this text");
  add("version", po::bool_switch(), "the version");
  return options;
}

po::variables_map parse(int argc, const char* const* argv) {
  po::options_description all = describeOptions();
  all.add_options()("cloud", po::value<std::vector<std::string>>());
  addParameterOptions(all);
  for (const char* name : kSaidByMethods)
    if (all.find_nothrow(name, false) == nullptr) all.add_options()(name, flagValue());
  po::positional_options_description positions;
  positions.add("cloud", -1);
  return parseCommandLine(argc, argv, all, positions);
}

/// Takes what is no parameter out of the entries of a file.
Settings settingsOf(const po::variables_map& values, std::vector<ConfigEntry>& entries) {
  std::vector<ConfigEntry> own = takeEntries(namesForFiles(), entries);
  for (ConfigEntry& entry : own) {
    const bool is_path = entry.key == "cloud" || (entry.key == "truth" && entry.value != kNoTruth);
    if (is_path) entry.value = besideFile(entry.value, values["config"].as<std::string>());
  }
  if (values.count("cloud") > 0) dropClouds(own);
  return {values, std::move(own)};
}

void refuseWhatMethodsSay(const po::variables_map& values, const std::vector<ConfigEntry>& entries) {
  const std::string remedy = "is what the methods differ in; leave it out, and choose among --methods";
  for (const char* name : kSaidByMethods) {
    if (values.count(name) > 0) throw usageError("--" + std::string(name), remedy);
    for (const ConfigEntry& entry : entries)
      if (entry.key == name) throw usageError(entry.place + ": " + name, remedy);
  }
}

double numberOf(const Settings& settings, const std::string& name, double low, double high,
                double otherwise) {
  if (!settings.has(name)) return otherwise;
  const std::string text = settings.text(name, "");
  const double value = numberFromText(settings.culprit(name), text);
  if (value >= low && value <= high) return value;
  std::ostringstream range;
  range << "cannot be " << text << "; allowed: " << low << " .. " << high;
  throw usageError(settings.culprit(name), range.str());
}

/// The values of an option that is given once for all clouds or once for each; none if it is not given.
std::vector<std::string> oneForEach(const Settings& settings, const std::string& name, std::size_t clouds) {
  std::vector<std::string> texts = settings.texts(name);
  if (texts.size() == 1) texts.resize(clouds, texts.front());
  if (texts.empty() || texts.size() == clouds) return texts;
  throw usageError(settings.culprit(name), "is given " + std::to_string(texts.size()) + " times for " +
                                               std::to_string(clouds) +
                                               " clouds; give it once, or once for each");
}

std::vector<CompareInput> inputsOf(const Settings& settings, const std::string& up) {
  const std::vector<std::string> clouds = settings.texts("cloud");
  if (clouds.empty()) throw usageError("arguments", "no cloud to compare on; see --help");
  const std::vector<std::string> truths = oneForEach(settings, "truth", clouds.size());
  const std::vector<std::string> views = oneForEach(settings, "view", clouds.size());
  std::vector<CompareInput> inputs;
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    CompareInput input;
    input.cloud = clouds[i];
    checkReadableFormat(input.cloud);
    if (!truths.empty() && truths[i] != kNoTruth) input.truth = truths[i];
    if (!input.truth.empty()) checkReadableMeshFormat(input.truth);
    if (!views.empty()) input.view = views[i];
    namedViewpoint(input.view == "sensor" ? "iso" : input.view, up, settings.culprit("view"),
                   settings.culprit("up"));
    inputs.push_back(input);
  }
  return inputs;
}

double machineMegabytes() {
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE)) /
         (1 << 20);
}

void setLimits(const Settings& settings, CompareOptions& options) {
  options.limit_seconds = numberOf(settings, "limit", 0.01, kLongestLimit, options.limit_seconds);
  const double megabytes =
      numberOf(settings, "memory", kFewestMegabytes, kMostMegabytes, kMemoryShare * machineMegabytes());
  options.memory_bytes = static_cast<std::uint64_t>(megabytes * (1 << 20));
  const double threads = numberOf(settings, "threads", 0, kMostThreads, options.threads);
  if (threads != std::floor(threads)) throw usageError(settings.culprit("threads"), "must be a whole number");
  options.threads = static_cast<int>(threads);
}

std::string methodList() {
  std::ostringstream text;
  for (const Method& method : methodTable()) {
    if (method.group == "fault") continue;
    text << "  " << method.name << std::string(17 - std::min<std::size_t>(16, method.name.size()), ' ')
         << (method.group == "pcl" ? "PCL: " : "") << method.label << "\n";
  }
  return text.str();
}

}  // namespace

CompareOptions readCompareOptions(int argc, const char* const* argv) {
  const po::variables_map values = parse(argc, argv);
  CompareOptions options;
  options.help = values["help"].as<bool>();
  options.version = values["version"].as<bool>();
  if (options.help || options.version) return options;
  std::vector<ConfigEntry> entries;
  if (values.count("config") > 0)
    entries = readConfigFile(values["config"].as<std::string>(), {"cloud", "truth", "view"});
  const Settings settings = settingsOf(values, entries);
  refuseWhatMethodsSay(values, entries);
  options.up = settings.text("up", "y");
  options.inputs = inputsOf(settings, options.up);
  options.output = settings.text("output", "");
  if (options.output.empty()) throw usageError("--output", "is missing; name a folder for the results");
  setLimits(settings, options);
  options.methods = methodsFromText(settings.text("methods", "all"), settings.culprit("methods"));
  options.ours = reconstructionOptions(values, entries, namesForFiles());
  options.pictures = !settings.flag("no-pictures");
  options.quiet = values["quiet"].as<bool>();
  return options;
}

std::string compareHelp() {
  std::ostringstream text;
  text << "mlsmesh_compare CLOUD... --output FOLDER [options]\n\n"
          "Makes meshes of the same clouds by mlsmesh and by PCL's methods, each in a process of its own "
          "with\n"
          "limits of time and memory, measures all of them alike, and writes the meshes, results.json,\n"
          "results.csv, report.md, and report.html, a page with tables, pictures and plots.\n"
          "CLOUD: "
       << readableFormats() << "; truth: " << readableMeshFormats() << ".\n\n"
       << describeOptions() << "\nMethods:\n"
       << methodList()
       << "\nParameters of mlsmesh_reconstruct are options, too: of mlsmesh's methods but paper-0, -1 and "
          "-2. See "
          "its\n--list-parameters.\n\nExit codes: 0 compared, whatever became of single methods; 1 an input "
          "or the output failed; 2 "
          "wrong\nusage; 130 interrupted, and nothing written.\n";
  return text.str();
}

}  // namespace mlsmesh::apps
