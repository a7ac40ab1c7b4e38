// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/app_error.h"

#include <string>
#include <string_view>
#include <vector>

namespace mlsmesh::apps {

/// The lines of a text, without the empty ones, blanks and separators (commas, semicolons) at their ends cut
/// off.
class TextLines {
 public:
  /// `number` is that of the line before the first.
  explicit TextLines(std::string_view text, std::size_t number = 0) : rest_(text), number_(number) {}

  bool next(std::string_view& line);
  /// Of the line last given, from 1.
  std::size_t number() const { return number_; }

 private:
  std::string_view rest_;
  std::size_t number_;
};

/// Blank, comma or semicolon.
bool isSeparator(char c);

/// `text` without separators at its ends.
std::string_view trimSeparators(std::string_view text);

/// Appends the numbers of a line, read as doubles in the C locale (nan and inf, too); false if something in
/// it is not a number.
bool appendNumbers(std::string_view line, std::vector<double>& numbers);

/// "FILE: line N, 'TEXT': WHAT" of the line last given.
AppError lineError(const std::string& file, const TextLines& lines, std::string_view line,
                   const std::string& what);

/// Throws AppError that names the first of `rows` lines which is not `columns` numbers, or says that lines
/// are missing.
void checkNumberRows(TextLines lines, std::size_t rows, std::size_t columns, const std::string& file);

}  // namespace mlsmesh::apps
