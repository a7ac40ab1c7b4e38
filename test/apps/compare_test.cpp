// SPDX-License-Identifier: BSD-3-Clause
#include "compare_fixture.h"
#include "sphere_files.h"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace mlsmesh::test {
namespace {

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

/// Processes with that text in their command line.
int processesAbout(const std::string& text) {
  int count = 0;
  for (const auto& entry : fs::directory_iterator("/proc"))
    count += readFile(entry.path() / "cmdline").find(text) != std::string::npos ? 1 : 0;
  return count;
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
