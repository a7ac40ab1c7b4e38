// SPDX-License-Identifier: BSD-3-Clause
// SIGINT and SIGTERM, sent to every program once it has been seen to read, to compute or to write.
#include "program.h"
#include "sphere_files.h"

#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace mlsmesh::test {
namespace {

namespace fs = std::filesystem;

using Strings = std::vector<std::string>;

/// Until it holds, or the program has ended, or a minute has gone; true in the first case.
bool seen(const Program& program, const std::function<bool()>& holds) {
  const std::string stat = "/proc/" + std::to_string(program.id()) + "/stat";
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (std::chrono::steady_clock::now() < end) {
    if (holds()) return true;
    if (readFile(stat).find(") Z") != std::string::npos) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

bool hasOpen(const Program& program, const std::string& file) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator("/proc/" + std::to_string(program.id()) + "/fd", error)) {
    if (fs::read_symlink(entry.path(), error) == fs::path(file)) return true;
  }
  return false;
}

/// SIGINT is the second bit of the signals that a process catches.
bool catchesSignals(const Program& program) {
  const std::string status = readFile("/proc/" + std::to_string(program.id()) + "/status");
  const std::size_t caught = status.find("SigCgt:");
  return caught != std::string::npos && (std::stoull(status.substr(caught + 7), nullptr, 16) & 2) != 0;
}

/// A temporary output that something has been written to.
bool isWriting(const TemporaryFolder& folder) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder.path(), error)) {
    const bool is_temporary = entry.path().filename().string().rfind(".mlsmesh-", 0) == 0;
    if (is_temporary && fs::file_size(entry.path(), error) > 0 && !error) return true;
  }
  return false;
}

std::vector<pid_t> childrenOf(const Program& program) {
  const std::string id = std::to_string(program.id());
  std::istringstream list(readFile("/proc/" + id + "/task/" + id + "/children"));
  std::vector<pid_t> children;
  for (pid_t child = 0; list >> child;) children.push_back(child);
  return children;
}

/// A flat sheet of side x side quads, as OBJ.
std::string sheetObj(int side) {
  std::ostringstream text;
  for (int i = 0; i <= side; ++i)
    for (int j = 0; j <= side; ++j) text << "v " << i << ' ' << j << " 0\n";
  for (int i = 0; i < side; ++i) {
    for (int j = 1; j <= side; ++j) {
      const int a = i * (side + 1) + j, b = a + side + 1;
      text << "f " << a << ' ' << b << ' ' << b + 1 << "\nf " << a << ' ' << b + 1 << ' ' << a + 1 << '\n';
    }
  }
  return text.str();
}

class Interrupt : public testing::TestWithParam<int> {
 protected:
  int exitCode() const { return 128 + GetParam(); }

  /// Sends the signal as soon as `holds`, and expects nothing in the folder but what was there.
  void interrupt(const std::string& name, const std::string& executable, const Strings& arguments,
                 const std::function<bool(const Program&)>& holds) {
    const Strings before = folder_.names();
    Program program(executable, arguments, prints_.path());
    EXPECT_TRUE(seen(program, [&] { return holds(program); })) << name;
    kill(program.id(), GetParam());
    const Outcome outcome = program.wait();
    EXPECT_EQ(outcome.exit_code, exitCode()) << name;
    EXPECT_EQ(outcome.err, name + ": interrupted; no file was written\n");
    EXPECT_EQ(folder_.names(), before) << name;
  }

  TemporaryFolder folder_;
  TemporaryFolder prints_;
};

INSTANTIATE_TEST_SUITE_P(Signals, Interrupt, testing::Values(SIGINT, SIGTERM),
                         [](const auto& given) { return given.param == SIGINT ? "Int" : "Term"; });

TEST_P(Interrupt, OfReading) {
  const std::string cloud = folder_.write("cloud.xyz", sphereXyz(300000));
  const auto is_read = [&](const Program& program) { return hasOpen(program, cloud); };
  interrupt("mlsmesh_reconstruct", MLSMESH_RECONSTRUCT, {cloud, folder_.file("out.ply")}, is_read);
  interrupt("mlsmesh_view", MLSMESH_VIEW, {cloud, "--screenshot", folder_.file("out.png")}, is_read);
  const std::string mesh = folder_.write("mesh.obj", sheetObj(500));
  interrupt("mlsmesh_inspect", MLSMESH_INSPECT, {mesh, "--json", folder_.file("out.json")},
            [&](const Program& program) { return hasOpen(program, mesh); });
}

TEST_P(Interrupt, OfComputing) {
  const std::string cloud = folder_.write("cloud.ply", spherePly(3000));
  const auto catches = [](const Program& program) { return catchesSignals(program); };
  const Strings endless = {"--levels", "9", "--refinement.threshold", "0"};
  Strings arguments = {cloud, folder_.file("out.ply"), "--all-levels", "--json", folder_.file("out.json")};
  arguments.insert(arguments.end(), endless.begin(), endless.end());
  interrupt("mlsmesh_reconstruct", MLSMESH_RECONSTRUCT, arguments, catches);
  interrupt("mlsmesh_sample", MLSMESH_SAMPLE, {"torus", folder_.file("out.ply"), "--count", "9000000"},
            catches);
  const std::string mesh = folder_.write("mesh.obj", sheetObj(300));
  interrupt("mlsmesh_inspect", MLSMESH_INSPECT, {mesh, "--json", folder_.file("out.json")}, catches);
}

TEST_P(Interrupt, OfDrawingEndsTheDisplayToo) {
  const std::string cloud = folder_.write("cloud.ply", spherePly(3000));
  std::vector<pid_t> children;
  unsetenv("DISPLAY");
  interrupt("mlsmesh_view", MLSMESH_VIEW,
            {cloud, "--screenshot", folder_.file("out.png"), "--show", "mesh", "--levels", "9",
             "--refinement.threshold", "0"},
            [&](const Program& program) {
              children = childrenOf(program);
              return !children.empty();
            });
  ASSERT_FALSE(children.empty());
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (kill(children[0], 0) == 0 && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_NE(kill(children[0], 0), 0) << "the virtual display still runs";
}

/// Writing may be over before the signal comes; then all files are there, whole.
TEST_P(Interrupt, OfWriting) {
  const std::string cloud = folder_.write("cloud.ply", spherePly(2000));
  const Strings before = folder_.names();
  const Strings arguments = {
      cloud,    folder_.file("out.obj"), "--all-levels", "--levels", "4", "--refinement.threshold", "0",
      "--json", folder_.file("out.json")};
  const Strings all = {"cloud.ply",  "out.L0.obj", "out.L1.obj", "out.L2.obj",
                       "out.L3.obj", "out.L4.obj", "out.json",   "out.obj"};
  bool was_interrupted = false;
  for (int i = 0; i < 20 && !was_interrupted; ++i) {
    Program program(MLSMESH_RECONSTRUCT, arguments, prints_.path());
    seen(program, [&] { return isWriting(folder_); });
    kill(program.id(), GetParam());
    const Outcome outcome = program.wait();
    was_interrupted = outcome.exit_code == exitCode() && folder_.names() == before;
    if (was_interrupted) continue;
    EXPECT_EQ(folder_.names(), all);
    for (const std::string& name : all)
      if (name != "cloud.ply") fs::remove(folder_.file(name));
  }
  EXPECT_TRUE(was_interrupted) << "in none of the runs";
}

}  // namespace
}  // namespace mlsmesh::test
