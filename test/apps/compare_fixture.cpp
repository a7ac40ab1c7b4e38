// SPDX-License-Identifier: BSD-3-Clause
#include "compare_fixture.h"

#include "shapes/scan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace mlsmesh::test {

Outcome runCompare(const std::vector<std::string>& arguments, const std::function<bool()>& prepare) {
  const TemporaryFolder prints;
  return Program(MLSMESH_COMPARE, arguments, prints.path(), prepare).wait();
}

void expectOneLine(const Outcome& outcome, int exit_code, const std::string& culprit) {
  EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
  EXPECT_EQ(outcome.err.rfind("mlsmesh_compare: ", 0), 0U) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_NE(outcome.err.find(culprit), std::string::npos) << outcome.err;
}

std::string xyzText(const std::string& shape, std::size_t count) {
  shapes::ScanOptions options;
  options.count = count;
  std::ostringstream text;
  for (const shapes::Vec3& p : shapes::scan(*shapes::makeShape(shape), options).points)
    text << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
  return text.str();
}

Json readJson(const fs::path& file) {
  return Json::parse(readFile(file));
}

Json rowOf(const Json& results, const std::string& method) {
  for (const Json& row : results.at("clouds").at(0).at("rows"))
    if (row.at("method") == method) return row;
  return {};
}

Json inspected(const fs::path& mesh, std::vector<std::string> arguments) {
  const TemporaryFolder prints;
  const std::string json = prints.file("report.json");
  arguments.insert(arguments.end(), {mesh.string(), "--json", json, "--quiet"});
  const Outcome outcome = Program(MLSMESH_INSPECT, arguments, prints.path()).wait();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return readJson(json);
}

std::set<std::string> filesBelow(const fs::path& folder) {
  std::set<std::string> files;
  if (!fs::exists(folder)) return files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (!entry.is_directory()) files.insert(fs::relative(entry.path(), folder).string());
  return files;
}

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::size_t countOf(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++count;
  return count;
}

std::string withCommas(std::size_t number) {
  const std::string digits = std::to_string(number);
  std::string text;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) text += ',';
    text += digits[i];
  }
  return text;
}

}  // namespace mlsmesh::test
