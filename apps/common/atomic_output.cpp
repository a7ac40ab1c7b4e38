// SPDX-License-Identifier: BSD-3-Clause
#include "common/atomic_output.h"

#include "common/app_error.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
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

fs::path resolve(const fs::path& target) {
  std::error_code error;
  const fs::path resolved = fs::weakly_canonical(fs::absolute(target), error);
  return error ? target : resolved;
}

void checkTarget(const fs::path& target) {
  std::error_code error;
  if (target.filename().empty() || fs::is_directory(target, error)) {
    throw fileError(target.string(), "is a folder; give the name of a file to write");
  }
  const fs::file_status status = fs::status(target, error);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    throw fileError(target.string(), "exists and is not a regular file; give another name");
  }
  const fs::path folder = folderOf(target);
  if (!fs::exists(folder, error)) {
    throw fileError(target.string(), "the folder '" + folder.string() + "' does not exist; create it first");
  }
  if (!fs::is_directory(folder, error)) {
    throw fileError(target.string(), "'" + folder.string() + "' is not a folder; give another name");
  }
}

fs::path createTemporary(const fs::path& folder, const fs::path& target,
                         std::optional<RemovedOnInterrupt>& removed_on_interrupt) {
  static std::atomic<int> counter{0};
  for (;;) {
    fs::path name =
        folder / (".mlsmesh-" + std::to_string(getpid()) + "-" + std::to_string(counter++) + ".tmp");
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
  checkTarget(target_);
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
  std::error_code error;
  fs::rename(temporary_, resolved_, error);
  if (error) {
    throw fileError(target_.string(),
                    "cannot be put in place (" + error.message() + "); choose another folder");
  }
  temporary_.clear();
  wait.inPlace();
}

void AtomicOutput::withdraw() {
  std::error_code ignored;
  if (temporary_.empty()) fs::remove(resolved_, ignored);
}

void commitAll(std::vector<AtomicOutput>& outputs) {
  const InterruptsWait wait;
  try {
    for (AtomicOutput& output : outputs) output.commit();
  } catch (const AppError&) {
    for (AtomicOutput& output : outputs) output.withdraw();
    throw;
  }
}

void checkWritable(const fs::path& target) {
  const AtomicOutput probe(target);
}

bool isSameFile(const fs::path& a, const fs::path& b) {
  std::error_code error;
  return resolve(a) == resolve(b) || fs::equivalent(a, b, error);
}

void writeFile(const fs::path& path, const std::string& content, const fs::path& target) {
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(content.data(), static_cast<std::streamsize>(content.size()));
  file.close();
  if (!file) throw fileError(target.string(), "could not be written whole; is the disk full?");
}

}  // namespace mlsmesh::apps
