// SPDX-License-Identifier: BSD-3-Clause
#include "common/file_swap.h"

#include "common/app_error.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <string>
#include <system_error>

namespace mlsmesh::apps {

namespace fs = std::filesystem;

namespace {

AppError swapError(const FileSwap& swap, const std::string& reason) {
  return fileError(swap.shown.string(), "cannot be put in place (" + reason + "); choose another folder");
}

/// File systems write late: that the disk is full may show here only.
void syncContent(const FileSwap& swap) {
  const int file = open(swap.from.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) throw swapError(swap, std::generic_category().message(errno));
  const int code = fsync(file) == 0 ? 0 : errno;
  close(file);
  // Not every file system can be asked.
  if (code == 0 || code == EINVAL || code == EROFS || code == ENOTSUP) return;
  throw fileError(swap.shown.string(), "could not be written whole (" +
                                           std::generic_category().message(code) + "); is the disk full?");
}

/// A swap that may have been made, and can be undone.
class Step {
 public:
  explicit Step(const FileSwap& swap) : swap_(swap) {}
  Step(Step&& other) noexcept
      : swap_(other.swap_), backup_(std::move(other.backup_)), is_made_(other.is_made_) {
    other.backup_.clear();
    other.is_made_ = false;
  }
  ~Step() {
    std::error_code ignored;
    if (is_made_ && backup_.empty()) fs::remove(swap_.to, ignored);
    if (is_made_ && !backup_.empty()) fs::rename(backup_, swap_.to, ignored);
    if (!backup_.empty()) fs::remove(backup_, ignored);
  }

  /// A second name for what is there; a copy where the file system has no such names.
  void keepOld() {
    std::error_code error;
    const fs::file_status status = fs::symlink_status(swap_.to, error);
    if (!fs::exists(status)) return;
    if (fs::is_directory(status)) throw swapError(swap_, "there is a folder of that name");
    do backup_ = hiddenName(swap_.to.parent_path(), ".old");
    while (fs::exists(fs::symlink_status(backup_, error)));
    if (link(swap_.to.c_str(), backup_.c_str()) == 0) return;
    fs::copy(swap_.to, backup_, fs::copy_options::copy_symlinks, error);
    if (error) throw swapError(swap_, "what is there cannot be kept, " + error.message());
  }

  void make() {
    std::error_code error;
    if (swap_.from.empty()) {
      fs::remove(swap_.to, error);
    } else {
      const fs::file_status old = fs::status(swap_.to, error);
      if (fs::is_regular_file(old)) fs::permissions(swap_.from, old.permissions(), error);
      fs::rename(swap_.from, swap_.to, error);
    }
    if (error) throw swapError(swap_, error.message());
    is_made_ = true;
  }

  /// What was made stays.
  void keepNew() { is_made_ = false; }

 private:
  const FileSwap& swap_;
  fs::path backup_;
  bool is_made_ = false;
};

}  // namespace

void swapAll(const std::vector<FileSwap>& swaps) {
  std::vector<Step> steps;
  for (const FileSwap& swap : swaps) {
    if (!swap.from.empty()) syncContent(swap);
    steps.emplace_back(swap);
  }
  // A single one is made in one step.
  if (steps.size() > 1)
    for (Step& step : steps) step.keepOld();
  for (Step& step : steps) step.make();
  for (Step& step : steps) step.keepNew();
}

fs::path hiddenName(const fs::path& folder, const char* suffix) {
  static std::atomic<int> counter{0};
  return folder / (".mlsmesh-" + std::to_string(getpid()) + "-" + std::to_string(counter++) + suffix);
}

}  // namespace mlsmesh::apps
