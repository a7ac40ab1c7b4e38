// SPDX-License-Identifier: BSD-3-Clause
#include "view_fixture.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

namespace mlsmesh::test {
namespace {

namespace fs = std::filesystem;

/// A picture of a cloud and a mesh with these options.
class ViewConfig : public testing::Test {
 protected:
  std::string picture(const std::vector<std::string>& options) const {
    std::vector<std::string> arguments = {cloud_, mesh_, "--threads", "1", "--screenshot", picture_};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = runView(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    return readFile(picture_);
  }

  void expectError(const std::string& content, const std::string& place, const std::string& remedy) const {
    const std::string config = folder_.write("view.cfg", content);
    const Outcome outcome = runView({mesh_, "--screenshot", folder_.file("none.png"), "--config", config});
    expectOneLine(outcome, 2, "view.cfg:" + place);
    EXPECT_NE(outcome.err.find(remedy), std::string::npos) << outcome.err;
  }

  TemporaryFolder folder_;
  std::string cloud_ = folder_.write("band.xyz", bandText());
  std::string mesh_ = folder_.write("mesh.ply", kTetrahedron);
  std::string picture_ = folder_.file("picture.png");
};

/// The lines of a config file as options of the command line.
std::vector<std::string> asOptions(const fs::path& file) {
  std::istringstream content(readFile(file));
  std::vector<std::string> options;
  for (std::string line; std::getline(content, line);) {
    const std::size_t equals = line.find(" = ");
    if (line.rfind("#", 0) == 0 || equals == std::string::npos) continue;
    options.push_back("--" + line.substr(0, equals) + "=" + line.substr(equals + 3));
  }
  return options;
}

TEST_F(ViewConfig, EveryLaunchConfigShowsWhatItsLinesSay) {
  const std::string plain = picture({"--size", "240x160"});
  for (const auto& entry : fs::directory_iterator(MLSMESH_SOURCE_DIR "/launch_configs/view")) {
    SCOPED_TRACE(entry.path().filename().string());
    std::vector<std::string> options;
    for (const std::string& option : asOptions(entry.path()))
      if (option.rfind("--size=", 0) != 0) options.push_back(option);
    ASSERT_FALSE(options.empty());
    options.push_back("--size=240x160");
    const std::string shown = picture({"--config", entry.path().string(), "--size", "240x160"});
    EXPECT_EQ(shown, picture(options));
    EXPECT_NE(shown, plain);
  }
}

TEST_F(ViewConfig, EveryDisplayOptionCanBeInAFile) {
  const std::vector<std::string> lines = {
      "show = borders", "level = 0",     "size = 240x160",    "view = back",
      "up = z",         "zoom = 1.5",    "flat = on",         "edges = true",
      "borders = yes",  "no-labels = 1", "wireframe = false", "levels = 1"};
  std::string content;
  for (const std::string& line : lines) content += line + "\n";
  const std::string config = folder_.write("view.cfg", content);
  EXPECT_EQ(picture({"--config", config}), picture(asOptions(config)));
  const std::string distance = folder_.write("distance.cfg", "show = distance\nscale = 3\nsize = 240x160\n");
  EXPECT_EQ(picture({"--config", distance}), picture(asOptions(distance)));
}

TEST_F(ViewConfig, CommandLineWins) {
  const std::string config =
      folder_.write("view.cfg", "show = cloud\nsize = 100x100\nedges = true\nno-labels = true\n");
  EXPECT_EQ(picture({"--config", config, "--show", "borders", "--size", "240x160", "--edges=false",
                     "--no-labels=false"}),
            picture({"--show", "borders", "--size", "240x160"}));
}

TEST_F(ViewConfig, AnOptionThatIsOnTakesNoFileForItsValue) {
  const auto shown = [&](const std::vector<std::string>& arguments) {
    const Outcome outcome = runView(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return readFile(picture_);
  };
  const std::string expected =
      shown({mesh_, "--screenshot", picture_, "--size", "200x200", "--edges=true", "--flat=true"});
  EXPECT_EQ(shown({"--size", "200x200", "--screenshot", picture_, "--flat", "-edges", mesh_}), expected);
}

TEST_F(ViewConfig, NamesFileLineAndRemedy) {
  expectError("levels = 1\nshwo = mesh\n", "2", "did you mean 'show'?");
  expectError("quite_another_thing = 1\n", "1", "wireframe");
  expectError("show = inside\n", "1: show", "representatives");
  expectError("\nedges = perhaps\n", "2: edges", "true or false");
  expectError("size = big\n", "1: size", "1600x800");
  expectError("zoom = 0\n", "1: zoom", "0.01 .. 100");
  expectError("scale = x\n", "1: scale", "number");
  expectError("level = 3\n", "1: level", "0 .. 2");
  expectError("view = inside\n", "1: view", "front");
  expectError("up = w\n", "1: up", "x, y, z");
  expectError("edges = true\nedges = false\n", "2", "twice");
  expectError("screenshot = picture.png\n", "1", "unknown name");
  expectError("clustering.max_size = -1\n", "1", "clustering.max_size");
  EXPECT_EQ(folder_.names(), (std::vector<std::string>{"band.xyz", "mesh.ply", "view.cfg"}));
}

}  // namespace
}  // namespace mlsmesh::test
