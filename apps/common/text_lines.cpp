// SPDX-License-Identifier: BSD-3-Clause
#include "common/text_lines.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>

namespace mlsmesh::apps {

bool TextLines::next(std::string_view& line) {
  while (!rest_.empty()) {
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    line = trimSeparators(rest_.substr(0, end));
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++number_;
    if (!line.empty()) return true;
  }
  return false;
}

bool isSeparator(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == ',' || c == ';';
}

std::string_view trimSeparators(std::string_view text) {
  while (!text.empty() && isSeparator(text.front())) text.remove_prefix(1);
  while (!text.empty() && isSeparator(text.back())) text.remove_suffix(1);
  return text;
}

bool appendNumbers(std::string_view line, std::vector<double>& numbers) {
  while (!line.empty()) {
    if (line.front() == '+') line.remove_prefix(1);
    double value = 0;
    const std::from_chars_result end = std::from_chars(line.data(), line.data() + line.size(), value);
    if (end.ec == std::errc::result_out_of_range) {
      value = std::strtod(std::string(line.data(), end.ptr).c_str(), nullptr);  // 0 or infinity
    } else if (end.ec != std::errc()) {
      return false;
    }
    line.remove_prefix(static_cast<std::size_t>(end.ptr - line.data()));
    if (!line.empty() && !isSeparator(line.front())) return false;
    line = trimSeparators(line);
    numbers.push_back(value);
  }
  return true;
}

AppError lineError(const std::string& file, const TextLines& lines, std::string_view line,
                   const std::string& what) {
  const std::string text(line.substr(0, 60));
  return fileError(file, "line " + std::to_string(lines.number()) + ", '" + text + "': " + what);
}

void checkNumberRows(TextLines lines, std::size_t rows, std::size_t columns, const std::string& file) {
  std::vector<double> numbers;
  std::string_view line;
  for (std::size_t row = 0; row < rows; ++row) {
    if (!lines.next(line)) {
      throw fileError(file, "is cut off: it announces " + std::to_string(rows) + " points and holds " +
                                std::to_string(row) + "; copy the file again");
    }
    numbers.clear();
    if (appendNumbers(line, numbers) && numbers.size() == columns) continue;
    throw lineError(file, lines, line,
                    "is not " + std::to_string(columns) + " numbers, as the header says; correct it");
  }
}

}  // namespace mlsmesh::apps
