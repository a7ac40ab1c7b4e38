// SPDX-License-Identifier: BSD-3-Clause
#include "view_fixture.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace mlsmesh::test {
namespace {

bool isInPath(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::string folders = path != nullptr ? path : "";
  for (std::size_t end = 0; !folders.empty(); folders.erase(0, std::min(end, folders.size() - 1) + 1)) {
    end = std::min(folders.find(':'), folders.size());
    if (access((folders.substr(0, end) + "/" + program).c_str(), X_OK) == 0) return true;
  }
  return false;
}

/// Width and height that the header of a PNG file names, big-endian at bytes 16 and 20.
std::vector<int> sizeOfPng(const std::string& content) {
  std::vector<int> size;
  for (const std::size_t at : {16U, 20U}) {
    int value = 0;
    for (std::size_t i = at; i < at + 4; ++i) value = value * 256 + static_cast<unsigned char>(content.at(i));
    size.push_back(value);
  }
  return size;
}

TEST(View, DrawsWithoutADisplay) {
  ASSERT_TRUE(isInPath("Xvfb")) << "install the packages of scripts/packages.txt";
  const TemporaryFolder folder;
  const std::string mesh = folder.write("mesh.ply", kTetrahedron);
  const std::string cloud = folder.write("cloud.xyz", "0 0 0\n1 0 0\n0 1 0\n0 0 1\n");
  const std::string picture = folder.file("picture.png");
  const Outcome outcome =
      runView({mesh, cloud, "--screenshot", picture, "--size", "320x200", "--edges", "--borders"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(sizeOfPng(readFile(picture)), (std::vector<int>{320, 200}));
  const std::string empty = folder.file("flat.png");
  ASSERT_EQ(runView({cloud, cloud, "--screenshot", empty, "--size", "320x200", "--no-labels"}).exit_code, 0);
  EXPECT_NE(readFile(picture), readFile(empty));
}

TEST(View, SaysWhatToInstallWhereNothingCanDraw) {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("mesh.ply", kTetrahedron);
  const auto prepare = [] { return dropDisplay() && setenv("PATH", "/nowhere", 1) == 0; };
  expectOneLine(runView({mesh, "--screenshot", folder.file("picture.png")}, prepare), 1, "xvfb");
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"mesh.ply"}));
}

TEST(View, NeedsADisplayForAWindow) {
  const TemporaryFolder folder;
  expectOneLine(runView({folder.write("mesh.ply", kTetrahedron)}), 1, "--screenshot");
}

TEST(View, NamesWhatIsWrong) {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("mesh.ply", kTetrahedron);
  const std::string picture = folder.file("picture.png");
  expectOneLine(runView({}), 2, "file");
  expectOneLine(runView({folder.file("absent.ply"), "--screenshot", picture}), 1, "absent.ply");
  expectOneLine(runView({mesh, "--screenshot", folder.file("picture.jpg")}), 2, "--screenshot");
  expectOneLine(runView({mesh, "--screenshot", picture, "--size", "0x5"}), 2, "--size");
  expectOneLine(runView({mesh, "--screenshot", picture, "--view", "inside"}), 2, "--view");
  expectOneLine(runView({mesh, "--screenshot", picture, "--up", "w"}), 2, "--up");
  expectOneLine(runView({mesh, "--screenshot", picture, "--show", "inside"}), 2, "--show");
  expectOneLine(runView({mesh, "--screenshot", picture, "--level", "3"}), 2, "--level");
  expectOneLine(runView({mesh, "--screenshot", picture, "--scale", "0"}), 2, "--scale");
  expectOneLine(runView({mesh, "--script", "b,z"}), 2, "'z' is no key");
  expectOneLine(runView({mesh, "--script", "b=picture.png"}), 2, "p=FILE");
  expectOneLine(runView({mesh, "--script", "p=picture.jpg"}), 2, "--script");
  expectOneLine(runView({mesh, "--script", "p=" + folder.file("absent/picture.png")}), 1, "absent");
  expectOneLine(runView({mesh, "--cloud", folder.file("absent.xyz"), "--screenshot", picture}), 1,
                "absent.xyz");
  expectOneLine(runView({mesh, "--screenshot", picture, "--clustering.max_size", "-1"}), 2,
                "clustering.max_size");
  expectOneLine(runView({mesh, "--screenshot", picture, "--config", folder.file("absent.cfg")}), 2,
                "absent.cfg");
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"mesh.ply"}));
}

TEST(View, LeavesOutFacesThatNameAbsentVertices) {
  const TemporaryFolder folder;
  std::string text = kTetrahedron;
  text.replace(text.rfind("3 0 3 2"), 7, "3 0 9 2");
  const Outcome outcome =
      runView({folder.write("damaged.ply", text), "--screenshot", folder.file("picture.png")});
  expectOneLine(outcome, 0, "damaged.ply: 1 faces are not drawn");
  EXPECT_EQ(folder.names().size(), 2U);
}

TEST(View, SaysWhyACloudHasNoMesh) {
  const TemporaryFolder folder;
  const std::string line = folder.write("line.xyz", "0 0 0\n1 0 0\n2 0 0\n3 0 0\n");
  expectOneLine(runView({line, "--show", "mesh", "--screenshot", folder.file("picture.png")}), 1,
                "line.xyz: ");
  EXPECT_EQ(folder.names().size(), 1U);
}

TEST(View, ShowsEachModeInAPictureOfItsOwn) {
  const TemporaryFolder folder;
  const std::string cloud = folder.write("band.xyz", bandText());
  std::set<std::string> pictures;
  for (const char* mode :
       {"cloud", "clusters", "representatives", "mesh", "borders", "defects", "distance"}) {
    const std::string picture = folder.file(std::string(mode) + ".png");
    const Outcome outcome = runView({cloud, "--show", mode, "--level", "1", "--size", "240x240", "--threads",
                                     "1", "--screenshot", picture});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    EXPECT_TRUE(pictures.insert(readFile(picture)).second) << mode;
  }
}

/// The keys that --help lists, the first name of each.
std::vector<std::string> keysOfHelp() {
  std::istringstream help(runView({"--help"}).out);
  std::vector<std::string> keys;
  bool is_key = false;
  for (std::string line; std::getline(help, line);) {
    if (is_key) keys.push_back(line.substr(2, line.find_first_of(" ,", 2) - 2));
    is_key = is_key || line == "Keys:";
  }
  return keys;
}

/// In an order in which each key changes the picture of two files, the second a mesh with a defect.
std::vector<std::string> keysInOrder() {
  return {"1", "plus", "minus", "2", "3", "5", "Down", "Up", "x",     "r",    "6", "7", "4",
          "g", "f",    "g",     "w", "s", "v", "o",    "l",  "Right", "Left", "a", "h"};
}

/// A script that presses the keys, each followed by a picture into the folder.
std::string photographed(const std::vector<std::string>& keys, const TemporaryFolder& folder) {
  std::string script = "wait,p=" + folder.file("0.png");
  for (std::size_t i = 0; i < keys.size(); ++i)
    script += "," + keys[i] + ",p=" + folder.file(std::to_string(i + 1) + ".png");
  return script + ",q";
}

TEST(View, EveryKeyDoesSomething) {
  const TemporaryFolder folder, pictures;
  const std::string cloud = folder.write("band.xyz", bandText());
  const std::string mesh = folder.write("mesh.ply", kTetrahedron);
  const std::vector<std::string> keys = keysInOrder();
  const Outcome outcome = runView({cloud, mesh, "--show", "mesh", "--size", "400x200", "--threads", "1",
                                   "--script", photographed(keys, pictures)});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    EXPECT_NE(readFile(pictures.file(std::to_string(i) + ".png")),
              readFile(pictures.file(std::to_string(i + 1) + ".png")))
        << keys[i];
  }
  std::set<std::string> pressed(keys.begin(), keys.end());
  pressed.insert({"p", "q", "Escape"});
  const std::vector<std::string> listed = keysOfHelp();
  EXPECT_EQ(pressed, std::set<std::string>(listed.begin(), listed.end()));
}

/// The options that --help lists, one a line: "  --name ..." or "  -h [ --help ]".
std::vector<std::string> optionsOfHelp() {
  std::istringstream help(runView({"--help"}).out);
  std::vector<std::string> options;
  for (std::string line; std::getline(help, line);)
    if (line.rfind("  --", 0) == 0) options.push_back(line.substr(2, line.find(' ', 2) - 2));
  return options;
}

TEST(View, ThePageNamesEveryKeyAndOption) {
  const std::string page = readFile(MLSMESH_SOURCE_DIR "/docs/view.md");
  const std::vector<std::string> keys = keysOfHelp();
  EXPECT_GE(keys.size(), 25U);
  for (const std::string& key : keys) EXPECT_NE(page.find("`" + key + "`"), std::string::npos) << key;
  const std::vector<std::string> options = optionsOfHelp();
  EXPECT_GE(options.size(), 20U);
  for (const std::string& option : options)
    EXPECT_TRUE(option == "--version" || page.find("`" + option) != std::string::npos) << option;
}

TEST(View, PressesKeysAlsoForPictures) {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("mesh.ply", kTetrahedron);
  const std::string plain = folder.file("plain.png"), borders = folder.file("borders.png");
  ASSERT_EQ(runView({mesh, "--size", "200x200", "--show", "borders", "--screenshot", plain}).exit_code, 0);
  ASSERT_EQ(runView({mesh, "--size", "200x200", "--script", "b", "--screenshot", borders}).exit_code, 0);
  EXPECT_EQ(readFile(plain), readFile(borders));
}

TEST(View, EscapeEndsAReconstructionAndTheWindowStays) {
  const TemporaryFolder folder;
  const std::string cloud = folder.write("band.xyz", bandText());
  const std::string before = folder.file("before.png"), after = folder.file("after.png");
  const Outcome outcome = runView({cloud, "--levels", "6", "--refinement.threshold", "0", "--size", "200x200",
                                   "--script", "p=" + before + ",Escape,wait,p=" + after + ",m,Escape,wait"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_NE(readFile(before), readFile(after));
}

TEST(View, ANoticeIsNotInTheWayOfTheCloud) {
  const TemporaryFolder folder;
  const std::string line = folder.write("line.xyz", "0 0 0\n1 0 0\n2 0 0\n3 0 0\n");
  const std::string plain = folder.file("plain.png"), failed = folder.file("failed.png"),
                    cloud = folder.file("cloud.png");
  ASSERT_EQ(runView({line, "--size", "200x200", "--show", "cloud", "--script", "p=" + plain}).exit_code, 0);
  ASSERT_EQ(runView({line, "--size", "200x200", "--script", "wait,p=" + failed + ",c,p=" + cloud}).exit_code,
            0);
  EXPECT_NE(readFile(failed), readFile(plain)) << "it says why there is no mesh";
  EXPECT_EQ(readFile(cloud), readFile(plain));
}

TEST(View, WhatWasEndedIsFoundWhenAskedForAgain) {
  const TemporaryFolder folder;
  const std::string cloud = folder.write("band.xyz", bandText());
  for (const std::string mode : {"defects", "distance"}) {
    const std::string key = mode == "defects" ? "d" : "t";
    const std::string direct = folder.file("direct.png"), again = folder.file("again.png");
    const std::vector<std::string> options = {cloud, "--levels", "4", "--size", "200x200"};
    std::vector<std::string> arguments = options;
    arguments.insert(arguments.end(), {"--show", mode, "--screenshot", direct});
    ASSERT_EQ(runView(arguments).exit_code, 0);
    arguments = options;
    arguments.insert(arguments.end(), {"--show", "mesh", "--screenshot", again, "--script",
                                       "wait," + key + ",Escape,wait,Down,Up," + key});
    const Outcome outcome = runView(arguments);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    EXPECT_EQ(readFile(direct), readFile(again)) << mode;
  }
}

TEST(View, KeysWaitForDefectsAndDistances) {
  const TemporaryFolder folder;
  const std::string cloud = folder.write("band.xyz", bandText());
  for (const std::string mode : {"defects", "distance"}) {
    const std::string key = mode == "defects" ? "6" : "7";
    const std::string at_once = folder.file("at_once.png"), waited = folder.file("waited.png");
    const Outcome outcome = runView({cloud, "--levels", "4", "--size", "200x200", "--show", "mesh",
                                     "--script", "wait," + key + ",p=" + at_once + ",wait,p=" + waited});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(readFile(at_once), readFile(waited)) << mode;
  }
}

}  // namespace
}  // namespace mlsmesh::test
