// SPDX-License-Identifier: BSD-3-Clause
#include "compare_fixture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <regex>
#include <string>
#include <vector>

namespace mlsmesh::test {
namespace {

const std::string kNoBreak = "\u00A0";

/// What stands between two texts, each time they follow each other.
std::vector<std::string> between(const std::string& text, const std::string& begin, const std::string& end) {
  std::vector<std::string> parts;
  for (std::size_t at = text.find(begin); at != std::string::npos; at = text.find(begin, at)) {
    at += begin.size();
    parts.push_back(text.substr(at, text.find(end, at) - at));
  }
  return parts;
}

std::vector<std::vector<std::string>> matches(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern);
  std::vector<std::vector<std::string>> found;
  for (std::sregex_iterator it(text.begin(), text.end(), regex), end; it != end; ++it) {
    found.emplace_back();
    for (const auto& group : *it) found.back().push_back(group.str());
  }
  return found;
}

/// Pages of a cloud of which greedy projection has every point for a vertex, so that distances from the mesh
/// are none or dust, and which one method refuses.
class ComparePage : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    const std::string cloud = folder_->write("torus.xyz", xyzText("torus", 2000));
    const Outcome outcome = runCompare(
        {cloud, "--methods", "level-0,gp3-oriented,organized", "--no-pictures", "--output", output()});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  }
  static void TearDownTestSuite() {
    delete folder_;
    folder_ = nullptr;
  }

  static std::string output() { return folder_->file("out"); }
  static std::string page() { return readFile(output() + "/report.html"); }
  static Json results() { return readJson(output() + "/results.json"); }

  static TemporaryFolder* folder_;
};

TemporaryFolder* ComparePage::folder_ = nullptr;

TEST_F(ComparePage, CellsRoundTheValuesTheySortBy) {
  const std::string page = ComparePage::page();
  const auto cells = matches(page, "<td (?:class=\"bad\" )?data-v=\"([^\"]+)\">(?:&#9650; )?([^<]*)</td>");
  ASSERT_GT(cells.size(), 30U);
  std::size_t large = 0;
  for (const auto& cell : cells) {
    const double value = std::strtod(cell[1].c_str(), nullptr);
    const std::string& text = cell[2];
    if (value > 0 && value < 1e-4 && text != "0.00") {
      EXPECT_EQ(text, "&lt; 0.0001") << cell[1];
    }
    if (value >= 1000) {
      EXPECT_EQ(text, withCommas(static_cast<std::size_t>(std::llround(value))));
      ++large;
    }
    EXPECT_EQ(text.find('e'), std::string::npos) << text;
  }
  EXPECT_GE(large, 3U) << "vertices, and triangles in two tables";
}

TEST_F(ComparePage, FilesForProgramsKeepAllDigits) {
  const Json row = rowOf(results(), "gp3-oriented");
  const std::string csv = readFile(output() + "/results.csv");
  const std::string triangles = std::to_string(row.at("report").at("topology").at("triangles").get<int>());
  EXPECT_NE(csv.find("," + triangles + ","), std::string::npos);
  EXPECT_EQ(csv.find("< 0.0001"), std::string::npos);
}

TEST_F(ComparePage, LegendsNameWhatIsInThePlot) {
  const std::vector<std::string> legends = between(page(), "<ul class=\"legend\">", "</ul>");
  ASSERT_EQ(legends.size(), 1U);
  EXPECT_EQ(countOf(legends[0], "<li>"), 2U);
  for (const Json& row : results().at("clouds").at(0).at("rows"))
    EXPECT_EQ(countOf(legends[0], row.at("label").get<std::string>()), row.at("report").is_null() ? 0U : 1U);
}

TEST_F(ComparePage, WhatRefusedHasNoMemory) {
  const Json row = rowOf(results(), "organized");
  ASSERT_EQ(row.at("status"), "refused");
  EXPECT_GT(row.at("peak_rss_bytes"), 0);
  const std::string page = ComparePage::page();
  const std::size_t at = page.find("refused: ");
  ASSERT_NE(at, std::string::npos);
  const std::string cells = page.substr(at, page.find("</tr>", at) - at);
  EXPECT_GE(countOf(cells, "data-v=\"\">–</td>"), 7U) << cells;
  EXPECT_EQ(countOf(cells, "data-v="), countOf(cells, "data-v=\"\"")) << "no figure behind the result";
}

TEST_F(ComparePage, NumbersKeepTheirUnits) {
  const std::string page = ComparePage::page();
  EXPECT_NE(page.find("quality 5" + kNoBreak + "%"), std::string::npos);
  EXPECT_EQ(matches(page, "(<t[hd][^>]*>|<d[td]>)[^<]* %").size(), 0U);
  EXPECT_NE(page.find("2,000" + kNoBreak + "points"), std::string::npos);
}

TEST(ComparePictures, CaptionsSayWhoIsToJudge) {
  const TemporaryFolder folder;
  const std::string cloud = folder.write("torus.xyz", xyzText("torus", 300));
  const std::string truth = folder.write("truth.obj", "v 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n");
  const std::string other = folder.write("again.xyz", xyzText("torus", 300));
  const std::string output = folder.file("out");
  ASSERT_EQ(
      runCompare({cloud, other, "--truth", truth, "--truth", "none", "--methods", "gp3", "--output", output})
          .exit_code,
      0);
  const std::string page = readFile(output + "/report.html");
  const std::vector<std::string> notes = between(page, "Dark where the mesh is far from points", "</p>");
  ASSERT_EQ(notes.size(), 2U);
  EXPECT_EQ(countOf(notes[0], "the distances from the true surface"), 1U);
  EXPECT_EQ(countOf(notes[1], "--truth"), 1U);
  EXPECT_EQ(matches(page, "mean" + kNoBreak + "[^ ]+, 95" + kNoBreak + "%" + kNoBreak + "[^ ]+, max" +
                              kNoBreak + "[^ ]+" + kNoBreak + "spacings")
                .size(),
            4U);
}

}  // namespace
}  // namespace mlsmesh::test
