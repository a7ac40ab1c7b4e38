// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/interrupt.h"

#include <filesystem>
#include <optional>
#include <vector>

namespace mlsmesh::apps {

/// A file that appears whole or not at all: written under a temporary name in the folder of `target`, then
/// renamed. Removed by an interrupt (endOnInterrupt). A target that is a symbolic link stays one; the file it
/// points to is replaced.
class AtomicOutput {
 public:
  /// Creates the (empty) temporary file. Throws AppError that names `target` if its folder is absent or not
  /// writable, or if `target` exists and is not a regular file.
  explicit AtomicOutput(const std::filesystem::path& target);
  /// Removes the temporary file unless it was renamed.
  ~AtomicOutput();
  AtomicOutput(AtomicOutput&& other) noexcept;
  AtomicOutput& operator=(AtomicOutput&&) = delete;

  /// Where to write.
  const std::filesystem::path& temporary() const { return temporary_; }
  /// As the user named it.
  const std::filesystem::path& target() const { return target_; }
  /// Puts the file in place. Throws AppError.
  void commit();
  /// Removes a file that commit() has put in place.
  void withdraw();

 private:
  std::filesystem::path target_;
  std::filesystem::path resolved_;
  std::filesystem::path temporary_;  ///< empty once renamed
  std::optional<RemovedOnInterrupt> removed_on_interrupt_;  ///< the temporary file
};

/// Commits all; if one fails, the others are withdrawn. Interrupts wait meanwhile. Throws AppError.
void commitAll(std::vector<AtomicOutput>& outputs);

/// Throws AppError, as AtomicOutput would, if `target` could not be written now.
void checkWritable(const std::filesystem::path& target);

/// Whether both names stand for one file, existing or not.
bool isSameFile(const std::filesystem::path& a, const std::filesystem::path& b);

/// Replaces the content of the (temporary) file `path`; `target` is the name for the error. Throws AppError.
void writeFile(const std::filesystem::path& path, const std::string& content,
               const std::filesystem::path& target);

}  // namespace mlsmesh::apps
