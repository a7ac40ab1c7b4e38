// SPDX-License-Identifier: BSD-3-Clause
#include "compare_fixture.h"
#include "sphere_files.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace mlsmesh::test {
namespace {

const std::string kLaunchConfigs = MLSMESH_SOURCE_DIR "/launch_configs/compare/";

class CompareConfig : public testing::Test {
 protected:
  /// What results.json says after a comparison without pictures.
  Json compared(std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"--no-pictures", "--output", output_});
    const Outcome outcome = runCompare(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    return readJson(output_ + "/results.json");
  }

  std::string mesh(const std::string& method) const {
    return readFile(output_ + "/meshes/torus/" + method + ".ply");
  }

  void expectError(const std::string& content, const std::string& place, const std::string& remedy) const {
    const std::string config = folder_.write("run.cfg", content);
    const Outcome outcome = runCompare({cloud_, "--output", output_, "--config", config});
    expectOneLine(outcome, 2, "run.cfg" + place);
    EXPECT_NE(outcome.err.find(remedy), std::string::npos) << outcome.err;
  }

  TemporaryFolder folder_;
  std::string cloud_ = folder_.write("torus.xyz", xyzText("torus", 600));
  std::string output_ = folder_.file("out");
};

std::vector<std::string> methodsOf(const Json& results) {
  std::vector<std::string> methods;
  for (const Json& row : results.at("clouds").at(0).at("rows")) methods.push_back(row.at("method"));
  return methods;
}

TEST_F(CompareConfig, EveryLaunchConfigRuns) {
  for (const auto& entry : fs::directory_iterator(kLaunchConfigs)) {
    SCOPED_TRACE(entry.path().filename().string());
    const Json results = compared({cloud_, "--config", entry.path().string()});
    EXPECT_GE(methodsOf(results).size(), 2U);
    for (const Json& row : results.at("clouds").at(0).at("rows")) {
      const bool needs_order = row.at("method") == "organized";
      EXPECT_EQ(row.at("status"), needs_order ? "refused" : "done") << row.at("method") << row.at("reason");
    }
  }
}

TEST_F(CompareConfig, Table1HasBothPresets) {
  const Json results = compared({cloud_, "--config", kLaunchConfigs + "table1.cfg"});
  EXPECT_EQ(methodsOf(results),
            (std::vector<std::string>{"level-0", "level-1", "level-2", "paper-0", "paper-1", "paper-2"}));
  EXPECT_EQ(results.at("threads"), 1);
  for (const std::string preset : {"default", "paper"}) {
    for (const std::string level : {"0", "1", "2"}) {
      const std::string mesh = folder_.file("mesh.ply");
      const TemporaryFolder prints;
      ASSERT_EQ(
          Program(MLSMESH_RECONSTRUCT, {cloud_, mesh, "--preset", preset, "--levels", level}, prints.path())
              .wait()
              .exit_code,
          0);
      const Json row = rowOf(results, (preset == "paper" ? "paper-" : "level-") + level);
      EXPECT_EQ(row.at("maker"), "mlsmesh");
      EXPECT_EQ(row.at("report").at("topology"), inspected(mesh, {}).at("topology")) << preset << level;
    }
  }
}

TEST_F(CompareConfig, ParametersAreThoseOfOurMethods) {
  const std::string config = folder_.write("run.cfg", "preset = paper\nmethods = level-2,paper-2,gp3\n");
  const Json by_file = compared({cloud_, "--config", config});
  EXPECT_EQ(mesh("level-2"), mesh("paper-2"));
  EXPECT_EQ(rowOf(by_file, "level-2").at("parameters"), "preset paper, two refinement steps");
  const std::string gp3 = mesh("gp3");
  const Json coarse = compared({cloud_, "--config", config, "--preset", "default", "--clustering.max_size",
                                "40", "--methods", "level-0,level-2,paper-2,gp3"});
  EXPECT_EQ(rowOf(coarse, "level-0").at("parameters"),
            "default parameters, clustering.max_size = 40, no refinement");
  EXPECT_EQ(rowOf(coarse, "paper-2").at("report").at("topology"),
            rowOf(by_file, "paper-2").at("report").at("topology"));
  EXPECT_EQ(mesh("gp3"), gp3);
  const std::string page = readFile(output_ + "/report.html"), markdown = readFile(output_ + "/report.md");
  for (const std::string& text : {page, markdown})
    EXPECT_NE(text.find("default parameters, clustering.max_size = 40, no refinement"), std::string::npos);
  const std::string expected = folder_.file("mesh.ply");
  const TemporaryFolder prints;
  ASSERT_EQ(Program(MLSMESH_RECONSTRUCT, {cloud_, expected, "--clustering.max_size", "40", "--levels", "0"},
                    prints.path())
                .wait()
                .exit_code,
            0);
  EXPECT_EQ(rowOf(coarse, "level-0").at("report").at("topology"), inspected(expected, {}).at("topology"));
}

TEST_F(CompareConfig, CloudsOfAFileAreBesideIt) {
  fs::create_directory(folder_.path() / "data");
  const std::string sphere = folder_.write("data/sphere.xyz", sphereXyz(400));
  const std::string truth = folder_.write("data/truth.obj", "v 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n");
  const std::string config = folder_.write(
      "data/run.cfg",
      "cloud = sphere.xyz\ncloud = ../torus.xyz\ntruth = truth.obj\ntruth = none\nmethods = level-0\n");
  const Json clouds = compared({"--config", config}).at("clouds");
  ASSERT_EQ(clouds.size(), 2U);
  EXPECT_TRUE(fs::equivalent(clouds[0].at("file").get<std::string>(), sphere));
  EXPECT_TRUE(fs::equivalent(clouds[0].at("truth").get<std::string>(), truth));
  EXPECT_TRUE(fs::equivalent(clouds[1].at("file").get<std::string>(), cloud_));
  EXPECT_TRUE(clouds[1].at("truth").is_null());
  const Json other = compared({"--config", config, cloud_}).at("clouds");
  ASSERT_EQ(other.size(), 1U);
  EXPECT_EQ(other[0].at("file"), cloud_);
  EXPECT_TRUE(other[0].at("truth").is_null()) << "the truths of other clouds";
}

TEST_F(CompareConfig, CommandLineWins) {
  const std::string config = folder_.write(
      "run.cfg",
      "methods = gp3,level-0\nlimit = 50\nmemory = 4000\nthreads = 2\nno-pictures = true\nup = z\n");
  const Json by_file = compared({cloud_, "--config", config});
  EXPECT_EQ(methodsOf(by_file), (std::vector<std::string>{"level-0", "gp3"}));
  EXPECT_EQ(by_file.at("limit_seconds"), 50);
  EXPECT_EQ(by_file.at("memory_bytes"), 4000ULL << 20);
  EXPECT_EQ(by_file.at("threads"), 2);
  const Json by_both = compared({cloud_, "--config", config, "--methods", "level-1", "--limit", "40"});
  EXPECT_EQ(methodsOf(by_both), (std::vector<std::string>{"level-1"}));
  EXPECT_EQ(by_both.at("limit_seconds"), 40);
  EXPECT_EQ(by_both.at("threads"), 2);
  // Without the option, whether pictures are drawn is the file's word.
  ASSERT_EQ(runCompare({cloud_, "--config", config, "--methods", "level-0", "--output", output_}).exit_code,
            0);
  EXPECT_EQ(countOf(readFile(output_ + "/report.html"), "<img"), 0U);
  ASSERT_EQ(runCompare({cloud_, "--config", config, "--methods", "level-0", "--no-pictures=false", "--output",
                        output_})
                .exit_code,
            0);
  EXPECT_GT(countOf(readFile(output_ + "/report.html"), "<img"), 0U);
}

TEST_F(CompareConfig, NamesFileLineAndRemedy) {
  expectError("limit = 5\nmethod = gp3\n", ":2", "did you mean 'methods'?");
  expectError("quite_another_thing = 1\n", ":1", "no-pictures");
  expectError("methods = poison-8\n", ":1: methods", "poisson-8");
  expectError("limit = soon\n", ":1: limit", "number");
  expectError("memory = 1\n", ":1: memory", "allowed");
  expectError("\nthreads = 1.5\n", ":2: threads", "whole");
  expectError("view = inside\n", ":1: view", "front");
  expectError("view = top\nview = front\n", ":1: view", "2 times for 1 clouds");
  expectError("up = w\n", ":1: up", "x, y, z");
  expectError("no-pictures = perhaps\n", ":1: no-pictures", "true or false");
  expectError("clustering.max_size = -1\n", ":1", "clustering.max_size");
  expectError("preset = nice\n", ":1", "printed");
  expectError("limit = 5\nlimit = 6\n", ":2", "twice");
  expectError("output = results\n", ":1", "unknown name");
  for (const std::string name : {"levels", "refinement.levels", "reduce", "no-reduction", "all-levels"}) {
    expectError(name + " = 1\n", ":1: " + name, "--methods");
    expectOneLine(runCompare({cloud_, "--output", output_, "--" + name + "=1"}), 2, "--" + name);
  }
  expectOneLine(runCompare({cloud_, "--output", output_, "--config", folder_.file("absent.cfg")}), 2,
                "absent.cfg");
  expectOneLine(
      runCompare({"--output", output_, "--config", folder_.write("run.cfg", "cloud = absent.pcd\n")}), 1,
      "absent.pcd");
  EXPECT_EQ(folder_.names(), (std::vector<std::string>{"run.cfg", "torus.xyz"}));
}

TEST_F(CompareConfig, ThePageNamesEveryNameOfAFile) {
  const std::string page = readFile(MLSMESH_SOURCE_DIR "/docs/compare.md");
  for (const char* name : {"`cloud", "`truth", "`methods", "`limit", "`memory", "`threads", "`view", "`up",
                           "`no-pictures", "`paper-0`", "`--config FILE`", "`--preset NAME`"})
    EXPECT_NE(page.find(name), std::string::npos) << name;
}

}  // namespace
}  // namespace mlsmesh::test
