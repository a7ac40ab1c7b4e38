// SPDX-License-Identifier: BSD-3-Clause
#include "compare/page.h"

#include "common/number_text.h"
#include "compare/columns.h"
#include "compare/compare_options.h"
#include "compare/page_gallery.h"
#include "compare/page_markup.h"
#include "compare/page_parts.h"
#include "compare/plots.h"
#include "mlsmesh/version.h"

#include <algorithm>
#include <cmath>

namespace mlsmesh::apps {
namespace {

constexpr double kFloorPercent = 1e-4;   // errors below are drawn there
constexpr double kFloorSpacings = 1e-3;  // likewise

// Tables.

std::string tableHead(const ColumnGroup& group) {
  std::string head = element("th", "method", "scope=\"col\"");
  if (group.has_all_rows) head += element("th", "result", "scope=\"col\" data-text");
  for (const Column& column : group.columns)
    head += element("th", prose(column.heading), "scope=\"col\" title=\"" + escaped(column.meaning) + "\"");
  return element("thead", element("tr", head));
}

std::string tableCell(const Column& column, const Row& row) {
  const std::string mark = column.isDefect(row) ? "&#9650; " : "";
  return element("td", mark + escaped(column.text(row)),
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
         element("p", "&harr;&ensp;The table is wider than this: move it sideways.", "class=\"note wider\"") +
         element("div", element("table", tableHead(group) + element("tbody", body), "class=\"sorts\""),
                 "class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"" + group.title + "\"") +
         "\n";
}

// Plots.

/// The methods that have a mark.
std::string plotLegend(const std::vector<Series>& series, const std::vector<Row>& rows) {
  std::string items;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (!series[i].points.empty()) items += element("li", numbered(i, rows[i].method->label));
  return items.empty() ? "" : element("ul", items, "class=\"legend\"");
}

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
  const std::string plot =
      has_truth ? scatterPlot("Error against triangles", "triangles",
                              "mean distance from the truth, % of diagonal", kFloorPercent, series)
                : scatterPlot("Error against triangles", "triangles", "mean distance of the points, spacings",
                              kFloorSpacings, series);
  return element("div", plot + plotLegend(series, cloud.rows));
}

std::string timeBars(const CloudResult& cloud) {
  std::vector<Bar> bars;
  for (std::size_t i = 0; i < cloud.rows.size(); ++i) {
    const Row& row = cloud.rows[i];
    if (row.status == RowStatus::Done)
      bars.push_back({static_cast<int>(i) + 1, row.method->label, row.normalSeconds(), row.methodSeconds()});
  }
  return element("div", barPlot("Time", "normals", "method", "seconds", bars));
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
  return element("div", scatterPlot("Time against points", "points", "seconds, normals included", 0, series) +
                            plotLegend(series, comparison.clouds.front().rows));
}

// The page.

std::string stageList(const CloudResult& cloud) {
  std::string items;
  for (const Row& row : cloud.rows) {
    std::string stages;
    for (const StageSeconds& stage : row.stages)
      stages += (stages.empty() ? "" : ", ") + stage.name + kNoBreak + readableText(stage.seconds);
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
      element("code", escaped(cloud.file.string())) + ": " + withCommas(cloud.points) + kNoBreak + "points";
  if (cloud.finite < cloud.points) text += " (" + withCommas(cloud.finite) + kNoBreak + "finite)";
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
  html += element("h3", "Plots") + element("div", errorPlot(cloud) + timeBars(cloud), "class=\"plots\"");
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
      items += element("dt", prose(column.heading)) + element("dd", prose(column.meaning));
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
                  " where it can choose, for at most " + numberText(comparison.limit_seconds, 6) + kNoBreak +
                  "s and with at most " + wholeText(toMegabytes(comparison.memory_bytes)) + kNoBreak + "MB.",
              "class=\"facts\"");
  if (comparison.clouds.size() < 2) return text;
  std::string links;
  for (const CloudResult& cloud : comparison.clouds)
    links += element("a", escaped(cloud.name), "href=\"#" + escaped(cloud.name) + "\"");
  return text + element("nav", links) + element("div", timePlot(comparison), "class=\"plots\"");
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
