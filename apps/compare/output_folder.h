// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace mlsmesh::apps {

/// A folder whose new files appear all at the end, or not at all: until then they are in a hidden folder
/// inside it.
class OutputFolder {
 public:
  /// Makes the folder if it is not there. Throws AppError that names it if it cannot be made or written to.
  explicit OutputFolder(const std::filesystem::path& folder);
  /// Removes what was not committed, and the folder if it was made here and is empty.
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// Where to write the file that becomes `name`, a path below the folder; sub-folders are made.
  std::filesystem::path draft(const std::string& name);
  /// For files that are not to stay.
  std::filesystem::path scratch(const std::string& name) const { return scratch_ / name; }
  const std::filesystem::path& scratchFolder() const { return scratch_; }
  /// There shall be no file of that name: neither its draft nor one from an earlier comparison.
  void discard(const std::string& name);
  /// Puts all drafts in place, or none (see swapAll). Throws AppError.
  void commit();

 private:
  std::filesystem::path folder_;
  std::filesystem::path hidden_;
  std::filesystem::path drafts_;
  std::filesystem::path scratch_;
  std::vector<std::string> discarded_;
  bool was_made_ = false;
};

}  // namespace mlsmesh::apps
