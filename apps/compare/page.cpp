// SPDX-License-Identifier: BSD-3-Clause
#include "compare/page.h"

#include "common/file_bytes.h"
#include "compare/columns.h"
#include "compare/compare_options.h"
#include "compare/mark_colors.h"
#include "compare/page_parts.h"
#include "compare/plots.h"
#include "mlsmesh/version.h"

#include <vtkBase64Utilities.h>
#include <vtkLookupTable.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace mlsmesh::apps {
namespace {

constexpr double kFloorPercent = 1e-4;   // errors below are drawn there
constexpr double kFloorSpacings = 1e-3;  // likewise

std::string element(const std::string& tag, const std::string& content, const std::string& attributes = "") {
  return "<" + tag + (attributes.empty() ? "" : " " + attributes) + ">" + content + "</" + tag + ">";
}

std::string dataUri(const std::filesystem::path& jpeg) {
  const std::string bytes = readBytes(jpeg);
  std::string text(bytes.size() / 3 * 4 + 8, '\0');
  const auto length =
      vtkBase64Utilities::Encode(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(),
                                 reinterpret_cast<unsigned char*>(text.data()), 0);
  text.resize(length);
  return "data:image/jpeg;base64," + text;
}

std::string numbered(std::size_t row, const std::string& label) {
  const int number = static_cast<int>(row) + 1;
  return markIcon(number) + std::to_string(number) + "&ensp;" + escaped(label);
}

std::string colorText(const Rgb& color) {
  return "rgb(" + std::to_string(color[0]) + "," + std::to_string(color[1]) + "," + std::to_string(color[2]) +
         ")";
}

// Tables.

std::string tableHead(const ColumnGroup& group) {
  std::string head = element("th", "method", "scope=\"col\"");
  if (group.has_all_rows) head += element("th", "result", "scope=\"col\" data-text");
  for (const Column& column : group.columns)
    head += element("th", escaped(column.heading), "scope=\"col\" title=\"" + escaped(column.meaning) + "\"");
  return element("thead", element("tr", head));
}

std::string tableCell(const Column& column, const Row& row) {
  const std::string mark = column.isDefect(row) ? "&#9650; " : "";
  return element("td", mark + column.text(row),
                 std::string(mark.empty() ? "" : "class=\"bad\" ") + "data-v=\"" +
                     (std::isfinite(column.value(row)) ? numberText(column.value(row), 12) : "") + "\"");
}

std::string table(const ColumnGroup& group, const CloudResult& cloud) {
  std::string body;
  for (const std::size_t i : rowsOf(group, cloud)) {
    const Row& row = cloud.rows[i];
    std::string cells = element("th", numbered(i, row.method->label),
                                "scope=\"row\" data-v=\"" + std::to_string(i + 1) + "\"");
    if (group.has_all_rows) {
      const std::string result = escaped(resultText(row));
      cells += element("td", result, "class=\"words\" data-v=\"" + result + "\"");
    }
    for (const Column& column : group.columns) cells += tableCell(column, row);
    body += element("tr", cells) + "\n";
  }
  return element("h3", group.title) +
         element("div", element("table", tableHead(group) + element("tbody", body), "class=\"sorts\""),
                 "class=\"scroll\" tabindex=\"0\"") +
         "\n";
}

// Pictures.

std::string figure(const std::string& caption, const std::filesystem::path& picture, const std::string& alt,
                   const std::string& otherwise) {
  const std::string image =
      picture.empty()
          ? element("div", otherwise, "class=\"none\"")
          : element("div",
                    "<img loading=\"lazy\" alt=\"" + escaped(alt) + "\" src=\"" + dataUri(picture) + "\">",
                    "class=\"picture\"");
  return element("figure", image + element("figcaption", caption)) + "\n";
}

std::string countText(const Row& row, const char* name, const char* one, const char* many) {
  const double count = row.figure("topology", name);
  return count > 0 ? numberText(count, 12) + " " + (count == 1 ? one : many) : std::string();
}

/// What there is to see in the picture of a surface.
std::string surfaceText(const Row& row) {
  std::string text;
  for (const std::string& part :
       {countText(row, "triangles", "triangle", "triangles"),
        countText(row, "border_loops", "border loop", "border loops"),
        countText(row, "nonmanifold_edges", "non-manifold edge", "non-manifold edges"),
        countText(row, "orientation_conflicts", "misoriented edge", "misoriented edges"),
        countText(row, "self_intersections", "self-intersection", "self-intersections")})
    if (!part.empty()) text += (text.empty() ? "" : ", ") + part;
  return text;
}

std::string distanceText(const Row& row, const std::string& group) {
  return "mean " + numberText(row.figure(group, "mean_spacings"), 3) + ", 95 % " +
         numberText(row.figure(group, "p95_spacings"), 3) + ", max " +
         numberText(row.figure(group, "max_spacings"), 3) + " spacings";
}

using PictureOf = std::filesystem::path Pictures::*;

/// Of every method; of those without a mesh, beside the surfaces only, why.
std::string methodFigures(const CloudResult& cloud, PictureOf picture, const std::string& what,
                          std::string (*text)(const Row&)) {
  std::string figures;
  for (std::size_t i = 0; i < cloud.rows.size(); ++i) {
    const Row& row = cloud.rows[i];
    if (row.mesh_file.empty() && picture != &Pictures::surface) continue;  // said once
    const std::string caption =
        numbered(i, row.method->label) + element("small", row.report.is_object() ? escaped(text(row)) : "");
    figures += figure(caption, row.pictures.*picture, what + " of " + row.method->label,
                      row.mesh_file.empty() ? escaped(resultText(row)) : "no picture");
  }
  return figures;
}

std::string swatch(const std::string& shapes, const std::string& text) {
  return element("li", "<svg class=\"swatch\" viewBox=\"0 0 34 16\" aria-hidden=\"true\">" + shapes +
                           "</svg>" + escaped(text));
}

std::string lineSwatch(const Rgb& color, double width, const std::string& text) {
  return swatch("<rect width=\"34\" height=\"16\" fill=\"" + colorText(MarkColors::kFront) +
                    "\"/><path stroke=\"" + colorText(color) + "\" stroke-width=\"" + numberText(width, 3) +
                    "\" d=\"M0 8H34\"/>",
                text);
}

std::string areaSwatch(const Rgb& color, const std::string& text) {
  return swatch("<rect width=\"34\" height=\"16\" fill=\"" + colorText(color) + "\"/>", text);
}

std::string markLegend() {
  return element("ul",
                 areaSwatch(MarkColors::kFront, "front of a triangle") +
                     areaSwatch(MarkColors::kBack, "its back") +
                     lineSwatch(MarkColors::kBorder, 3, "border") +
                     lineSwatch(MarkColors::kNonManifold, 6, "non-manifold edge (widest)") +
                     lineSwatch(MarkColors::kMisoriented, 1.2, "misoriented edge (thinnest)") +
                     areaSwatch(MarkColors::kIntersecting, "triangles that meet others"),
                 "class=\"legend\"");
}

/// Of a place 0 .. 1 on the scale of the maps.
std::string scaleColor(double place) {
  static const vtkSmartPointer<vtkLookupTable> colors = valueColors(1);
  std::array<double, 3> color{};
  colors->GetColor(place, color.data());
  const auto byte = [](double share) { return static_cast<std::uint8_t>(std::lround(255 * share)); };
  return colorText({byte(color[0]), byte(color[1]), byte(color[2])});
}

std::string scaleLegend(double end) {
  constexpr int kSteps = 40;
  constexpr double kScaleWidth = 400;
  std::string svg =
      "<svg class=\"scale\" viewBox=\"-8 0 440 38\" role=\"img\" aria-label=\"scale from 0 to " +
      numberText(end, 3) + " spacings\">";
  for (int i = 0; i < kSteps; ++i) {
    svg += "<rect x=\"" + numberText(i * kScaleWidth / kSteps, 6) + "\" width=\"" +
           numberText(kScaleWidth / kSteps + 0.5, 6) + "\" height=\"16\" fill=\"" +
           scaleColor((i + 0.5) / kSteps) + "\"/>";
  }
  for (int i = 0; i <= 4; ++i) {
    const std::string text = numberText(end * i / 4, 3) + (i == 4 ? " and more" : i == 0 ? " spacings" : "");
    const char* anchor = i == 4 ? "end" : i == 0 ? "start" : "middle";
    svg += "<text y=\"33\" x=\"" + numberText(i == 4 ? kScaleWidth + 30 : i * kScaleWidth / 4, 6) +
           "\" text-anchor=\"" + anchor + "\">" + text + "</text>";
  }
  return svg + "</svg>";
}

std::string galleries(const CloudResult& cloud) {
  if (cloud.cloud_picture.empty()) return element("p", "No pictures were made.", "class=\"note\"");
  std::string originals = figure("The cloud" + element("small", std::to_string(cloud.points) + " points"),
                                 cloud.cloud_picture, "the cloud " + cloud.name, "");
  if (!cloud.truth_picture.empty())
    originals += figure("The true surface" + element("small", escaped(cloud.truth.filename().string())),
                        cloud.truth_picture, "the true surface", "");
  const auto gallery = [](const std::string& title, const std::string& note, const std::string& figures) {
    return element("h3", title) + note + element("div", figures, "class=\"gallery\"") + "\n";
  };
  return gallery("Surfaces", markLegend(),
                 originals + methodFigures(cloud, &Pictures::surface, "surface", surfaceText)) +
         gallery("How far each point of the cloud is from the mesh",
                 element("p", "Dark where the mesh misses the points.", "class=\"note\"") +
                     scaleLegend(kCloudToMeshEnd),
                 methodFigures(cloud, &Pictures::cloud_to_mesh, "distances of the points from the mesh",
                               [](const Row& row) { return distanceText(row, "cloud_to_mesh"); })) +
         gallery("How far each triangle of the mesh is from the cloud",
                 element("p",
                         "Measured from its centre to the nearest point. Dark where there are no points: "
                         "surface that was invented.",
                         "class=\"note\"") +
                     scaleLegend(kMeshToCloudEnd),
                 methodFigures(cloud, &Pictures::mesh_to_cloud, "distances of the mesh from the points",
                               [](const Row& row) { return distanceText(row, "mesh_to_cloud"); }));
}

// Plots.

std::string errorPlot(const CloudResult& cloud) {
  const bool has_truth = !cloud.truth.empty();
  std::vector<Series> series;
  for (std::size_t i = 0; i < cloud.rows.size(); ++i) {
    const Row& row = cloud.rows[i];
    const double triangles = row.figure("topology", "triangles");
    const double error = has_truth ? 100 * row.figure("truth", "mean_diagonals")
                                   : row.figure("cloud_to_mesh", "mean_spacings");
    Series one{static_cast<int>(i) + 1, {}};
    if (triangles > 0 && std::isfinite(error)) one.points.push_back({triangles, error});
    series.push_back(one);
  }
  return has_truth ? scatterPlot("Error against triangles", "triangles",
                                 "mean distance from the truth, % of diagonal", kFloorPercent, series)
                   : scatterPlot("Error against triangles", "triangles",
                                 "mean distance of the points, spacings", kFloorSpacings, series);
}

std::string timeBars(const CloudResult& cloud) {
  std::vector<Bar> bars;
  for (std::size_t i = 0; i < cloud.rows.size(); ++i) {
    const Row& row = cloud.rows[i];
    if (row.status == RowStatus::Done)
      bars.push_back({static_cast<int>(i) + 1, row.method->label, row.normalSeconds(), row.methodSeconds()});
  }
  return barPlot("Time", "normals", "method", "seconds", bars);
}

/// A line for each method over the clouds on which it came to its end.
std::string timePlot(const Comparison& comparison) {
  std::vector<Series> series;
  for (std::size_t i = 0; i < comparison.clouds.front().rows.size(); ++i) {
    Series one{static_cast<int>(i) + 1, {}};
    for (const CloudResult& cloud : comparison.clouds) {
      const Row& row = cloud.rows[i];
      if (row.status == RowStatus::Done && row.totalSeconds() > 0)
        one.points.push_back({static_cast<double>(cloud.finite), row.totalSeconds()});
    }
    std::sort(one.points.begin(), one.points.end(),
              [](const Series::Point& a, const Series::Point& b) { return a.x < b.x; });
    series.push_back(one);
  }
  return scatterPlot("Time against points", "points", "seconds, normals included", 0, series);
}

std::string plotLegend(const CloudResult& cloud) {
  std::string items;
  for (std::size_t i = 0; i < cloud.rows.size(); ++i)
    items += element("li", numbered(i, cloud.rows[i].method->label));
  return element("ul", items, "class=\"legend\"");
}

// The page.

std::string stageList(const CloudResult& cloud) {
  std::string items;
  for (const Row& row : cloud.rows) {
    std::string stages;
    for (const StageSeconds& stage : row.stages)
      stages += (stages.empty() ? "" : ", ") + stage.name + " " + numberText(stage.seconds, 3);
    items += element("dt", escaped(row.method->label)) +
             element("dd", escaped(row.parameters) +
                               (stages.empty() ? "" : "<br><small>seconds: " + escaped(stages) + "</small>"));
  }
  return element("details", element("summary", "How each method was called, and its stages") +
                                element("p", "s is the mean spacing of the points.", "class=\"note\"") +
                                element("dl", items));
}

std::string cloudFacts(const CloudResult& cloud) {
  std::string text =
      element("code", escaped(cloud.file.string())) + ": " + std::to_string(cloud.points) + " points";
  if (cloud.finite < cloud.points) text += " (" + std::to_string(cloud.finite) + " finite)";
  if (cloud.height > 1)
    text += ", organised as " + std::to_string(cloud.width) + " &times; " + std::to_string(cloud.height);
  text += ", spacing (median distance to the nearest point) " + numberText(cloud.spacing, 4) + ", diagonal " +
          numberText(cloud.diagonal, 4) + ".";
  if (!cloud.truth.empty()) text += " True surface: " + element("code", escaped(cloud.truth.string())) + ".";
  return element("p", text, "class=\"facts\"");
}

std::string cloudSection(const CloudResult& cloud) {
  std::string html = element("h2", escaped(cloud.name)) + cloudFacts(cloud);
  for (const ColumnGroup& group : columnGroups(!cloud.truth.empty())) html += table(group, cloud);
  html += element("h3", "Plots") + element("div", errorPlot(cloud) + timeBars(cloud), "class=\"plots\"") +
          plotLegend(cloud);
  return element("section", html + galleries(cloud) + stageList(cloud),
                 "id=\"" + escaped(cloud.name) + "\"") +
         "\n";
}

std::string meanings(const Comparison& comparison) {
  const bool with_truth = std::any_of(comparison.clouds.begin(), comparison.clouds.end(),
                                      [](const CloudResult& cloud) { return !cloud.truth.empty(); });
  std::string items;
  for (const ColumnGroup& group : columnGroups(with_truth))
    for (const Column& column : group.columns)
      items += element("dt", escaped(column.heading)) + element("dd", escaped(column.meaning));
  return element("h2", "What the columns are") +
         element("p",
                 "A value with &#9650; is a defect. Spacings are medians of the distances to the nearest "
                 "point.",
                 "class=\"note\"") +
         element("dl", items);
}

std::string introduction(const Comparison& comparison) {
  std::string text =
      element("h1", "Reconstructions side by side") +
      element("p",
              std::string(kCompareProgram) + " " MLSMESH_VERSION ", " + comparison.when +
                  ". Each method ran in a process of its own, on " +
                  (comparison.threads == 0 ? "all threads"
                                           : std::to_string(comparison.threads) +
                                                 (comparison.threads == 1 ? " thread" : " threads")) +
                  " where it can choose, for at most " + numberText(comparison.limit_seconds, 6) +
                  " s and with at most " + numberText(std::round(toMegabytes(comparison.memory_bytes)), 9) +
                  " MB.",
              "class=\"facts\"");
  if (comparison.clouds.size() < 2) return text;
  std::string links;
  for (const CloudResult& cloud : comparison.clouds)
    links += element("a", escaped(cloud.name), "href=\"#" + escaped(cloud.name) + "\"");
  return text + element("nav", links) + element("div", timePlot(comparison), "class=\"plots\"") +
         plotLegend(comparison.clouds.front());
}

}  // namespace

std::string reportPage(const Comparison& comparison) {
  std::string sections;
  for (const CloudResult& cloud : comparison.clouds) sections += cloudSection(cloud);
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n" +
         element("title", "Reconstructions side by side") + "\n" + element("style", pageStyle()) +
         "\n</head>\n<body>\n" + introduction(comparison) + "\n" + sections + meanings(comparison) + "\n" +
         element("script", pageScript()) + "\n</body>\n</html>\n";
}

}  // namespace mlsmesh::apps
