// SPDX-License-Identifier: BSD-3-Clause
#include "inspect/inspect_options.h"

#include "common/cloud_io.h"
#include "common/command_line.h"
#include "common/mesh_reader.h"
#include "inspect/figures.h"

#include <cmath>
#include <sstream>

namespace mlsmesh::apps {

namespace {

namespace po = boost::program_options;

constexpr double kMostSamples = 1e8;
constexpr double kMostThreads = 1024;
constexpr std::size_t kHelpWidth = 100;

po::options_description describeOptions() {
  const auto text = [](const char* name) { return po::value<std::string>()->value_name(name); };
  po::options_description options("Options (-name value or --name=value)", kHelpWidth);
  auto add = options.add_options();
  add("cloud", text("FILE"), "measure distances between the mesh and the cloud that it was made from");
  add("truth", text("FILE"), "measure distances between the mesh and the true surface, a mesh");
  add("json", text("FILE"), "write the report as JSON");
  add("require", text("LIST"),
      "NAME=VALUE, NAME!=VALUE, NAME<=VALUE, NAME>=VALUE, NAME<VALUE or NAME>VALUE, separated by commas: end "
      "with "
      "exit code 1 unless all hold");
  add("samples", text("N"), "points drawn from a surface to measure its distances (default 200000)");
  add("weld", po::bool_switch(), "first merge vertices at exactly the same position (STL: always)");
  add("threads", text("N"), "threads, default 0 = all; the figures are the same");
  add("quiet", po::bool_switch(), "print nothing but warnings, errors and requirements that do not hold");
  add("help,h", po::bool_switch(), "this text");
  add("version", po::bool_switch(), "the version");
  return options;
}

po::variables_map parse(int argc, const char* const* argv) {
  po::options_description all = describeOptions();
  all.add_options()("mesh", po::value<std::string>());
  po::positional_options_description positions;
  positions.add("mesh", 1);
  return parseCommandLine(argc, argv, all, positions);
}

std::string textOf(const po::variables_map& values, const std::string& name) {
  if (values.count(name) == 0) return {};
  const auto& text = values[name].as<std::string>();
  if (text.empty()) throw usageError("--" + name, "needs a value; see --help");
  return text;
}

std::size_t wholeNumber(const po::variables_map& values, const std::string& name, double low, double high,
                        std::size_t otherwise) {
  if (values.count(name) == 0) return otherwise;
  const auto& text = values[name].as<std::string>();
  const double value = numberFromText("--" + name, text);
  if (value == std::floor(value) && value >= low && value <= high) return static_cast<std::size_t>(value);
  std::ostringstream range;
  range << "cannot be " << text << "; allowed: a whole number, " << low << " .. " << high;
  throw usageError("--" + name, range.str());
}

/// An inspection with nothing in it, for the names of its figures.
FigureTable namesWith(bool cloud, bool truth) {
  Inspection blank;
  if (cloud) blank.cloud.emplace();
  if (truth) blank.truth.emplace();
  return figuresOf(blank);
}

void readFiles(const po::variables_map& values, InspectOptions& options) {
  options.mesh = textOf(values, "mesh");
  options.cloud = textOf(values, "cloud");
  options.truth = textOf(values, "truth");
  options.json = textOf(values, "json");
  if (options.mesh.empty()) throw usageError("arguments", "MESH is missing; see --help");
  checkReadableMeshFormat(options.mesh);
  if (!options.cloud.empty()) checkReadableFormat(options.cloud);
  if (!options.truth.empty()) checkReadableMeshFormat(options.truth);
}

std::string figureList() {
  const FigureTable table = namesWith(true, true);
  std::string text, line, group;
  for (const Figure& figure : table.figures()) {
    const bool is_new = figure.group != group;
    if (is_new || line.size() + figure.name.size() + 2 > kHelpWidth) {
      text += line + "\n";
      line = is_new ? "  " + figure.group + ":" : "   ";
      group = figure.group;
    }
    line += " " + figure.name;
  }
  return text + line + "\n";
}

}  // namespace

InspectOptions readInspectOptions(int argc, const char* const* argv) {
  const po::variables_map values = parse(argc, argv);
  InspectOptions options;
  options.help = values["help"].as<bool>();
  options.version = values["version"].as<bool>();
  if (options.help || options.version) return options;
  readFiles(values, options);
  options.weld = values["weld"].as<bool>();
  options.quiet = values["quiet"].as<bool>();
  options.samples = wholeNumber(values, "samples", 1, kMostSamples, options.samples);
  options.threads = static_cast<int>(wholeNumber(values, "threads", 0, kMostThreads, 0));
  if (values.count("require") > 0) {
    options.requirements = requirementsFromText(textOf(values, "require"));
    checkNames(options.requirements, namesWith(!options.cloud.empty(), !options.truth.empty()),
               namesWith(true, true));
  }
  return options;
}

std::string inspectHelp() {
  std::ostringstream text;
  text << "mlsmesh_inspect MESH [options]\n\n"
          "Measures a triangle mesh, whoever made it: topology, self-intersections, shape of the triangles,\n"
          "and distances from a cloud and from a true surface.\n"
          "MESH and truth: "
       << readableMeshFormats() << "; cloud: " << readableFormats() << ".\n\n"
       << describeOptions()
       << "\nFigures, for --require by name, or as group.name where several groups have the name:"
       << figureList()
       << "\nExit codes: 0 measured and all requirements hold, 1 a requirement does not hold, 2 wrong usage, "
          "or a file\nthat cannot be read or written.\n";
  return text.str();
}

}  // namespace mlsmesh::apps
