// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/app_error.h"
#include "common/interrupt.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace mlsmesh::apps {

/// A file that appears whole or not at all: written under a temporary name in the folder of `target`, then
/// renamed. Removed by an interrupt (endOnInterrupt). A target that is a symbolic link stays one; the file it
/// points to is replaced, or made.
class AtomicOutput {
 public:
  /// Creates the (empty) temporary file. Throws AppError that names `target` if its folder is absent or not
  /// writable, or if `target` exists and is not a regular file that may be written.
  explicit AtomicOutput(const std::filesystem::path& target);
  /// Removes the temporary file unless it was renamed.
  ~AtomicOutput();
  AtomicOutput(AtomicOutput&& other) noexcept;
  AtomicOutput& operator=(AtomicOutput&&) = delete;

  /// Where to write.
  const std::filesystem::path& temporary() const { return temporary_; }
  /// As the user named it.
  const std::filesystem::path& target() const { return target_; }
  /// Puts the file in place (see swapAll). Throws AppError.
  void commit();

 private:
  friend void commitAll(std::vector<AtomicOutput>& outputs);

  std::filesystem::path target_;
  std::filesystem::path resolved_;
  std::filesystem::path temporary_;                         ///< empty once renamed
  std::optional<RemovedOnInterrupt> removed_on_interrupt_;  ///< the temporary file
};

/// Puts all in place, or none: then what was there stays. Interrupts wait meanwhile. Throws AppError.
void commitAll(std::vector<AtomicOutput>& outputs);

/// Throws AppError, as AtomicOutput would, if `target` could not be written now.
void checkWritable(const std::filesystem::path& target);

/// Whether both names stand for one file, existing or not.
bool isSameFile(const std::filesystem::path& a, const std::filesystem::path& b);

/// The error of a file that could not be written: the disk is full, or its folder gone.
AppError notWritten(const std::filesystem::path& written, const std::filesystem::path& target);

/// Replaces the content of the (temporary) file `path`; `target` is the name for the error. Throws AppError.
void writeFile(const std::filesystem::path& path, const std::string& content,
               const std::filesystem::path& target);

}  // namespace mlsmesh::apps
