// SPDX-License-Identifier: BSD-3-Clause
#include "sample/sample_options.h"

#include "common/command_line.h"
#include "common/parameter_table.h"
#include "sample/scan_file.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>

namespace mlsmesh::apps {
namespace {

namespace po = boost::program_options;

constexpr double kMaxCount = 2e9;
constexpr double kMaxViews = 10000;

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

/// Values are taken as text, so that every error names the option in one manner.
po::options_description describeOptions() {
  const auto text = [](const char* name) { return po::value<std::string>()->value_name(name); };
  po::options_description options("Options (-name value or --name=value)");
  auto add = options.add_options();
  add("count", text("N"), "points on the surface (default 50000)");
  add("noise", text("SIGMA"),
      "Gaussian noise, standard deviation of each coordinate as a share of the shape's diagonal "
      "(default 0)");
  add("outliers", text("SHARE"),
      "points anywhere in the box grown by a tenth, as a share of N and on top of it "
      "(default 0)");
  add("density", text("AXIS,RATIO"), "density that falls by RATIO from the low to the high end of x, y or z");
  add("views", text("K"), "only what K scanner positions around the shape see (default 0: everything)");
  add("seed", text("S"), "another number, another scan (default 1)");
  add("colors", text("BOOL"),
      "colour every point, by position; figure: as painted (default true for figure, "
      "else false)");
  add("quiet", po::bool_switch(), "print nothing but errors");
  add("help,h", po::bool_switch(), "this text");
  add("version", po::bool_switch(), "the version");
  return options;
}

po::variables_map parse(int argc, const char* const* argv) {
  po::options_description all = describeOptions();
  all.add_options()("shape", po::value<std::string>())("output", po::value<std::string>());
  po::positional_options_description positions;
  positions.add("shape", 1).add("output", 1);
  return parseCommandLine(argc, argv, all, positions);
}

/// The number given for an option, or `otherwise`; throws unless it is within low .. high.
double number(const po::variables_map& values, const std::string& name, double low, double high,
              double otherwise) {
  if (values.count(name) == 0) return otherwise;
  const auto& text = values[name].as<std::string>();
  const double value = numberFromText("--" + name, text);
  if (value >= low && value <= high) return value;
  std::ostringstream range;
  range << text << " is out of range; give " << low << " .. " << high;
  throw usageError("--" + name, range.str());
}

double wholeNumber(const po::variables_map& values, const std::string& name, double low, double high,
                   double otherwise) {
  const double value = number(values, name, low, high, otherwise);
  if (value != std::floor(value)) throw usageError("--" + name, "not a whole number; give 1, 2, 3, ...");
  return value;
}

std::uint64_t seedFromText(const std::string& text) {
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  std::uint64_t seed = 0;
  const bool digits_only = text.find_first_not_of("0123456789") == std::string::npos;
  if (!digits_only || !(stream >> seed))
    throw usageError("--seed", "'" + text + "' is not a whole number >= 0");
  return seed;
}

void readDensity(const std::string& text, shapes::ScanOptions& scan) {
  const std::string form =
      "'" + text + "' is not AXIS,RATIO; give for example y,10 (x, y or z; ratio 1 .. 1e6)";
  if (text.size() < 3 || text[1] != ',' || text[0] < 'x' || text[0] > 'z')
    throw usageError("--density", form);
  scan.density_axis = text[0] - 'x';
  scan.density_ratio = numberFromText("--density", text.substr(2));
  if (scan.density_ratio < 1.0 || scan.density_ratio > 1e6) throw usageError("--density", form);
}

bool readColors(const po::variables_map& values, const shapes::Shape& shape) {
  bool colors = shape.name() == "figure";
  if (values.count("colors") == 0) return colors;
  const auto& text = values["colors"].as<std::string>();
  if (!booleanFromText(text, colors))
    throw usageError("--colors", "'" + text + "' is neither true nor false");
  return colors;
}

shapes::ScanOptions readScanOptions(const po::variables_map& values) {
  shapes::ScanOptions scan;
  scan.count =
      static_cast<std::size_t>(wholeNumber(values, "count", 1, kMaxCount, static_cast<double>(scan.count)));
  scan.noise = number(values, "noise", 0.0, 1.0, scan.noise);
  scan.outliers = number(values, "outliers", 0.0, 100.0, scan.outliers);
  scan.views = static_cast<int>(wholeNumber(values, "views", 0, kMaxViews, scan.views));
  if (values.count("seed") > 0) scan.seed = seedFromText(values["seed"].as<std::string>());
  if (values.count("density") > 0) readDensity(values["density"].as<std::string>(), scan);
  return scan;
}

}  // namespace

SampleOptions readSampleOptions(int argc, const char* const* argv) {
  const po::variables_map values = parse(argc, argv);
  SampleOptions options;
  options.help = values["help"].as<bool>();
  options.version = values["version"].as<bool>();
  if (options.help || options.version) return options;
  options.quiet = values["quiet"].as<bool>();
  if (values.count("output") == 0) throw usageError("arguments", "SHAPE or OUTPUT is missing; see --help");
  const auto& name = values["shape"].as<std::string>();
  options.shape = shapes::makeShape(name);
  if (!options.shape) throw usageError(name, "no such shape; give one of " + joined(shapes::shapeNames()));
  options.output = values["output"].as<std::string>();
  checkScanType(options.output);
  options.scan = readScanOptions(values);
  options.colors = readColors(values, *options.shape);
  return options;
}

std::string sampleHelp() {
  std::ostringstream text;
  text << "mlsmesh_sample SHAPE OUTPUT [options]\n\n"
          "Makes a point cloud as a scanner would from a surface that is known exactly.\n"
          "SHAPE is one of "
       << joined(shapes::shapeNames()) << ".\nOUTPUT is a PCD, PLY or XYZ file, by its extension.\n\n"
       << describeOptions();
  return text.str();
}

}  // namespace mlsmesh::apps
