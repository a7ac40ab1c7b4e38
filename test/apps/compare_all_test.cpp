// SPDX-License-Identifier: BSD-3-Clause
#include "compare_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

namespace mlsmesh::test {
namespace {

/// Cells of a line of comma-separated values.
std::vector<std::string> cellsOf(const std::string& line) {
  std::vector<std::string> cells(1);
  bool is_quoted = false;
  for (const char c : line) {
    if (c == '"')
      is_quoted = !is_quoted;
    else if (c == ',' && !is_quoted)
      cells.emplace_back();
    else
      cells.back() += c;
  }
  return cells;
}

/// One comparison of all methods on a small torus, for the tests that only look at what it left.
class CompareAll : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    const std::string cloud = folder_->write("torus <1>.xyz", xyzText("torus", 600));
    outcome() = runCompare({cloud, "--limit", "60", "--output", output().string()});
  }
  static void TearDownTestSuite() {
    delete folder_;
    folder_ = nullptr;
  }

  static fs::path output() { return folder_->path() / "out"; }
  static Outcome& outcome() {
    static Outcome value;
    return value;
  }
  static Json results() { return readJson(output() / "results.json"); }
  /// By reference, for loops over it.
  static const Json& rows() {
    static const Json value = results().at("clouds").at(0).at("rows");
    return value;
  }

  static TemporaryFolder* folder_;
};

TemporaryFolder* CompareAll::folder_ = nullptr;

TEST_F(CompareAll, EveryMethodEndsAsARow) {
  ASSERT_EQ(outcome().exit_code, 0) << outcome().err;
  EXPECT_EQ(outcome().err, "");
  const std::vector<std::string> methods = {"level-0",   "level-1",      "level-2", "no-reduction",
                                            "gp3",       "gp3-oriented", "mls-gp3", "poisson-8",
                                            "poisson-9", "hoppe",        "rbf",     "grid-projection",
                                            "organized"};
  ASSERT_EQ(rows().size(), methods.size());
  for (std::size_t i = 0; i < methods.size(); ++i) {
    const Json& row = rows()[i];
    EXPECT_EQ(row.at("method"), methods[i]);
    if (methods[i] == "organized") {
      EXPECT_EQ(row.at("status"), "refused");
      EXPECT_TRUE(row.at("mesh").is_null() && row.at("report").is_null());
      continue;
    }
    EXPECT_EQ(row.at("status"), "done") << row.at("reason");
    EXPECT_EQ(row.at("reason"), "") << methods[i];
    EXPECT_GT(row.at("report").at("topology").at("triangles"), 100) << methods[i];
    EXPECT_GT(row.at("seconds").at("total"), 0.0) << methods[i];
    EXPECT_GT(row.at("peak_rss_bytes"), 1 << 20) << methods[i];
    EXPECT_NE(outcome().out.find(methods[i]), std::string::npos);
  }
}

TEST_F(CompareAll, TimesOfNormalsStandApart) {
  for (const Json& row : rows()) {
    double normals = 0, method = 0;
    for (const Json& stage : row.at("stages")) {
      const bool is_normals = stage.at("name") == "normals" || stage.at("name") == "orientation";
      (is_normals ? normals : method) += stage.at("seconds").get<double>();
    }
    EXPECT_NEAR(row.at("seconds").at("normals"), normals, 1e-9) << row.at("method");
    EXPECT_NEAR(row.at("seconds").at("method"), method, 1e-9) << row.at("method");
    EXPECT_LE(normals + method, row.at("process").at("wall").get<double>() + 0.01) << row.at("method");
  }
  EXPECT_EQ(rowOf(results(), "level-2").at("seconds").at("normals"), 0.0);
  EXPECT_GT(rowOf(results(), "gp3-oriented").at("seconds").at("normals"), 0.0);
}

TEST_F(CompareAll, OrientationMakesTheDifference) {
  const auto conflicts = [&](const char* method) {
    return rowOf(results(), method).at("report").at("topology").at("orientation_conflicts").get<int>();
  };
  EXPECT_GT(conflicts("gp3"), 20 * (1 + conflicts("gp3-oriented")));
  // Normals that point both ways would leave Poisson's surface in pieces, far from the torus.
  const Json poisson = rowOf(results(), "poisson-8").at("report");
  EXPECT_EQ(poisson.at("topology").at("genus"), 1);
  EXPECT_EQ(poisson.at("topology").at("components"), 1);
  EXPECT_LT(poisson.at("cloud_to_mesh").at("mean_spacings"), 0.3);
}

TEST_F(CompareAll, FiguresAreThoseOfInspect) {
  for (const char* method : {"level-2", "gp3", "grid-projection"}) {
    const Json row = rowOf(results(), method);
    const Json expected =
        inspected(output() / row.at("mesh").get<std::string>(), {"--cloud", folder_->file("torus <1>.xyz")});
    for (const char* group :
         {"input", "topology", "shape", "cloud", "cloud_to_mesh", "mesh_to_cloud", "components", "borders"})
      EXPECT_EQ(row.at("report").at(group), expected.at(group)) << method << " " << group;
  }
}

TEST_F(CompareAll, CsvSaysTheSame) {
  const std::vector<std::string> lines = linesOf(readFile(output() / "results.csv"));
  ASSERT_EQ(lines.size(), rows().size() + 1);
  const std::vector<std::string> heads = cellsOf(lines[0]);
  const auto column = [&](const std::string& head) {
    return static_cast<std::size_t>(std::find(heads.begin(), heads.end(), head) - heads.begin());
  };
  for (std::size_t i = 0; i < rows().size(); ++i) {
    const std::vector<std::string> cells = cellsOf(lines[i + 1]);
    ASSERT_EQ(cells.size(), heads.size());
    EXPECT_EQ(cells[column("method")], rows()[i].at("method"));
    EXPECT_EQ(cells[column("status")], rows()[i].at("status"));
    if (rows()[i].at("report").is_null()) {
      EXPECT_EQ(cells[column("topology.triangles")], "");
      continue;
    }
    const Json& report = rows()[i].at("report");
    EXPECT_EQ(std::stod(cells[column("topology.triangles")]), report.at("topology").at("triangles"));
    EXPECT_NEAR(std::stod(cells[column("cloud_to_mesh.rms")]), report.at("cloud_to_mesh").at("rms"), 1e-9);
    EXPECT_NEAR(std::stod(cells[column("seconds.total")]), rows()[i].at("seconds").at("total"), 1e-6);
  }
}

TEST_F(CompareAll, TablesSayTheSame) {
  const std::string markdown = readFile(output() / "report.md");
  const std::string page = readFile(output() / "report.html");
  for (const Json& row : rows()) {
    const std::string label = row.at("label");
    const std::string triangles =
        row.at("report").is_null()
            ? "not organised"
            : withCommas(row.at("report").at("topology").at("triangles").get<std::size_t>());
    EXPECT_GE(countOf(markdown, "| " + label + " |"), 1U) << label;
    EXPECT_NE(markdown.find(triangles), std::string::npos) << label;
    EXPECT_NE(page.find(label), std::string::npos) << label;
    EXPECT_NE(page.find(triangles), std::string::npos) << label;
  }
}

TEST_F(CompareAll, PageNeedsNothingElse) {
  const std::string page = readFile(output() / "report.html");
  // Twelve meshes of three pictures, and the cloud.
  EXPECT_EQ(countOf(page, "src=\"data:image/jpeg;base64,"), 37U);
  EXPECT_EQ(countOf(page, "src="), 37U);
  EXPECT_EQ(countOf(page, "<link"), 0U);
  EXPECT_EQ(countOf(page, "http"), 0U);
  EXPECT_EQ(countOf(page, "url("), 0U);
  EXPECT_EQ(countOf(page, "@import"), 0U);
  EXPECT_EQ(countOf(page, "<table"), 3U);
  EXPECT_EQ(countOf(page, "<section"), countOf(page, "</section>"));
  EXPECT_EQ(countOf(page, "<figure>"), countOf(page, "</figure>"));
  EXPECT_EQ(countOf(page, "<svg"), countOf(page, "</svg>"));
  EXPECT_EQ(page.find("torus <1>"), std::string::npos) << "names are not markup";
  EXPECT_LT(page.size(), std::size_t{10} << 20);
}

TEST_F(CompareAll, LeavesItsFilesAndNothingElse) {
  const std::set<std::string> files = filesBelow(output());
  EXPECT_EQ(files.size(), 4U + 2U * 12U);
  for (const char* name :
       {"results.json", "results.csv", "report.md", "report.html", "meshes/torus__1_/level-2.ply",
        "meshes/torus__1_/hoppe.ply", "meshes/torus__1_/hoppe.vtk"})
    EXPECT_EQ(files.count(name), 1U) << name;
}

}  // namespace
}  // namespace mlsmesh::test
