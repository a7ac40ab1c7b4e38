// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/app_error.h"

#include <cstdint>
#include <string>
#include <vector>

namespace mlsmesh::apps {

/// Walks over the lines and blocks of numbers of a legacy VTK file, and checks that they are there before
/// anything is made for them. What is damaged ends the walk with an AppError.
class LegacyWalk {
 public:
  using Words = std::vector<std::string>;

  /// Reads the three lines at the head. `content` is the whole file, `file` its name for errors; both must
  /// outlive the walk.
  LegacyWalk(const std::string& content, const std::string& file);

  bool atEnd() const { return position_ >= content_.size(); }
  bool isBinary() const { return binary_; }
  AppError damaged(const std::string& what) const;

  /// The words of the next line, the first one in capitals; one empty word for a blank line, and at the end.
  Words nextLine();
  /// The same of the next line that is not blank, such as the end of the line that numbers are on.
  Words nextFilledLine();
  /// The first word of the last line, as it is written.
  const std::string& lastName() const { return last_name_; }
  /// Steps over whole lines up to the next that begins with `keyword`; to the end if there is none.
  void skipTo(const std::string& keyword);
  /// The number that is a word of a line, below 10^15.
  std::size_t count(const Words& line, std::size_t index) const;

  /// The next `rows` x `columns` numbers of a type.
  std::vector<double> numbers(std::size_t rows, std::size_t columns, const std::string& type);
  void skipNumbers(std::size_t rows, std::size_t columns, const std::string& type);

  /// Cells of the list that `line` announces: the corners of all, and where those of each end.
  struct Cells {
    std::vector<std::int64_t> corners;
    std::vector<std::size_t> ends;
  };
  Cells cells(const Words& line);
  void skipCells(const Words& line);
  void skipFields(const Words& line);

 private:
  std::size_t takeBlock(std::size_t rows, std::size_t columns, std::size_t bytes_each);
  double nextWord(const std::string& type);
  Cells countedCells(const Words& line);
  Cells offsetCells(const Words& line);
  AppError cutOff() const;

  const std::string& content_;
  const std::string& file_;
  std::size_t position_ = 0;
  std::string last_name_;
  bool binary_ = false;
  bool has_offsets_ = false;
};

/// pcl::PCLPointField's datatype that holds numbers of a type of legacy files; that of doubles for integers
/// of 64 bits, 0 for what is not numbers.
std::uint8_t legacyType(std::string name);

}  // namespace mlsmesh::apps
