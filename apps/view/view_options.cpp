// SPDX-License-Identifier: BSD-3-Clause
#include "view/view_options.h"

#include "common/command_line.h"
#include "common/file_bytes.h"

#include <algorithm>
#include <cstdio>
#include <sstream>

namespace mlsmesh::apps {
namespace {

namespace po = boost::program_options;

constexpr int kMaxSide = 16384;
constexpr int kPaneSide = 800;
constexpr int kMaxPanesPerRow = 4;

po::options_description describeOptions() {
  const auto text = [](const char* name) { return po::value<std::string>()->value_name(name); };
  po::options_description options("Options (-name value or --name=value)");
  auto add = options.add_options();
  add("screenshot", text("FILE"), "write a PNG picture instead of opening a window; needs no display");
  add("size", text("WxH"), "pixels of window or picture (default 800 x 800 a file)");
  add("view", text("NAME"), "front, back, left, right, top, bottom or iso (default iso)");
  add("up", text("AXIS"), "x, y or z points up (default y)");
  add("zoom", text("FACTOR"), "larger than 1: nearer (default 1)");
  add("flat", po::bool_switch(), "one shade a triangle, instead of smooth shading");
  add("edges", po::bool_switch(), "draw the edges of the triangles on them");
  add("wireframe", po::bool_switch(), "draw the edges alone");
  add("borders", po::bool_switch(), "highlight borders and edges of more than two triangles");
  add("no-labels", po::bool_switch(), "leave out file names and counts");
  add("help,h", po::bool_switch(), "this text");
  add("version", po::bool_switch(), "the version");
  return options;
}

po::variables_map parse(int argc, const char* const* argv) {
  po::options_description all = describeOptions();
  all.add_options()("files", po::value<std::vector<std::string>>());
  po::positional_options_description positions;
  positions.add("files", -1);
  return parseCommandLine(argc, argv, all, positions);
}

std::string textOf(const po::variables_map& values, const std::string& name, const std::string& otherwise) {
  return values.count(name) > 0 ? values[name].as<std::string>() : otherwise;
}

std::array<int, 2> sizeFromText(const std::string& text) {
  std::array<int, 2> size{};
  char extra = 0;
  const bool is_size = std::sscanf(text.c_str(), "%dx%d%c", &size[0], &size[1], &extra) == 2;
  if (is_size && *std::min_element(size.begin(), size.end()) > 0 &&
      *std::max_element(size.begin(), size.end()) <= kMaxSide) {
    return size;
  }
  throw usageError("--size",
                   "'" + text + "' is not WIDTHxHEIGHT; give for example 1600x800 (1 .. 16384 each)");
}

std::array<int, 2> defaultSize(std::size_t files) {
  const auto [columns, rows] = paneGrid(files);
  return {std::min(columns * kPaneSide, kMaxSide), std::min(rows * kPaneSide, kMaxSide)};
}

double zoomFromText(const std::string& text) {
  const double zoom = numberFromText("--zoom", text);
  if (zoom >= 0.01 && zoom <= 100.0) return zoom;
  throw usageError("--zoom", "'" + text + "' is out of range; give 0.01 .. 100");
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
  options.screenshot = textOf(values, "screenshot", "");
  if (values.count("screenshot") > 0 && extensionOf(options.screenshot) != "png") {
    throw usageError("--screenshot", "'" + options.screenshot.string() +
                                         "' is not a PNG file; give a name that ends in .png");
  }
  options.size =
      values.count("size") > 0 ? sizeFromText(textOf(values, "size", "")) : defaultSize(options.files.size());
  options.viewpoint = namedViewpoint(textOf(values, "view", "iso"), textOf(values, "up", "y"));
  options.zoom = zoomFromText(textOf(values, "zoom", "1"));
  options.flat = values["flat"].as<bool>();
  options.edges = values["edges"].as<bool>();
  options.wireframe = values["wireframe"].as<bool>();
  options.borders = values["borders"].as<bool>();
  options.labels = !values["no-labels"].as<bool>();
  return options;
}

std::string viewHelp() {
  std::ostringstream text;
  text << "mlsmesh_view FILE... [options]\n\n"
          "Shows meshes and clouds side by side, with one camera.\n"
          "Keys: Left and Right one file after the other, a all of them, b borders, g edges of triangles, "
          "r fits the view, w wireframe, s surface, q ends.\n\n"
       << describeOptions();
  return text.str();
}

}  // namespace mlsmesh::apps
