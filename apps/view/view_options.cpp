// SPDX-License-Identifier: BSD-3-Clause
#include "view/view_options.h"

#include "common/command_line.h"
#include "common/settings.h"
#include "drawing/picture.h"
#include "view/keys.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>
#include <sstream>

namespace mlsmesh::apps {
namespace {

namespace po = boost::program_options;

constexpr int kMaxSide = 16384;
constexpr int kPaneSide = 800;
constexpr int kMaxPanesPerRow = 4;
constexpr unsigned kHelpWidth = 100;

/// What a config file may say beside how clouds are reconstructed.
const std::set<std::string>& namesForFiles() {
  static const std::set<std::string> kNames{"show", "level", "scale", "size",      "view",    "up",
                                            "zoom", "flat",  "edges", "wireframe", "borders", "no-labels"};
  return kNames;
}

po::options_description drawingOptions() {
  const auto text = [](const char* name) { return po::value<std::string>()->value_name(name); };
  po::options_description options("Options (-name value or --name=value)", kHelpWidth);
  auto add = options.add_options();
  add("show", text("MODE"),
      "cloud, clusters, representatives, mesh, borders, defects or distance (default: what a file is)");
  add("level", text("N"), "level of a reconstruction that is shown, 0 = coarsest (default: finest)");
  add("cloud", text("FILE"), "what distances are measured to (default: the cloud among the files)");
  add("scale", text("X"), "spacings at the dark end of the scale of distances (default: by the meshes)");
  add("screenshot", text("FILE"), "write a PNG picture instead of opening a window; needs no display");
  add("script", text("KEYS"), "press keys, between commas; p=FILE writes a picture, wait waits for meshes");
  add("size", text("WxH"), "pixels of window or picture (default 800 x 800 a file)");
  add("view", text("NAME"), "front, back, left, right, top, bottom or iso (default iso)");
  add("up", text("AXIS"), "x, y or z points up (default y)");
  add("zoom", text("FACTOR"), "larger than 1: nearer (default 1)");
  add("flat", flagValue(), "one shade a triangle, instead of smooth shading");
  add("edges", flagValue(), "draw the edges of the triangles on them");
  add("wireframe", flagValue(), "draw the edges alone");
  add("borders", flagValue(), "draw borders also where meshes are shown");
  add("no-labels", flagValue(), "leave out file names and counts");
  add("help,h", po::bool_switch(), "this text");
  add("version", po::bool_switch(), "the version");
  return options;
}

po::options_description makingOptions() {
  po::options_description options("How clouds are reconstructed (as mlsmesh_reconstruct takes it)",
                                  kHelpWidth);
  addReconstructionOptions(options);
  return options;
}

po::variables_map parse(int argc, const char* const* argv) {
  po::options_description all = drawingOptions();
  all.add_options()("files", po::value<std::vector<std::string>>());
  addReconstructionOptions(all);
  addParameterOptions(all);
  po::positional_options_description positions;
  positions.add("files", -1);
  return parseCommandLine(argc, argv, all, positions);
}

std::array<int, 2> sizeFromText(const std::string& culprit, const std::string& text) {
  std::array<int, 2> size{};
  char extra = 0;
  const bool is_size = std::sscanf(text.c_str(), "%dx%d%c", &size[0], &size[1], &extra) == 2;
  if (is_size && *std::min_element(size.begin(), size.end()) > 0 &&
      *std::max_element(size.begin(), size.end()) <= kMaxSide) {
    return size;
  }
  throw usageError(culprit,
                   "'" + text + "' is not WIDTHxHEIGHT; give for example 1600x800 (1 .. 16384 each)");
}

std::array<int, 2> defaultSize(std::size_t files) {
  const auto [columns, rows] = paneGrid(files);
  return {std::min(columns * kPaneSide, kMaxSide), std::min(rows * kPaneSide, kMaxSide)};
}

double rangedNumber(const Settings& settings, const std::string& name, double low, double high,
                    const char* range, double otherwise) {
  if (!settings.has(name)) return otherwise;
  const std::string text = settings.text(name, ""), culprit = settings.culprit(name);
  const double value = numberFromText(culprit, text);
  if (value >= low && value <= high) return value;
  throw usageError(culprit, "'" + text + "' is out of range; give " + range);
}

/// Of a reconstruction with so many refinement steps.
int levelFromText(const std::string& culprit, const std::string& text, int steps) {
  const double level = numberFromText(culprit, text);
  if (level >= 0 && level <= steps && level == std::floor(level)) return static_cast<int>(level);
  throw usageError(culprit, "'" + text + "' is no level; there are 0 .. " + std::to_string(steps) +
                                ", and more with --levels");
}

void setPicture(const Settings& settings, ViewOptions& options) {
  options.screenshot = settings.text("screenshot", "");
  if (settings.has("screenshot")) checkPictureFormat("--screenshot", options.screenshot);
  if (settings.has("script")) options.script = parseScript(settings.text("script", ""));
  options.size = settings.has("size") ? sizeFromText(settings.culprit("size"), settings.text("size", ""))
                                      : defaultSize(options.files.size());
  options.view = settings.text("view", "iso");
  options.up = settings.text("up", "y");
  options.viewpoint =
      namedViewpoint(options.view, options.up, settings.culprit("view"), settings.culprit("up"));
  options.zoom = rangedNumber(settings, "zoom", 0.01, 100.0, "0.01 .. 100", 1.0);
}

void setLook(const Settings& settings, ViewOptions& options) {
  options.look = {settings.flag("flat"), settings.flag("edges"), settings.flag("wireframe")};
  options.borders = settings.flag("borders");
  options.labels = !settings.flag("no-labels");
  if (settings.has("show")) options.mode = modeNamed(settings.text("show", ""), settings.culprit("show"));
  if (settings.has("level")) {
    options.level = levelFromText(settings.culprit("level"), settings.text("level", ""),
                                  options.reconstruction.parameters.refinement.levels);
  }
  options.scale = rangedNumber(settings, "scale", 1e-9, 1e9, "1e-9 .. 1e9", options.scale);
}

}  // namespace

std::array<int, 2> paneGrid(std::size_t files) {
  const int count = static_cast<int>(files);
  const int rows = (count + kMaxPanesPerRow - 1) / kMaxPanesPerRow;
  return {(count + rows - 1) / rows, rows};
}

ViewOptions readViewOptions(int argc, const char* const* argv) {
  const po::variables_map values = parse(argc, argv);
  ViewOptions options;
  options.help = values["help"].as<bool>();
  options.version = values["version"].as<bool>();
  if (options.help || options.version) return options;
  if (values.count("files") == 0) throw usageError("arguments", "no file to look at; see --help");
  for (const std::string& file : values["files"].as<std::vector<std::string>>())
    options.files.emplace_back(file);
  std::vector<ConfigEntry> entries;
  if (values.count("config") > 0) entries = readConfigFile(values["config"].as<std::string>());
  const Settings settings(values, takeEntries(namesForFiles(), entries));
  options.cloud = settings.text("cloud", "");
  options.reconstruction = reconstructionOptions(values, entries, namesForFiles());
  setPicture(settings, options);
  setLook(settings, options);
  return options;
}

std::string viewHelp() {
  std::string in_files;
  for (const std::string& name : namesForFiles()) in_files += (in_files.empty() ? " " : ", ") + name;
  std::ostringstream text;
  text << "Usage: " << kViewProgram
       << " FILE... [options]\n\n"
          "Shows meshes and clouds side by side, with one camera. Clouds are reconstructed where what is\n"
          "shown needs a mesh, and in a window that shows nothing but clouds.\n\n"
       << drawingOptions() << "\n"
       << makingOptions()
       << "\nAll other parameters are options, too: see mlsmesh_reconstruct --list-parameters. The file of "
          "--config may also\nset"
       << in_files << ".\n\nKeys:\n"
       << keyHelp();
  return text.str();
}

}  // namespace mlsmesh::apps
