// SPDX-License-Identifier: BSD-3-Clause
#include "inspect/report.h"

#include "mlsmesh/version.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace mlsmesh::apps {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostListed = 100;  // components, borders
constexpr std::size_t kNameWidth = 24;

Json valueJson(const Figure& figure) {
  if (!std::isfinite(figure.value)) return {};
  if (figure.kind == Figure::Kind::Flag) return figure.value != 0;
  if (figure.kind == Figure::Kind::Count) return static_cast<std::int64_t>(figure.value);
  return figure.value;
}

Json fileJson(const std::filesystem::path& file) {
  return file.empty() ? Json() : Json(file.string());
}

Json componentJson(const ComponentTopology& component) {
  const std::optional<core::Index> genus = component.genus();
  return {{"vertices", component.vertices},
          {"triangles", component.triangles},
          {"border_loops", component.border_loops},
          {"euler", component.euler()},
          {"genus", genus ? Json(*genus) : Json()},
          {"manifold", component.isManifold()},
          {"closed", component.isClosed()},
          {"orientable", component.orientable},
          {"orientation_conflicts", component.orientation_conflicts},
          {"area", component.area}};
}

Json borderJson(const Border& border) {
  return {{"component", border.component},
          {"edges", border.edges},
          {"length", border.length},
          {"loop", border.is_loop}};
}

/// The first ones, as many as are listed.
template <class Item>
Json listJson(const std::vector<Item>& items, Json (*itemJson)(const Item&)) {
  Json list = Json::array();
  for (std::size_t i = 0; i < std::min(items.size(), kMostListed); ++i) list.push_back(itemJson(items[i]));
  return list;
}

/// The unit that a figure is a multiple of, if it is that of the figure before it.
std::string unitOf(const Figure& figure, const Figure& before) {
  if (figure.group != before.group || figure.name.rfind(before.name + "_", 0) != 0) return {};
  const std::string suffix = figure.name.substr(before.name.size() + 1);
  return suffix == "spacings" || suffix == "diagonals" ? suffix : std::string();
}

}  // namespace

std::string reportText(const InspectOptions& options, const FigureTable& table) {
  std::string text = options.mesh.string() + "\n";
  const std::vector<Figure>& figures = table.figures();
  for (std::size_t i = 0; i < figures.size(); ++i) {
    const Figure& figure = figures[i];
    if (i == 0 || figures[i - 1].group != figure.group) text += "\n" + figure.group + "\n";
    text += "  " + figure.name + std::string(kNameWidth - std::min(kNameWidth, figure.name.size()), ' ') +
            figure.text();
    const std::string unit = i + 1 < figures.size() ? unitOf(figures[i + 1], figure) : std::string();
    if (!unit.empty()) text += " = " + figures[++i].text() + " " + unit;
    text += "\n";
  }
  return text;
}

std::string reportJson(const InspectOptions& options, const Inspection& inspection,
                       const FigureTable& table) {
  Json json;
  json["program"] = kInspectProgram;
  json["version"] = MLSMESH_VERSION;
  json["mesh"] = fileJson(options.mesh);
  json["cloud_file"] = fileJson(options.cloud);
  json["truth_file"] = fileJson(options.truth);
  json["samples"] = options.samples;
  for (const Figure& figure : table.figures()) json[figure.group][figure.name] = valueJson(figure);
  json["components"] = listJson(inspection.topology.components, componentJson);
  json["borders"] = listJson(inspection.topology.borders, borderJson);
  json["seconds"] = inspection.seconds;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace mlsmesh::apps
