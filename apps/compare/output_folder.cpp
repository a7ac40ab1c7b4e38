// SPDX-License-Identifier: BSD-3-Clause
#include "compare/output_folder.h"

#include "common/app_error.h"
#include "common/file_swap.h"

#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <set>
#include <system_error>

namespace mlsmesh::apps {
namespace {

namespace fs = std::filesystem;

AppError folderError(const fs::path& folder, const std::error_code& error) {
  return fileError(folder.string(),
                   "cannot be written to (" + error.message() + "); name a folder that you may write to");
}

}  // namespace

OutputFolder::OutputFolder(const fs::path& folder) : folder_(folder) {
  std::error_code error;
  if (fs::exists(folder_, error) && !fs::is_directory(folder_, error))
    throw fileError(folder_.string(), "is not a folder; give another name");
  was_made_ = fs::create_directories(folder_, error);
  if (error) throw folderError(folder_, error);
  std::string name = (folder_ / ".mlsmesh-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw folderError(folder_, {errno, std::generic_category()});
  hidden_ = name;
  drafts_ = hidden_ / "drafts";
  scratch_ = hidden_ / "scratch";
  fs::create_directory(drafts_);
  fs::create_directory(scratch_);
}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  fs::remove_all(hidden_, ignored);
  if (was_made_) fs::remove(folder_, ignored);  // fails, as it should, unless empty
}

fs::path OutputFolder::draft(const std::string& name) {
  const fs::path file = drafts_ / name;
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  if (error) throw folderError(folder_, error);
  return file;
}

void OutputFolder::discard(const std::string& name) {
  std::error_code ignored;
  fs::remove(drafts_ / name, ignored);
  discarded_.push_back(name);
}

void OutputFolder::commit() {
  std::vector<FileSwap> swaps;
  std::set<fs::path> drafted;
  for (const auto& entry : fs::recursive_directory_iterator(drafts_)) {
    if (!entry.is_regular_file()) continue;
    const fs::path target = folder_ / fs::relative(entry.path(), drafts_);
    std::error_code error;
    fs::create_directories(target.parent_path(), error);
    if (error) throw folderError(target.parent_path(), error);
    swaps.push_back({entry.path(), target, target});
    drafted.insert(target);
  }
  for (const std::string& name : discarded_)
    if (drafted.count(folder_ / name) == 0) swaps.push_back({{}, folder_ / name, folder_ / name});
  swapAll(swaps);
}

}  // namespace mlsmesh::apps
