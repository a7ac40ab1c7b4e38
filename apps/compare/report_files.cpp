// SPDX-License-Identifier: BSD-3-Clause
#include "compare/report_files.h"

#include "common/number_text.h"
#include "compare/columns.h"
#include "compare/compare_options.h"
#include "inspect/figures.h"
#include "mlsmesh/version.h"

#include <algorithm>
#include <cmath>

namespace mlsmesh::apps {
namespace {

bool hasTruth(const Comparison& comparison) {
  return std::any_of(comparison.clouds.begin(), comparison.clouds.end(),
                     [](const CloudResult& cloud) { return !cloud.truth.empty(); });
}

Json rowJson(const Row& row) {
  Json json;
  json["method"] = row.method->name;
  json["label"] = row.method->label;
  json["maker"] = row.method->group == "paper" ? "mlsmesh" : row.method->group;
  json["parameters"] = row.parameters;
  json["status"] = nameOf(row.status);
  json["reason"] = row.reason;
  json["seconds"] = {{"normals", row.normalSeconds()},
                     {"method", row.methodSeconds()},
                     {"total", row.totalSeconds()},
                     {"cpu", row.cpu_seconds}};
  json["stages"] = Json::array();
  for (const StageSeconds& stage : row.stages)
    json["stages"].push_back({{"name", stage.name}, {"seconds", stage.seconds}});
  json["process"] = {{"wall", row.wall_seconds}, {"user", row.user_seconds}, {"system", row.system_seconds}};
  json["peak_rss_bytes"] = row.peak_bytes;
  json["mesh"] = row.mesh_file.empty() ? Json() : Json(row.mesh_file);
  json["report"] = row.report;
  return json;
}

Json cloudJson(const CloudResult& cloud) {
  Json json;
  json["name"] = cloud.name;
  json["file"] = cloud.file.string();
  json["truth"] = cloud.truth.empty() ? Json() : Json(cloud.truth.string());
  json["points"] = cloud.points;
  json["finite"] = cloud.finite;
  json["width"] = cloud.width;
  json["height"] = cloud.height;
  json["spacing"] = cloud.spacing;
  json["diagonal"] = cloud.diagonal;
  json["rows"] = Json::array();
  for (const Row& row : cloud.rows) json["rows"].push_back(rowJson(row));
  return json;
}

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + "\"";
}

std::string csvNumber(double value) {
  return std::isfinite(value) ? numberText(value, 9) : "";
}

/// What the reports have figures of.
std::vector<Figure> allFigures(bool with_truth) {
  Inspection blank;
  blank.cloud.emplace();
  if (with_truth) blank.truth.emplace();
  return figuresOf(blank).figures();
}

std::string csvLine(const CloudResult& cloud, const Row& row, const std::vector<Figure>& figures) {
  std::string line = quoted(cloud.name) + "," + std::to_string(cloud.points) + "," + row.method->name + "," +
                     nameOf(row.status) + "," + quoted(row.reason);
  for (const double value : {row.normalSeconds(), row.methodSeconds(), row.totalSeconds(), row.cpu_seconds,
                             row.wall_seconds, row.user_seconds, row.system_seconds})
    line += "," + csvNumber(value);
  line += "," + std::to_string(row.peak_bytes) + "," + quoted(row.mesh_file);
  for (const Figure& figure : figures) line += "," + csvNumber(row.figure(figure.group, figure.name));
  return line + "\n";
}

/// Text in a cell of a table.
std::string cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.insert(at, "\\");
  return text;
}

std::string markdownTable(const ColumnGroup& group, const CloudResult& cloud) {
  std::string head = "| # | method |", rule = "|---|---|";
  if (group.has_all_rows) {
    head += " result |";
    rule += "---|";
  }
  for (const Column& column : group.columns) {
    head += " " + column.heading + " |";
    rule += "---:|";
  }
  std::string text = head + "\n" + rule + "\n";
  for (const std::size_t i : rowsOf(group, cloud)) {
    const Row& row = cloud.rows[i];
    text += "| " + std::to_string(i + 1) + " | " + cell(row.method->label) + " |";
    if (group.has_all_rows) text += " " + cell(resultText(row)) + " |";
    for (const Column& column : group.columns) text += " " + column.text(row) + " |";
    text += "\n";
  }
  return text;
}

std::string cloudMarkdown(const CloudResult& cloud) {
  std::string text = "## " + cloud.name + "\n\n`" + cloud.file.string() + "`: " + withCommas(cloud.points) +
                     " points, spacing " + numberText(cloud.spacing, 4) + ", diagonal " +
                     numberText(cloud.diagonal, 4);
  if (!cloud.truth.empty()) text += "; true surface `" + cloud.truth.string() + "`";
  text += ".\n";
  for (const ColumnGroup& group : columnGroups(!cloud.truth.empty()))
    text += "\n### " + group.title + "\n\n" + markdownTable(group, cloud);
  return text + "\n";
}

std::string meanings(bool with_truth) {
  std::string text = "## What the columns are\n\n";
  for (const ColumnGroup& group : columnGroups(with_truth))
    for (const Column& column : group.columns) text += "- " + column.heading + ": " + column.meaning + ".\n";
  return text;
}

std::string parameterMarkdown(const Comparison& comparison) {
  std::string text = "\n## How the methods are called\n\n*s* is the mean spacing of the points.\n\n";
  for (const Row& row : comparison.clouds.front().rows)
    text += "- " + row.method->label + " (`" + row.method->name + "`): " + row.parameters + ".\n";
  return text;
}

}  // namespace

std::string resultsJson(const Comparison& comparison) {
  Json json;
  json["program"] = kCompareProgram;
  json["version"] = MLSMESH_VERSION;
  json["when"] = comparison.when;
  json["limit_seconds"] = comparison.limit_seconds;
  json["memory_bytes"] = comparison.memory_bytes;
  json["threads"] = comparison.threads;
  json["clouds"] = Json::array();
  for (const CloudResult& cloud : comparison.clouds) json["clouds"].push_back(cloudJson(cloud));
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string resultsCsv(const Comparison& comparison) {
  const std::vector<Figure> figures = allFigures(hasTruth(comparison));
  std::string text =
      "cloud,points,method,status,reason,seconds.normals,seconds.method,seconds.total,seconds.cpu,"
      "process.wall,process.user,process.system,peak_rss_bytes,mesh";
  for (const Figure& figure : figures) text += "," + figure.path();
  text += "\n";
  for (const CloudResult& cloud : comparison.clouds)
    for (const Row& row : cloud.rows) text += csvLine(cloud, row, figures);
  return text;
}

std::string reportMarkdown(const Comparison& comparison) {
  std::string text =
      "# Reconstructions side by side\n\n" + std::string(kCompareProgram) + " " MLSMESH_VERSION ", " +
      comparison.when + "; limits of each method: " + numberText(comparison.limit_seconds, 6) + " s, " +
      wholeText(toMegabytes(comparison.memory_bytes)) +
      " MB; threads: " + (comparison.threads == 0 ? "all" : std::to_string(comparison.threads)) + ".\n\n";
  for (const CloudResult& cloud : comparison.clouds) text += cloudMarkdown(cloud);
  return text + meanings(hasTruth(comparison)) + parameterMarkdown(comparison);
}

}  // namespace mlsmesh::apps
