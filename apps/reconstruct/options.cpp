// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruct/options.h"

#include "common/app_error.h"
#include "common/cloud_io.h"
#include "common/command_line.h"
#include "common/mesh_io.h"
#include "common/parameter_help.h"
#include "common/reconstruction_options.h"
#include "mlsmesh/version.h"

#include <boost/program_options.hpp>

#include <sstream>

namespace mlsmesh::apps {

namespace {

namespace po = boost::program_options;

constexpr unsigned kHelpWidth = 100;

AppError usage(const std::string& what) {
  return {kExitUsage, what + "; see --help"};
}

po::options_description visibleOptions() {
  const auto text = [](const char* name) { return po::value<std::string>()->value_name(name); };
  po::options_description options("Options", kHelpWidth);
  addReconstructionOptions(options);
  auto add = options.add_options();
  add("all-levels", "also write the mesh of every level: OUTPUT's stem with .L0, .L1, ...");
  add("json", text("FILE"), "write counts, times and memory as JSON");
  add("memory-limit", text("MB"),
      "refuse a cloud that may need more memory, before any work on it, and say how much; an estimate from "
      "above");
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
  addParameterOptions(options);
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
       << "Exit codes: 0 done, 1 input, output or computation failed, 2 wrong usage, 130 or 143 "
          "interrupted.\n";
  return text.str();
}

std::string textOf(const po::variables_map& values, const std::string& name) {
  return values.count(name) ? values[name].as<std::string>() : std::string();
}

std::string parameterList(const std::string& format, const MultiresolutionParameters& parameters) {
  if (format == "text") return parameterHelp();
  if (format == "markdown") return parameterMarkdown();
  if (format == "config") return parameterConfig(parameters);
  throw usage("unknown format '" + format + "' of --list-parameters; allowed: text, markdown or config");
}

/// Help, version or list, if one was asked for; otherwise empty.
std::string textToPrint(const po::variables_map& values, const MultiresolutionParameters& parameters) {
  if (values.count("help")) return helpText();
  if (values.count("version")) return std::string(kProgram) + " " + MLSMESH_VERSION + "\n";
  if (values.count("list-parameters")) return parameterList(textOf(values, "list-parameters"), parameters);
  return {};
}

double memoryLimit(const po::variables_map& values) {
  if (values.count("memory-limit") == 0) return 0;
  const std::string text = textOf(values, "memory-limit");
  const double megabytes = numberFromText("--memory-limit", text);
  if (!(megabytes > 0))
    throw usageError("--memory-limit", "cannot be " + text + "; give megabytes, more than 0");
  return megabytes;
}

void setFiles(const po::variables_map& values, Options& options) {
  options.input = textOf(values, "input");
  options.output = textOf(values, "output");
  options.json = textOf(values, "json");
  if (options.input.empty())
    throw usage("no INPUT and no OUTPUT given; name a point cloud and a mesh to write");
  if (options.output.empty()) throw usage("no OUTPUT given; name the mesh to write, for example mesh.ply");
  if (values.count("json") && options.json.empty()) throw usage("--json needs the name of a file");
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
  options.memory_limit = memoryLimit(values);
  static_cast<ReconstructionOptions&>(options) = reconstructionOptions(values);
  options.text = textToPrint(values, options.parameters);
  if (options.text.empty()) {
    setFiles(values, options);
  } else {
    options.action = Action::Print;
  }
  return options;
}

}  // namespace mlsmesh::apps
