// SPDX-License-Identifier: BSD-3-Clause
#include "program.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

namespace mlsmesh::test {
namespace {

constexpr const char* kTetrahedron =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 3\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n";

bool dropDisplay() {
  return unsetenv("DISPLAY") == 0;
}

Outcome runView(const std::vector<std::string>& arguments,
                const std::function<bool()>& prepare = dropDisplay) {
  const TemporaryFolder prints;
  return Program(MLSMESH_VIEW, arguments, prints.path(), prepare).wait();
}

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

void expectOneLine(const Outcome& outcome, int exit_code, const std::string& culprit) {
  EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
  EXPECT_EQ(outcome.err.rfind("mlsmesh_view: ", 0), 0U) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_NE(outcome.err.find(culprit), std::string::npos) << outcome.err;
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
  std::string damaged_text = kTetrahedron;
  damaged_text.replace(damaged_text.rfind("3 0 3 2"), 7, "3 0 9 2");
  const std::string damaged = folder.write("damaged.ply", damaged_text);
  const std::string picture = folder.file("picture.png");
  expectOneLine(runView({}), 2, "file");
  expectOneLine(runView({folder.file("absent.ply"), "--screenshot", picture}), 1, "absent.ply");
  expectOneLine(runView({damaged, "--screenshot", picture}), 1, "damaged.ply");
  expectOneLine(runView({mesh, "--screenshot", folder.file("picture.jpg")}), 2, "--screenshot");
  expectOneLine(runView({mesh, "--screenshot", picture, "--size", "0x5"}), 2, "--size");
  expectOneLine(runView({mesh, "--screenshot", picture, "--view", "inside"}), 2, "--view");
  expectOneLine(runView({mesh, "--screenshot", picture, "--up", "w"}), 2, "--up");
  EXPECT_EQ(folder.names().size(), 2U);
}

}  // namespace
}  // namespace mlsmesh::test
