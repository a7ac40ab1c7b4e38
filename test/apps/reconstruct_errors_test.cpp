// SPDX-License-Identifier: BSD-3-Clause
// Every bad input ends with one line that names culprit and remedy, the right exit code, and no file left.
#include "reconstruct_fixture.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <thread>

namespace mlsmesh::test {

namespace {

namespace fs = std::filesystem;

class ReconstructErrors : public ReconstructTest {
 protected:
  /// One line "mlsmesh_reconstruct: CULPRIT ...; REMEDY" with both words in it, and nothing new in the
  /// folder.
  void expectError(const std::vector<std::string>& arguments, int exit_code, const std::string& culprit,
                   const std::string& word, const std::function<bool()>& prepare = nullptr) const {
    const std::vector<std::string> before = folder_.names();
    const Outcome outcome = run(arguments, prepare);
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_EQ(outcome.err.rfind("mlsmesh_reconstruct: ", 0), 0u) << outcome.err;
    EXPECT_NE(outcome.err.find(culprit), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find(word), std::string::npos) << outcome.err;
    EXPECT_TRUE(outcome.err.find(';') != std::string::npos || outcome.err.find('?') != std::string::npos)
        << "no remedy: " << outcome.err;
    EXPECT_EQ(folder_.names(), before);
  }

  /// The content as an input file of that name fails.
  void expectBadInput(const std::string& name, const std::string& content, const std::string& word) const {
    SCOPED_TRACE(name + ": " + content.substr(0, 40));
    expectError({folder_.write(name, content), folder_.file("out.ply")}, 1, name, word);
  }

  std::string sphere() const { return folder_.write("sphere.ply", spherePly(500)); }
};

/// What fills the first half of a file.
std::string half(const std::string& content) {
  return content.substr(0, content.size() / 2);
}

std::string rows(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

/// Becomes a user without rights; false if that is not possible.
bool becomeNobody() {
  constexpr unsigned kNobody = 65534;
  if (geteuid() != 0) return true;
  return setgid(kNobody) == 0 && setuid(kNobody) == 0;
}

}  // namespace

TEST_F(ReconstructErrors, FilesThatCannotBeRead) {
  expectError({folder_.file("absent.pcd"), folder_.file("out.ply")}, 1, "absent.pcd", "no such file");
  expectError({folder_.path().string() + "/.ply", folder_.file("out.ply")}, 2, ".ply", "use one of");
  fs::create_directory(folder_.path() / "folder.ply");
  expectError({folder_.file("folder.ply"), folder_.file("out.ply")}, 1, "folder.ply", "is a folder");
  for (const char* extension : {"pcd", "ply", "obj", "vtk", "vtp", "xyz", "txt"}) {
    expectBadInput(std::string("empty.") + extension, "", "is empty");
  }
}

TEST_F(ReconstructErrors, FilesOfAnotherType) {
  const std::string png = std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16) + std::string(2000, '\x07');
  for (const char* extension : {"pcd", "ply", "obj", "vtk", "vtp", "xyz"}) {
    expectBadInput(std::string("picture.") + extension, png, "extension");
  }
  for (const char* extension : {"pcd", "ply", "obj", "vtk", "vtp"}) {
    expectBadInput(std::string("prose.") + extension, "It was a bright cold day in April,\nand so on.\n",
                   ";");
  }
  expectBadInput("prose.xyz", "It was a bright cold day in April,\nand so on.\n", "line 2");
  expectBadInput("ply.pcd", spherePly(100), "not a PCD file");
  expectBadInput("pcd.ply", spherePcd(100), "not a PLY file");
  expectError({folder_.write("image.png", png), folder_.file("out.ply")}, 2, "image.png", "use one of");
}

TEST_F(ReconstructErrors, FilesThatAreCutOff) {
  expectBadInput("half.pcd", half(spherePcd(500)), "line");
  expectBadInput("half.ply", half(spherePly(500)), "line");
  const std::string pcd = spherePcd(500);
  expectBadInput("lines.pcd", pcd.substr(0, pcd.rfind('\n', pcd.size() / 2) + 1), "cut off");
  expectBadInput("half.vtk", half(sphereVtk(500)), "cut off");
  expectBadInput("half.xyz", sphereXyz(500).substr(0, 5000), "line");
  expectBadInput("header.pcd", spherePcd(500).substr(0, 60), "PCD");
  expectBadInput("header.ply", spherePly(500).substr(0, 60), "end_header");
  expectBadInput("huge.ply",
                 "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\n"
                 "property float y\nproperty float z\nend_header\nabc",
                 "cut off");
  expectBadInput("huge.pcd",
                 "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 400000000\nHEIGHT 1\n"
                 "POINTS 400000000\nDATA binary\nabc",
                 "cut off");
  expectBadInput("few.pts", "5\n0 0 0\n1 0 0\n0 1 0\n", "announces 5");
}

TEST_F(ReconstructErrors, BinaryMeshesThatAreCutOff) {
  const std::string input = sphere();
  for (const char* name : {"whole.ply", "whole.vtk", "whole.vtp"}) {
    runWell({input, folder_.file(name), "--levels", "0"});
    const std::string content = readFile(folder_.file(name));
    for (const double share : {0.3, 0.6, 0.9, 0.99}) {
      const auto size = static_cast<std::size_t>(share * static_cast<double>(content.size()));
      const std::string cut = "cut" + fs::path(name).extension().string();
      const Outcome outcome = run({folder_.write(cut, content.substr(0, size)), folder_.file("out.ply")});
      EXPECT_EQ(outcome.exit_code, 1) << name << " " << share;
      EXPECT_FALSE(fs::exists(folder_.file("out.ply")));
      EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    }
  }
}

TEST_F(ReconstructErrors, LinesAndFieldsThatAreWrong) {
  expectBadInput("word.xyz", rows({"0 0 0", "1 0 0", "0 one 0"}), "line 3, '0 one 0'");
  expectBadInput("short.xyz", rows({"0 0 0", "1 0"}), "line 2");
  expectBadInput("uneven.xyz", rows({"0 0 0", "1 0 0 5"}), "line 2");
  expectBadInput("two.xyz", rows({"0 0", "1 0"}), "line 1");
  expectBadInput("heading.xyz", rows({"x y z"}), "no points");
  expectBadInput("word.obj", rows({"v 0 0 0", "v 1 0 z"}), "line 2");
  expectBadInput("faces.obj", rows({"f 1 2 3"}), "no vertices");
  std::string pcd = spherePcd(100);
  expectBadInput("word.pcd", pcd.substr(0, pcd.rfind('\n', pcd.size() - 2)) + "\nnone 0 1 0 0\n", "none 0 1");
  expectBadInput(
      "flat.pcd",
      "FIELDS x y\nSIZE 4 4\nTYPE F F\nCOUNT 1 1\nWIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA ascii\n0 0\n1 1\n",
      "no field 'z'");
  expectBadInput("other.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float u\nend_header\n1\n",
                 "no field 'x'");
  expectBadInput("faces.ply", "ply\nformat ascii 1.0\nelement face 0\nend_header\n", "vertex");
  expectBadInput(
      "none.pcd",
      "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 0\nHEIGHT 1\nPOINTS 0\nDATA ascii\n",
      "no points");
  expectBadInput(
      "size.pcd",
      "FIELDS x y z\nSIZE 4 3 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA ascii\n0 0 0\n",
      "field 'y'");
}

TEST_F(ReconstructErrors, PointsThatSpanNoSurface) {
  expectBadInput("two.xyz", rows({"0 0 0", "1 0 0"}), "2");
  expectBadInput("equal.xyz", rows({"1 2 3", "1 2 3", "1 2 3", "1 2 3"}), "1");
  expectBadInput("nan.xyz", rows({"nan 0 0", "0 nan 0", "0 0 inf", "1 1 1", "1 2 3"}), "2");
  std::vector<std::string> line;
  for (int i = 0; i < 100; ++i) line.push_back(std::to_string(i) + " " + std::to_string(2 * i) + " 0");
  expectBadInput("line.xyz", rows(line), "line");
  expectError({sphere(), folder_.file("out.ply"), "--triangulation.length_factor", "1e-9"}, 1, "sphere.ply",
              "triang");
}

TEST_F(ReconstructErrors, Usage) {
  const std::string input = sphere();
  const std::string output = folder_.file("out.ply");
  expectError({}, 2, "INPUT", "--help");
  expectError({input}, 2, "OUTPUT", "--help");
  expectError({input, output, output}, 2, "arguments", "--help");
  expectError({input, output, "--level", "1"}, 2, "--level", "did you mean --levels");
  expectError({input, output, "-x"}, 2, "-x", "no such option");
  expectError({input, output, "--levels"}, 2, "--levels", "--help");
  expectError({input, output, "--levels", "1", "--levels", "2"}, 2, "--levels", "once");
  expectError({input, output, "--levels", "1", "--refinement.levels", "2"}, 2, "refinement.levels",
              "keep one");
  expectError({input, output, "--preset", "best"}, 2, "best", "printed");
  expectError({input, output, "--threads", "-1"}, 2, "threads", "0 .. 1024");
  expectError({input, folder_.file("out.png")}, 2, "out.png", "use one of");
  expectError({input, folder_.file("out")}, 2, "out", "use one of");
}

TEST_F(ReconstructErrors, ParametersOutOfRange) {
  const std::string input = sphere();
  const std::vector<std::pair<std::string, std::string>> cases = {{"levels", "-1"},
                                                                  {"levels", "11"},
                                                                  {"levels", "1.5"},
                                                                  {"projection.degree", "4"},
                                                                  {"projection.method", "two_step"},
                                                                  {"triangulation.restart", "maybe"},
                                                                  {"clustering.max_gap", "0.5"},
                                                                  {"refinement.threshold", "nan"},
                                                                  {"projection.support_factor", "0"},
                                                                  {"clustering.max_size", "99999999999"}};
  for (const auto& [name, value] : cases) {
    expectError({input, folder_.file("out.ply"), "--" + name, value}, 2, name, "allowed");
  }
}

TEST_F(ReconstructErrors, Configs) {
  const std::string input = sphere();
  const auto expect_config = [&](const std::string& content, const std::string& place,
                                 const std::string& word) {
    const std::string config = folder_.write("run.cfg", content);
    expectError({input, folder_.file("out.ply"), "--config", config}, 2, place, word);
  };
  expect_config("# a comment\nlevels = 1\nrefinement.level = 2\n", "run.cfg:3",
                "did you mean 'refinement.levels'");
  expect_config("levels = 20\n", "run.cfg:1", "0 .. 10");
  expect_config("levels 2\n", "run.cfg:1", "key = value");
  expect_config("levels =\n", "run.cfg:1", "key = value");
  expect_config("levels = 1\n\nlevels = 2\n", "run.cfg:3", "twice");
  expect_config("levels = 1\nrefinement.levels = 2\n", "run.cfg:2", "keep one");
  expect_config("preset = nice\n", "run.cfg:1", "printed");
  expect_config("output = x.ply\n", "run.cfg:1", "unknown");
  expectError({input, folder_.file("out.ply"), "--config", folder_.file("no.cfg")}, 2, "no.cfg",
              "no such file");
}

TEST_F(ReconstructErrors, Outputs) {
  const std::string input = sphere();
  expectError({input, folder_.file("absent/out.ply")}, 1, "absent/out.ply", "does not exist");
  expectError({input, input + "/out.ply"}, 1, "out.ply", "folder");
  expectError({input, input}, 2, "sphere.ply", "overwrite");
  expectError({input, folder_.path().string() + "/./sphere.ply"}, 2, "sphere.ply", "overwrite");
  expectError({input, folder_.file("out.ply"), "--json", folder_.file("out.ply")}, 2, "out.ply",
              "two outputs");
  expectError({input, folder_.file("out.ply"), "--json", folder_.file("absent/r.json")}, 1, "r.json",
              "does not exist");
  const std::string level = folder_.write("mesh.L1.ply", spherePly(500));
  expectError({level, folder_.file("mesh.ply"), "--all-levels"}, 2, "mesh.L1.ply", "overwrite");
  fs::create_directory(folder_.path() / "taken.ply");
  expectError({input, folder_.file("taken.ply")}, 1, "taken.ply", "is a folder");
  fs::create_symlink("/dev/null", folder_.path() / "null.ply");
  expectError({input, folder_.file("null.ply")}, 1, "null.ply", "regular file");
}

TEST_F(ReconstructErrors, Permissions) {
  fs::permissions(folder_.path(), fs::perms(0755));
  const TemporaryFolder reachable;  // the build may be where a plain user cannot go
  fs::permissions(reachable.path(), fs::perms(0755));
  program_ = reachable.file("mlsmesh_reconstruct");
  fs::copy_file(MLSMESH_RECONSTRUCT, program_);
  ASSERT_EQ(run({"--version"}, becomeNobody).exit_code, 0);
  const std::string secret = folder_.write("secret.ply", spherePly(100));
  fs::permissions(secret, fs::perms(0));
  const TemporaryFolder open;
  fs::permissions(open.path(), fs::perms(0777));
  expectError({secret, open.file("out.ply")}, 1, "secret.ply", "permissions", becomeNobody);
  EXPECT_TRUE(open.names().empty());
  const std::string input = sphere();
  fs::permissions(input, fs::perms(0644));
  const std::string kept = open.write("kept.ply", "old");
  fs::permissions(kept, fs::perms(0444));
  expectError({input, kept}, 1, "kept.ply", "may not be written to", becomeNobody);
  EXPECT_EQ(readFile(kept), "old");
  fs::permissions(folder_.path(), fs::perms(0555));
  expectError({input, folder_.file("out.ply")}, 1, "out.ply", "cannot write", becomeNobody);
  fs::permissions(folder_.path(), fs::perms(0755));
}

TEST_F(ReconstructErrors, FullDiskLeavesTheOldFileAlone) {
  const std::string input = sphere();
  const auto limit_file_size = [] {
    const rlimit limit = {5000, 5000};
    return setrlimit(RLIMIT_FSIZE, &limit) == 0;
  };
  for (const char* name : {"out.ply", "out.obj", "out.stl", "out.vtk", "out.vtp"}) {
    const std::string output = folder_.write(name, "old");
    const Outcome outcome = run({input, output, "--json", folder_.file("r.json")}, limit_file_size);
    EXPECT_EQ(outcome.exit_code, 1) << name;
    EXPECT_NE(outcome.err.find("disk full"), std::string::npos) << outcome.err;
    EXPECT_EQ(readFile(output), "old");
    fs::remove(output);
    EXPECT_EQ(folder_.names(), std::vector<std::string>{"sphere.ply"});
  }
}

TEST_F(ReconstructErrors, InterruptLeavesNothing) {
  const std::string input = folder_.write("sphere.ply", spherePly(3000));
  const TemporaryFolder prints;
  Program program(MLSMESH_RECONSTRUCT,
                  {input, folder_.file("out.ply"), "--levels", "9", "--refinement.threshold", "0", "--json",
                   folder_.file("r.json")},
                  prints.path());
  // Until the program has its handler: bit 1 of the caught signals.
  const std::string status = "/proc/" + std::to_string(program.id()) + "/status";
  for (int i = 0; i < 5000; ++i) {
    const std::string text = readFile(status);
    const std::size_t caught = text.find("SigCgt:");
    if (caught != std::string::npos && (std::strtoull(text.c_str() + caught + 7, nullptr, 16) & 2) != 0)
      break;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  kill(program.id(), SIGINT);
  const Outcome outcome = program.wait();
  EXPECT_EQ(outcome.exit_code, 130);
  EXPECT_EQ(outcome.err, "mlsmesh_reconstruct: interrupted; no file was written\n");
  EXPECT_EQ(folder_.names(), std::vector<std::string>{"sphere.ply"});
}

}  // namespace mlsmesh::test
