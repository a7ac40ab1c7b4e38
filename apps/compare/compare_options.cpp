// SPDX-License-Identifier: BSD-3-Clause
#include "compare/compare_options.h"

#include "common/cloud_io.h"
#include "common/command_line.h"
#include "common/mesh_reader.h"
#include "common/viewpoint.h"

#include <unistd.h>

#include <cmath>
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
  add("methods", text("LIST"), "names, separated by commas; all (default), mlsmesh or pcl among them");
  add("limit", text("SECONDS"), "wall-clock time that a method may take for a cloud (default 300)");
  add("memory", text("MB"), "memory that a method may take (default three quarters of the machine's)");
  add("threads", text("N"), "threads of methods that can use several (default 1, 0 = all)");
  add("view", texts("NAME"),
      "front, back, left, right, top, bottom, iso (default), or sensor: from the origin, y down; once, or "
      "once for each cloud");
  add("up", text("AXIS"), "x, y or z points up (default y)");
  add("no-pictures", po::bool_switch(), "draw nothing");
  add("quiet", po::bool_switch(), "print nothing but warnings and errors");
  add("help,h", po::bool_switch(), "this text");
  add("version", po::bool_switch(), "the version");
  return options;
}

po::variables_map parse(int argc, const char* const* argv) {
  po::options_description all = describeOptions();
  all.add_options()("clouds", po::value<std::vector<std::string>>());
  po::positional_options_description positions;
  positions.add("clouds", -1);
  return parseCommandLine(argc, argv, all, positions);
}

std::string textOf(const po::variables_map& values, const std::string& name, const std::string& otherwise) {
  if (values.count(name) == 0) return otherwise;
  const auto& text = values[name].as<std::string>();
  if (text.empty()) throw usageError("--" + name, "needs a value; see --help");
  return text;
}

double numberOf(const po::variables_map& values, const std::string& name, double low, double high,
                double otherwise) {
  if (values.count(name) == 0) return otherwise;
  const auto& text = values[name].as<std::string>();
  const double value = numberFromText("--" + name, text);
  if (value >= low && value <= high) return value;
  std::ostringstream range;
  range << "cannot be " << text << "; allowed: " << low << " .. " << high;
  throw usageError("--" + name, range.str());
}

/// The values of an option that is given once for all clouds or once for each; none if it is not given.
std::vector<std::string> oneForEach(const po::variables_map& values, const std::string& name,
                                    std::size_t clouds) {
  if (values.count(name) == 0) return {};
  auto texts = values[name].as<std::vector<std::string>>();
  if (texts.size() == 1) texts.resize(clouds, texts.front());
  if (texts.size() == clouds) return texts;
  throw usageError("--" + name, "is given " + std::to_string(texts.size()) + " times for " +
                                    std::to_string(clouds) + " clouds; give it once, or once for each");
}

std::vector<CompareInput> inputsOf(const po::variables_map& values, const std::string& up) {
  if (values.count("clouds") == 0) throw usageError("arguments", "no cloud to compare on; see --help");
  const auto& clouds = values["clouds"].as<std::vector<std::string>>();
  const std::vector<std::string> truths = oneForEach(values, "truth", clouds.size());
  const std::vector<std::string> views = oneForEach(values, "view", clouds.size());
  std::vector<CompareInput> inputs;
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    CompareInput input;
    input.cloud = clouds[i];
    checkReadableFormat(input.cloud);
    if (!truths.empty() && truths[i] != "none") input.truth = truths[i];
    if (!input.truth.empty()) checkReadableMeshFormat(input.truth);
    if (!views.empty()) input.view = views[i];
    namedViewpoint(input.view == "sensor" ? "iso" : input.view, up);
    inputs.push_back(input);
  }
  return inputs;
}

double machineMegabytes() {
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE)) /
         (1 << 20);
}

std::string methodList() {
  std::ostringstream text;
  for (const Method& method : methodTable()) {
    if (method.maker == "fault") continue;
    text << "  " << method.name << std::string(17 - std::min<std::size_t>(16, method.name.size()), ' ')
         << (method.maker == "pcl" ? "PCL: " : "") << method.label << "\n";
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
  options.up = textOf(values, "up", "y");
  options.inputs = inputsOf(values, options.up);
  options.output = textOf(values, "output", "");
  if (options.output.empty()) throw usageError("--output", "is missing; name a folder for the results");
  options.methods = methodsFromText(textOf(values, "methods", "all"));
  options.limit_seconds = numberOf(values, "limit", 0.01, kLongestLimit, options.limit_seconds);
  const double megabytes =
      numberOf(values, "memory", kFewestMegabytes, kMostMegabytes, kMemoryShare * machineMegabytes());
  options.memory_bytes = static_cast<std::uint64_t>(megabytes * (1 << 20));
  const double threads = numberOf(values, "threads", 0, kMostThreads, options.threads);
  if (threads != std::floor(threads)) throw usageError("--threads", "must be a whole number");
  options.threads = static_cast<int>(threads);
  options.pictures = !values["no-pictures"].as<bool>();
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
       << "\nExit codes: 0 compared, whatever became of single methods; 1 an input or the output failed; 2 "
          "wrong\nusage; 130 interrupted, and nothing written.\n";
  return text.str();
}

}  // namespace mlsmesh::apps
