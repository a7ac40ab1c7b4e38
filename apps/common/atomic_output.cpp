// SPDX-License-Identifier: BSD-3-Clause
#include "common/atomic_output.h"

#include "common/file_swap.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <system_error>

namespace mlsmesh::apps {

namespace fs = std::filesystem;

namespace {

std::string errorText(int code) {
  return std::generic_category().message(code);
}

fs::path folderOf(const fs::path& file) {
  const fs::path parent = file.parent_path();
  return parent.empty() ? fs::path(".") : parent;
}

/// Where a name leads to, also one of a link to what does not exist yet.
fs::path resolve(const fs::path& target) {
  constexpr int kMostLinks = 40;  // as the system
  fs::path file = fs::absolute(target);
  std::error_code error;
  for (int i = 0; i < kMostLinks && fs::is_symlink(file, error); ++i) {
    const fs::path next = fs::read_symlink(file, error);
    if (error) break;
    file = file.parent_path() / next;
  }
  const fs::path resolved = fs::weakly_canonical(file, error);
  return error ? file : resolved;
}

void checkFolder(const fs::path& target, const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder, error)) {
    throw fileError(target.string(), "the folder '" + folder.string() + "' does not exist; create it first");
  }
  if (!fs::is_directory(folder, error)) {
    throw fileError(target.string(), "'" + folder.string() + "' is not a folder; give another name");
  }
}

void checkTarget(const fs::path& target, const fs::path& resolved) {
  std::error_code error;
  if (target.filename().empty() || fs::is_directory(target, error)) {
    throw fileError(target.string(), "is a folder; give the name of a file to write");
  }
  const fs::file_status status = fs::status(target, error);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    throw fileError(target.string(), "exists and is not a regular file; give another name");
  }
  checkFolder(target, folderOf(target));
  checkFolder(target, folderOf(resolved));
  if (fs::is_symlink(resolved, error))
    throw fileError(target.string(), "is a link to itself; give another name");
  // Renaming would pass over the file's own protection.
  if (fs::exists(status) && access(resolved.c_str(), W_OK) != 0) {
    throw fileError(target.string(), "exists and may not be written to (" + errorText(errno) +
                                         "); give another name, or change its permissions");
  }
}

fs::path createTemporary(const fs::path& folder, const fs::path& target,
                         std::optional<RemovedOnInterrupt>& removed_on_interrupt) {
  for (;;) {
    fs::path name = hiddenName(folder, ".tmp");
    removed_on_interrupt.emplace(name.string());
    const int file = open(name.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
    if (file >= 0) {
      close(file);
      return name;
    }
    if (errno != EEXIST) {
      throw fileError(target.string(), "cannot write to the folder '" + folder.string() + "' (" +
                                           errorText(errno) + "); choose a folder that you may write to");
    }
  }
}

}  // namespace

AtomicOutput::AtomicOutput(const fs::path& target) : target_(target), resolved_(resolve(target)) {
  checkTarget(target_, resolved_);
  temporary_ = createTemporary(folderOf(resolved_), target_, removed_on_interrupt_);
}

AtomicOutput::~AtomicOutput() {
  std::error_code ignored;
  if (!temporary_.empty()) fs::remove(temporary_, ignored);
}

AtomicOutput::AtomicOutput(AtomicOutput&& other) noexcept
    : target_(std::move(other.target_)),
      resolved_(std::move(other.resolved_)),
      temporary_(std::move(other.temporary_)),
      removed_on_interrupt_(std::move(other.removed_on_interrupt_)) {
  other.temporary_.clear();
}

void AtomicOutput::commit() {
  InterruptsWait wait;
  swapAll({{temporary_, resolved_, target_}});
  temporary_.clear();
  wait.inPlace();
}

void commitAll(std::vector<AtomicOutput>& outputs) {
  InterruptsWait wait;
  std::vector<FileSwap> swaps;
  for (const AtomicOutput& output : outputs)
    swaps.push_back({output.temporary_, output.resolved_, output.target_});
  swapAll(swaps);
  for (AtomicOutput& output : outputs) output.temporary_.clear();
  wait.inPlace();
}

void checkWritable(const fs::path& target) {
  const AtomicOutput probe(target);
}

bool isSameFile(const fs::path& a, const fs::path& b) {
  std::error_code error;
  return resolve(a) == resolve(b) || fs::equivalent(a, b, error);
}

AppError notWritten(const fs::path& written, const fs::path& target) {
  std::error_code error;
  if (fs::exists(folderOf(written), error))
    return fileError(target.string(), "could not be written whole; is the disk full?");
  return fileError(target.string(), "could not be written, its folder is gone; name another one");
}

void writeFile(const fs::path& path, const std::string& content, const fs::path& target) {
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(content.data(), static_cast<std::streamsize>(content.size()));
  file.close();
  if (!file) throw notWritten(path, target);
}

}  // namespace mlsmesh::apps
