// SPDX-License-Identifier: BSD-3-Clause
#include "program.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>
#include <sstream>
#include <string>

namespace mlsmesh::test {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = MLSMESH_SOURCE_DIR "/launch_configs";

std::set<std::string> filesOf(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename().string());
  return names;
}

/// The files in the table of the page's section about a program.
std::set<std::string> listedFor(const std::string& program) {
  static const std::regex kName("`([^`]+[.]cfg)`");
  std::istringstream page(readFile(MLSMESH_SOURCE_DIR "/docs/launch_configs.md"));
  std::set<std::string> names;
  std::string section;
  for (std::string line; std::getline(page, line);) {
    if (line.rfind("## ", 0) == 0) section = line.substr(3);
    if (section != program || line.rfind("|", 0) != 0) continue;
    for (std::sregex_iterator name(line.begin(), line.end(), kName), end; name != end; ++name)
      names.insert((*name)[1]);
  }
  return names;
}

TEST(LaunchConfigs, ThePageListsAllOfThem) {
  EXPECT_EQ(filesOf(kFolder), (std::set<std::string>{"compare", "reconstruct", "view"}));
  for (const std::string& program : filesOf(kFolder))
    EXPECT_EQ(listedFor("mlsmesh_" + program), filesOf(kFolder / program)) << program;
}

TEST(LaunchConfigs, EachSaysHowItIsUsed) {
  for (const std::string& program : filesOf(kFolder)) {
    for (const std::string& name : filesOf(kFolder / program)) {
      const std::string content = readFile(kFolder / program / name);
      const std::regex command("# mlsmesh_" + program + " [^\n]*--config launch_configs/" + program + "/" +
                               name + "( |\n)");
      EXPECT_TRUE(std::regex_search(content, command)) << program << "/" << name;
    }
  }
}

}  // namespace
}  // namespace mlsmesh::test
