// SPDX-License-Identifier: BSD-3-Clause
#include "program.h"
#include "sphere_files.h"

#include "shapes/scan.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace mlsmesh::test {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

Outcome runCompare(const std::vector<std::string>& arguments,
                   const std::function<bool()>& prepare = nullptr) {
  const TemporaryFolder prints;
  return Program(MLSMESH_COMPARE, arguments, prints.path(), prepare).wait();
}

std::string xyzText(const std::string& shape, std::size_t count) {
  shapes::ScanOptions options;
  options.count = count;
  std::ostringstream text;
  for (const shapes::Vec3& p : shapes::scan(*shapes::makeShape(shape), options).points)
    text << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
  return text.str();
}

/// A bowl as a range camera sees it, with a column that it does not.
std::string organizedPcd(int width, int height) {
  std::ostringstream text;
  text << "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " << width
       << "\nHEIGHT " << height << "\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " << width * height << "\nDATA ascii\n";
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      const double x = 0.02 * (column - width / 2), y = 0.02 * (row - height / 2);
      if (column == width / 2)
        text << "nan nan nan\n";
      else
        text << x << ' ' << y << ' ' << 1 + x * x + y * y << '\n';
    }
  }
  return text.str();
}

Json readJson(const fs::path& file) {
  return Json::parse(readFile(file));
}

/// The row of a method on the only cloud.
Json rowOf(const Json& results, const std::string& method) {
  for (const Json& row : results.at("clouds").at(0).at("rows"))
    if (row.at("method") == method) return row;
  return {};
}

std::set<std::string> filesBelow(const fs::path& folder) {
  std::set<std::string> files;
  if (!fs::exists(folder)) return files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (!entry.is_directory()) files.insert(fs::relative(entry.path(), folder).string());
  return files;
}

/// Processes with that text in their command line.
int processesAbout(const std::string& text) {
  int count = 0;
  for (const auto& entry : fs::directory_iterator("/proc"))
    count += readFile(entry.path() / "cmdline").find(text) != std::string::npos ? 1 : 0;
  return count;
}

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

void expectOneLine(const Outcome& outcome, int exit_code, const std::string& culprit) {
  EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
  EXPECT_EQ(outcome.err.rfind("mlsmesh_compare: ", 0), 0U) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_NE(outcome.err.find(culprit), std::string::npos) << outcome.err;
}

/// The report of mlsmesh_inspect.
Json inspected(const fs::path& mesh, std::vector<std::string> arguments) {
  const TemporaryFolder prints;
  const std::string json = prints.file("report.json");
  arguments.insert(arguments.end(), {mesh.string(), "--json", json, "--quiet"});
  const Outcome outcome = Program(MLSMESH_INSPECT, arguments, prints.path()).wait();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return readJson(json);
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
            : std::to_string(row.at("report").at("topology").at("triangles").get<int>());
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

TEST(Compare, DistancesFromTheTruthAreMeasuredWhereThereIsOne) {
  const TemporaryFolder folder;
  const std::string cloud = folder.write("torus.xyz", xyzText("torus", 600));
  const std::string other = folder.write("sphere.xyz", sphereXyz(400));
  const std::string truth = folder.file("truth.ply"), output = folder.file("out");
  const TemporaryFolder prints;
  ASSERT_EQ(Program(MLSMESH_RECONSTRUCT, {cloud, truth, "--no-reduction"}, prints.path()).wait().exit_code,
            0);
  const Outcome outcome = runCompare(
      {cloud, other, "--truth", truth, "--truth", "none", "--methods", "level-1", "--output", output});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json results = readJson(output + "/results.json");
  const Json row = rowOf(results, "level-1");
  const Json expected =
      inspected(output + "/" + row.at("mesh").get<std::string>(), {"--cloud", cloud, "--truth", truth});
  for (const char* group : {"truth", "mesh_to_truth", "truth_to_mesh"})
    EXPECT_EQ(row.at("report").at(group), expected.at(group)) << group;
  EXPECT_FALSE(results.at("clouds").at(1).at("rows").at(0).at("report").contains("truth"));
  EXPECT_NE(linesOf(readFile(output + "/results.csv"))[0].find("truth.hausdorff"), std::string::npos);
  const std::string page = readFile(output + "/report.html");
  EXPECT_NE(page.find("truth mean"), std::string::npos);
  EXPECT_EQ(countOf(page, "src=\"data:image/jpeg;base64,"), 2U + 3U + 1U + 3U);
}

TEST(Compare, OrganisedCloudsAreMeshedAsSuch) {
  const TemporaryFolder folder;
  const std::string cloud = folder.write("bowl.pcd", organizedPcd(31, 20));
  const std::string output = folder.file("out");
  const Outcome outcome = runCompare(
      {cloud, "--methods", "organized,level-0", "--view", "sensor", "--output", output, "--quiet"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out + outcome.err, "");
  const Json results = readJson(output + "/results.json");
  EXPECT_EQ(results.at("clouds").at(0).at("height"), 20);
  EXPECT_EQ(results.at("clouds").at(0).at("finite"), 30 * 20);
  EXPECT_EQ(results.at("clouds").at(0).at("rows").at(0).at("method"), "level-0");
  const Json topology = rowOf(results, "organized").at("report").at("topology");
  // 14 and 14 columns of 19 squares, kept apart by the column that was not seen.
  EXPECT_EQ(topology.at("triangles"), 2 * 14 * 19 + 2 * 14 * 19);
  EXPECT_EQ(topology.at("components"), 2);
  EXPECT_EQ(topology.at("isolated_vertices"), 0);
}

TEST(Compare, FaultsAreRowsAndNotTheEnd) {
  const TemporaryFolder folder;
  const std::string cloud = folder.write("sphere.xyz", sphereXyz(400));
  const std::string output = folder.file("out");
  const Outcome outcome =
      runCompare({cloud, "--methods", "fault-crash,fault-hang,fault-memory,fault-error,fault-empty,level-0",
                  "--limit", "2", "--memory", "600", "--no-pictures", "--output", output});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json results = readJson(output + "/results.json");
  const auto expectRow = [&](const char* method, const char* status, const std::string& reason) {
    const Json row = rowOf(results, method);
    EXPECT_EQ(row.at("status"), status) << row.at("reason");
    EXPECT_NE(row.at("reason").get<std::string>().find(reason), std::string::npos) << row.at("reason");
    EXPECT_TRUE(row.at("mesh").is_null());
    EXPECT_NE(outcome.out.find(method), std::string::npos);
  };
  expectRow("fault-crash", "crashed", "signal 11");
  expectRow("fault-hang", "over_time", "2 s");
  expectRow("fault-memory", "over_memory", "600 MB");
  expectRow("fault-error", "failed", "asked to fail");
  expectRow("fault-empty", "empty", "");
  EXPECT_EQ(rowOf(results, "level-0").at("status"), "done");
  const double seconds = rowOf(results, "fault-hang").at("process").at("wall");
  EXPECT_TRUE(seconds >= 2 && seconds < 4) << seconds;
  EXPECT_NE(readFile(output + "/report.html").find("No pictures"), std::string::npos);
}

TEST(Compare, RbfRefusesWhatItCannotSolve) {
  const TemporaryFolder folder;
  const std::string cloud = folder.write("sphere.xyz", sphereXyz(3000));
  const std::string output = folder.file("out");
  ASSERT_EQ(runCompare({cloud, "--methods", "rbf", "--no-pictures", "--output", output}).exit_code, 0);
  const Json row = rowOf(readJson(output + "/results.json"), "rbf");
  EXPECT_EQ(row.at("status"), "refused");
  EXPECT_NE(row.at("reason").get<std::string>().find("2500"), std::string::npos);
}

TEST(Compare, DoublesFarFromTheOriginComeBackThere) {
  const TemporaryFolder folder;
  const std::array<double, 3> center = {4.5e6, 5.2e6, 100};
  const std::string cloud = folder.write("utm.ply", sphereDoublePly(1500, 1, center));
  const std::string output = folder.file("out");
  ASSERT_EQ(runCompare({cloud, "--methods", "level-1,gp3", "--output", output}).exit_code, 0);
  for (const char* method : {"level-1", "gp3"}) {
    const Json row = rowOf(readJson(output + "/results.json"), method);
    ASSERT_EQ(row.at("status"), "done") << row.at("reason");
    EXPECT_LT(row.at("report").at("cloud_to_mesh").at("p95_spacings"), 1.0) << method;
  }
}

TEST(Compare, OldFilesStayUnlessAllNewOnesAreInPlace) {
  const TemporaryFolder folder;
  const std::string cloud = folder.write("sphere.xyz", sphereXyz(500));
  const std::string output = folder.file("out");
  fs::create_directories(folder.path() / "out" / "results.json");  // in the way of one of the last
  folder.write("out/report.html", "old");
  const Outcome outcome =
      runCompare({cloud, "--methods", "level-0", "--no-pictures", "--truth", "none", "--output", output});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.err.find("results.json"), std::string::npos) << outcome.err;
  EXPECT_EQ(readFile(output + "/report.html"), "old");
  fs::remove(output + "/report.html");
  fs::remove(output + "/results.json");
  for (const auto& entry : fs::recursive_directory_iterator(output))
    EXPECT_TRUE(entry.is_directory()) << entry.path() << " was left";
}

TEST(Compare, SeveralCloudsShareOnePage) {
  const TemporaryFolder folder;
  fs::create_directory(folder.path() / "other");
  const std::string first = folder.write("sphere.xyz", sphereXyz(500));
  const std::string second = folder.write("other/sphere.xyz", sphereXyz(900));
  const std::string output = folder.file("out");
  const Outcome outcome = runCompare({first, second, "--truth", "none", "--truth", "none", "--methods",
                                      "level-0,gp3", "--no-pictures", "--output", output});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json clouds = readJson(output + "/results.json").at("clouds");
  ASSERT_EQ(clouds.size(), 2U);
  EXPECT_EQ(clouds[0].at("name"), "sphere");
  EXPECT_EQ(clouds[1].at("name"), "sphere_2");
  EXPECT_NE(readFile(output + "/report.html").find("Time against points"), std::string::npos);
}

TEST(Compare, AnotherRunReplacesWhatItMakesAnew) {
  const TemporaryFolder folder;
  const std::string cloud = folder.write("sphere.xyz", sphereXyz(400));
  const std::string output = folder.file("out");
  ASSERT_EQ(runCompare({cloud, "--methods", "level-0,gp3", "--no-pictures", "--output", output}).exit_code,
            0);
  folder.write("out/notes.txt", "mine");
  folder.write("sphere.xyz", "0 0 0\n1 0 0\n2 0 0\n3 0 0\n");  // on a line: no method makes a face of it
  ASSERT_EQ(runCompare({cloud, "--methods", "level-0", "--no-pictures", "--output", output}).exit_code, 0);
  const std::set<std::string> files = filesBelow(output);
  EXPECT_EQ(files.count("notes.txt"), 1U);
  EXPECT_EQ(files.count("meshes/sphere/gp3.ply"), 1U);
  EXPECT_EQ(files.count("meshes/sphere/level-0.ply") + files.count("meshes/sphere/level-0.vtk"), 0U)
      << "no mesh of another run beside a row without";
}

TEST(Compare, SaysWhyThereAreNoPictures) {
  const TemporaryFolder folder;
  const std::string cloud = folder.write("sphere.xyz", sphereXyz(400));
  const std::string output = folder.file("out");
  const auto prepare = [] { return unsetenv("DISPLAY") == 0 && setenv("PATH", "/nowhere", 1) == 0; };
  const Outcome outcome = runCompare({cloud, "--methods", "level-0", "--output", output, "--quiet"}, prepare);
  expectOneLine(outcome, 0, "xvfb");
  EXPECT_EQ(filesBelow(output).size(), 6U);
}

TEST(Compare, InterruptKillsWhatRunsAndLeavesNothing) {
  const TemporaryFolder folder, prints;
  const std::string cloud = folder.write("sphere.xyz", sphereXyz(400));
  Program program(MLSMESH_COMPARE,
                  {cloud, "--methods", "level-0,fault-hang", "--no-pictures", "--output", folder.file("out")},
                  prints.path());
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (readFile(prints.path() / "stdout.txt").find("level-0") == std::string::npos &&
         std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  EXPECT_EQ(processesAbout(folder.path().string()), 2) << "the program, and the worker that hangs";
  kill(program.id(), SIGINT);
  const Outcome outcome = program.wait();
  expectOneLine(outcome, 130, "interrupted");
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"sphere.xyz"}));
  EXPECT_EQ(processesAbout(folder.path().string()), 0) << "a worker still runs";
}

TEST(Compare, NamesWhatIsWrong) {
  const TemporaryFolder folder;
  const std::string cloud = folder.write("sphere.xyz", sphereXyz(400));
  const std::string output = folder.file("out");
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {cloud, "--output", output});
    return runCompare(more);
  };
  expectOneLine(runCompare({}), 2, "cloud");
  expectOneLine(runCompare({cloud}), 2, "--output");
  expectOneLine(with({"--methods", "poison-8"}), 2, "poisson-8");
  expectOneLine(with({"--methods", "nothing-like-it"}), 2, "gp3-oriented");
  expectOneLine(with({"--methods", ","}), 2, "--methods");
  expectOneLine(with({"--limit", "0"}), 2, "--limit");
  expectOneLine(with({"--limit", "soon"}), 2, "--limit");
  expectOneLine(with({"--memory", "1"}), 2, "--memory");
  expectOneLine(with({"--threads", "1.5"}), 2, "--threads");
  expectOneLine(with({"--view", "inside"}), 2, "--view");
  expectOneLine(with({"--up", "w"}), 2, "--up");
  expectOneLine(with({"--truth", "a.ply", "--truth", "b.ply"}), 2, "--truth");
  expectOneLine(with({"--truth", "a.txt"}), 2, "a.txt");
  expectOneLine(with({"--colour"}), 2, "colour");
  expectOneLine(with({"--truth", folder.file("absent.ply")}), 1, "absent.ply");
  expectOneLine(with({"--truth", folder.write("points.obj", "v 0 0 0\n")}), 1, "no faces");
  expectOneLine(runCompare({folder.file("absent.pcd"), "--output", output}), 1, "absent.pcd");
  expectOneLine(runCompare({folder.write("nan.xyz", "nan nan nan\n"), "--output", output}), 1, "nan.xyz");
  expectOneLine(runCompare({cloud, "--output", cloud}), 1, "not a folder");
  expectOneLine(runCompare({folder.file("\xff.xyz"), "--output", output}), 2, "UTF-8");
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"nan.xyz", "points.obj", "sphere.xyz"}));
}

TEST(Compare, ExplainsItself) {
  const Outcome help = runCompare({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  const std::string page = readFile(MLSMESH_SOURCE_DIR "/docs/compare.md");
  for (const char* name :
       {"level-0", "no-reduction", "gp3-oriented", "mls-gp3", "poisson-9", "hoppe", "rbf", "grid-projection",
        "organized", "--limit", "--memory", "--truth", "--threads", "--view", "--no-pictures"}) {
    EXPECT_NE(help.out.find(name), std::string::npos) << name;
    EXPECT_NE(page.find(name), std::string::npos) << name;
  }
  EXPECT_EQ(help.out.find("fault-"), std::string::npos);
  EXPECT_EQ(runCompare({"--version"}).out.rfind("mlsmesh_compare ", 0), 0U);
}

}  // namespace
}  // namespace mlsmesh::test
