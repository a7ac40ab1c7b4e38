// SPDX-License-Identifier: BSD-3-Clause
#include "common/header_parts.h"

#include "common/file_bytes.h"
#include "common/text_lines.h"

#include <algorithm>
#include <sstream>

namespace mlsmesh::apps {

namespace fs = std::filesystem;

AppError wrongType(const fs::path& file, const std::string& format) {
  return fileError(file.string(), "is not a " + format + " file; give the file the extension of its format");
}

AppError badHeader(const fs::path& file, const std::string& what) {
  return fileError(file.string(), "damaged header, " + what + "; write the file again");
}

// Long double: no overflow.
void checkSize(const fs::path& file, std::uintmax_t available, const std::string& what, std::uintmax_t items,
               std::uintmax_t bytes_each) {
  const long double needed = static_cast<long double>(items) * static_cast<long double>(bytes_each);
  if (needed <= static_cast<long double>(available)) return;
  throw fileError(file.string(), "is cut off: its header announces " + std::to_string(items) + " " + what +
                                     ", the file holds " + std::to_string(available) +
                                     " bytes of data; copy the file again");
}

void checkRows(const fs::path& file, std::uintmax_t data_offset, std::uintmax_t rows_before,
               std::uintmax_t rows, std::uintmax_t columns) {
  const std::string content = readBytes(file);
  const auto offset = static_cast<std::size_t>(data_offset);
  const auto header_lines =
      std::count(content.begin(), content.begin() + static_cast<std::ptrdiff_t>(offset), '\n');
  TextLines lines(std::string_view(content).substr(offset), static_cast<std::size_t>(header_lines));
  std::string_view skipped;
  for (std::uintmax_t row = 0; row < rows_before && lines.next(skipped);) ++row;
  checkNumberRows(lines, static_cast<std::size_t>(rows), static_cast<std::size_t>(columns), file.string());
}

std::vector<std::string> words(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> list;
  for (std::string word; stream >> word;) list.push_back(word);
  return list;
}

bool readCount(const std::string& text, std::uintmax_t& value) {
  if (text.empty() || text.size() > 18 || text.find_first_not_of("0123456789") != std::string::npos)
    return false;
  value = std::stoull(text);
  return true;
}

}  // namespace mlsmesh::apps
