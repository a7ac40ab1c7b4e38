// SPDX-License-Identifier: BSD-3-Clause
// Files appear whole or not at all, and what was there before stays unless all of them appear.
#include "common/app_error.h"
#include "common/atomic_output.h"
#include "common/file_swap.h"
#include "program.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

namespace mlsmesh::test {
namespace {

namespace fs = std::filesystem;
using apps::AtomicOutput;
using Names = std::vector<std::string>;

std::string errorOf(const std::function<void()>& work) {
  try {
    work();
  } catch (const apps::AppError& error) {
    return error.what();
  }
  ADD_FAILURE() << "no error";
  return {};
}

std::vector<AtomicOutput> written(const std::vector<fs::path>& targets) {
  std::vector<AtomicOutput> outputs;
  for (const fs::path& target : targets) {
    outputs.emplace_back(target);
    apps::writeFile(outputs.back().temporary(), "new " + target.filename().string(), target);
  }
  return outputs;
}

TEST(Outputs, OldFilesComeBackIfALaterOneFails) {
  const TemporaryFolder folder;
  folder.write("a", "old a");
  {
    std::vector<AtomicOutput> outputs = written({folder.file("a"), folder.file("b"), folder.file("c")});
    fs::create_directory(folder.path() / "c");  // meanwhile
    folder.write("c/inside", "");
    EXPECT_NE(errorOf([&] { commitAll(outputs); }).find("/c: cannot be put in place"), std::string::npos);
  }
  EXPECT_EQ(readFile(folder.file("a")), "old a");
  EXPECT_EQ(folder.names(), (Names{"a", "c"}));
}

TEST(Outputs, OldFilesComeBackIfTheFolderOfALaterOneIsGone) {
  const TemporaryFolder folder;
  const std::string old = folder.write("a", "old a");
  fs::create_directory(folder.path() / "sub");
  {
    std::vector<AtomicOutput> outputs = written({old, folder.file("sub/b")});
    fs::rename(folder.path() / "sub", folder.path() / "moved");
    EXPECT_NE(errorOf([&] { commitAll(outputs); }).find("sub/b"), std::string::npos);
    fs::remove_all(folder.path() / "moved");
  }
  EXPECT_EQ(readFile(old), "old a");
  EXPECT_EQ(folder.names(), Names{"a"});
}

TEST(Outputs, AllAreReplacedAndNothingElseIsLeft) {
  const TemporaryFolder folder;
  folder.write("a", "old a");
  std::vector<AtomicOutput> outputs = written({folder.file("a"), folder.file("b")});
  commitAll(outputs);
  outputs.clear();
  EXPECT_EQ(readFile(folder.file("a")), "new a");
  EXPECT_EQ(readFile(folder.file("b")), "new b");
  EXPECT_EQ(folder.names(), (Names{"a", "b"}));
}

TEST(Outputs, RemovalIsUndoneToo) {
  const TemporaryFolder folder;
  const std::string old = folder.write("old", "old"), fresh = folder.write("fresh", "fresh");
  fs::create_directory(folder.path() / "taken");
  const auto swap = [&](const std::string& to) {
    apps::swapAll({{{}, old, old}, {{}, folder.file("absent"), "absent"}, {fresh, folder.file(to), to}});
  };
  EXPECT_NE(errorOf([&] { swap("taken"); }).find("taken"), std::string::npos);
  EXPECT_EQ(folder.names(), (Names{"fresh", "old", "taken"}));
  swap("free");
  EXPECT_EQ(folder.names(), (Names{"free", "taken"}));
  EXPECT_EQ(readFile(folder.file("free")), "fresh");
}

TEST(Outputs, LinksStayLinks) {
  const TemporaryFolder folder;
  fs::create_directory(folder.path() / "far");
  folder.write("far/whole", "old");
  for (const std::string name : {"whole", "absent"}) {
    const std::string link = folder.file("to_" + name);
    fs::create_symlink("far/" + name, link);
    written({link}).front().commit();
    EXPECT_TRUE(fs::is_symlink(link)) << name;
    EXPECT_EQ(readFile(folder.file("far/" + name)), "new to_" + name);
  }
  fs::create_symlink("nowhere/absent", folder.path() / "dangling");
  EXPECT_NE(errorOf([&] { AtomicOutput output(folder.file("dangling")); }).find("does not exist"),
            std::string::npos);
  fs::create_symlink("circle", folder.path() / "circle");
  EXPECT_NE(errorOf([&] { AtomicOutput output(folder.file("circle")); }).find("link to itself"),
            std::string::npos);
  EXPECT_EQ(folder.names(), (Names{"circle", "dangling", "far", "to_absent", "to_whole"}));
}

TEST(Outputs, InputIsKnownUnderAllItsNames) {
  const TemporaryFolder folder;
  const std::string input = folder.write("input", "data");
  fs::create_symlink("input", folder.path() / "soft");
  fs::create_hard_link(input, folder.path() / "hard");
  for (const std::string name : {"soft", "hard", "./input"})
    EXPECT_TRUE(apps::isSameFile(input, folder.file(name))) << name;
  fs::create_symlink("later", folder.path() / "dangling");
  EXPECT_TRUE(apps::isSameFile(folder.file("later"), folder.file("dangling")));
  EXPECT_FALSE(apps::isSameFile(input, folder.file("dangling")));
}

TEST(Outputs, PermissionsStay) {
  const TemporaryFolder folder;
  const std::string file = folder.write("secret", "old");
  fs::permissions(file, fs::perms(0600));
  written({file}).front().commit();
  EXPECT_EQ(fs::status(file).permissions(), fs::perms(0600));
  EXPECT_EQ(readFile(file), "new secret");
}

TEST(Outputs, NamesMayHoldBlanksAndAnyLetters) {
  const TemporaryFolder folder;
  const std::string file = folder.file("a b \xc3\xa4\xe7\xbd\x91\n'\".ply");
  written({file}).front().commit();
  EXPECT_EQ(fs::path(file).filename().string().insert(0, "new "), readFile(file));
}

TEST(Outputs, FolderThatIsGoneIsSaid) {
  const TemporaryFolder folder;
  fs::create_directory(folder.path() / "sub");
  const AtomicOutput output(folder.file("sub/a"));
  fs::remove_all(folder.path() / "sub");
  EXPECT_NE(
      errorOf([&] { apps::writeFile(output.temporary(), "x", output.target()); }).find("folder is gone"),
      std::string::npos);
}

}  // namespace
}  // namespace mlsmesh::test
