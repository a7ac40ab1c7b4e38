// SPDX-License-Identifier: BSD-3-Clause
#include "common/vtp_check.h"

#include "common/app_error.h"
#include "common/file_bytes.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace mlsmesh::apps {

namespace {

/// zlib, the tightest of VTK's compressors on zeros, makes a byte of at most 1032.
constexpr double kMostExpansion = 1100;

AppError tooLarge(const std::string& file, const std::string& what) {
  return fileError(file, "is damaged or cut off: it announces " + what +
                             " than a file of its length can hold; copy or write it again");
}

bool isBlank(char c) {
  return std::isspace(static_cast<unsigned char>(c)) != 0;
}

void skipBlanks(std::string_view& text) {
  while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
}

/// The value in `="..."` or `='...'` at the start of a text; empty if there is none.
std::string_view quotedValue(std::string_view text) {
  skipBlanks(text);
  if (text.empty() || text.front() != '=') return {};
  text.remove_prefix(1);
  skipBlanks(text);
  if (text.empty() || (text.front() != '"' && text.front() != '\'')) return {};
  const std::size_t end = text.find(text.front(), 1);
  return end == std::string_view::npos ? std::string_view() : text.substr(1, end - 1);
}

/// The value of an attribute in a tag; empty if there is none.
std::string_view attribute(std::string_view tag, std::string_view name) {
  for (std::size_t at = tag.find(name); at != std::string_view::npos; at = tag.find(name, at + 1)) {
    if (at > 0 && !isBlank(tag[at - 1])) continue;
    const std::string_view value = quotedValue(tag.substr(at + name.size()));
    if (value.data() != nullptr) return value;
  }
  return {};
}

/// What is not a plain number counts as too large.
double number(std::string_view text, std::string_view what, const std::string& file) {
  skipBlanks(text);
  while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
  const bool is_plain = !text.empty() && text.size() < 16 &&
                        std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (!is_plain) throw fileError(file, "damaged VTP file, " + std::string(what) + "; write the file again");
  return static_cast<double>(std::stoull(std::string(text)));
}

int base64Digit(char c) {
  static const std::string kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const std::size_t digit = kDigits.find(c);
  return digit == std::string::npos ? -1 : static_cast<int>(digit);
}

/// The bytes that a text in base 64 begins with, at most `most`.
std::vector<std::uint8_t> fromBase64(std::string_view text, std::size_t most) {
  std::vector<std::uint8_t> bytes;
  std::uint32_t bits = 0;
  int count = 0;
  skipBlanks(text);
  for (std::size_t i = 0; i < text.size() && bytes.size() < most && base64Digit(text[i]) >= 0; ++i) {
    bits = bits << 6 | static_cast<std::uint32_t>(base64Digit(text[i]));
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<std::uint8_t>(bits >> count));
  }
  return bytes;
}

class VtpCheck {
 public:
  VtpCheck(const std::string& content, const std::string& file) : content_(content), file_(file) {
    const std::size_t start = content_.substr(0, 4096).find("<VTKFile");
    if (start == std::string_view::npos)
      throw fileError(file_, "is not a VTK XML file; give the file the extension of its format");
    const std::string_view tag = content_.substr(start, content_.find('>', start) - start);
    is_compressed_ = !attribute(tag, "compressor").empty();
    wide_ = attribute(tag, "header_type") == "UInt64";
    big_ = attribute(tag, "byte_order") == "BigEndian";
    const std::size_t appended = std::min(content_.find("<AppendedData"), content_.size());
    text_ = content_.substr(0, appended);
    const std::size_t underscore =
        content_.find('_', std::min(content_.find('>', appended), content_.size()));
    if (underscore != std::string_view::npos) appended_ = content_.substr(underscore + 1);
    appended_is_raw_ = content_.substr(appended, 200).find("raw") != std::string_view::npos;
  }

  void checkCounts() const {
    double most = 1, most_components = 1;
    for (std::size_t at = text_.find("NumberOf"); at != std::string_view::npos;
         at = text_.find("NumberOf", at + 1)) {
      std::size_t end = at;
      while (end < text_.size() && std::isalpha(static_cast<unsigned char>(text_[end])) != 0) ++end;
      const std::string_view name = text_.substr(at, end - at);
      const std::string_view value = quotedValue(text_.substr(end));
      if (value.data() == nullptr) continue;
      double& largest = name == "NumberOfComponents" ? most_components : most;
      largest = std::max(largest, number(value, name, file_));
    }
    // Several bytes for each at least; none of several arrays is shorter than its components say.
    const auto size = static_cast<double>(content_.size());
    if (most > (is_compressed_ ? kMostExpansion / 4 : 1) * size ||
        most * most_components > (is_compressed_ ? kMostExpansion : 4) * size)
      throw tooLarge(file_, "more points or faces");
  }

  void checkArrays() const {
    for (std::size_t at = text_.find("<DataArray"); at != std::string_view::npos;
         at = text_.find("<DataArray", at + 1)) {
      const std::size_t end = std::min(text_.find('>', at), text_.size());
      const std::string_view tag = text_.substr(at, end - at);
      const std::string_view format = attribute(tag, "format");
      if (format == "binary") checkBlocks(text_.substr(std::min(end + 1, text_.size())), false);
      if (format == "appended") {
        const double offset = number(attribute(tag, "offset"), "offset", file_);
        if (offset > static_cast<double>(appended_.size())) throw tooLarge(file_, "data farther on");
        checkBlocks(appended_.substr(static_cast<std::size_t>(offset)), appended_is_raw_);
      }
    }
  }

 private:
  /// The head of a block of data: its bytes; compressed, how many blocks, their length and that of the last.
  void checkBlocks(std::string_view data, bool is_raw) const {
    const std::size_t width = wide_ ? 8 : 4;
    const std::size_t bytes = (is_compressed_ ? 3 : 1) * width;
    std::vector<std::uint8_t> head(data.begin(),
                                   data.begin() + static_cast<std::ptrdiff_t>(std::min(bytes, data.size())));
    if (!is_raw) head = fromBase64(data, bytes);
    if (head.size() < width) throw tooLarge(file_, "longer data");
    const auto size = static_cast<double>(content_.size());
    for (std::size_t word = 0; (word + 1) * width <= head.size(); ++word) {
      double value = 0;
      for (std::size_t i = 0; i < width; ++i)
        value = 256 * value + head[word * width + (big_ ? i : width - 1 - i)];
      if (!is_compressed_ && value > dataBytes(data, is_raw) - static_cast<double>(width))
        throw tooLarge(file_, "longer data");
      // Every block has its length in the head.
      if (value > (word == 0 ? 1 : kMostExpansion) * size) throw tooLarge(file_, "longer data");
    }
  }

  /// At most, with the head.
  static double dataBytes(std::string_view data, bool is_raw) {
    return is_raw ? static_cast<double>(data.size())
                  : 0.75 * static_cast<double>(std::min(data.find('<'), data.size()));
  }

  std::string_view content_;
  const std::string& file_;
  std::string_view text_;      ///< without what is appended
  std::string_view appended_;  ///< from its first byte on
  bool is_compressed_ = false;
  bool wide_ = false;
  bool big_ = false;
  bool appended_is_raw_ = false;
};

}  // namespace

void checkVtp(const std::filesystem::path& file) {
  const std::string content = readBytes(file);
  const std::string name = file.string();
  const VtpCheck check(content, name);
  check.checkCounts();
  check.checkArrays();
}

}  // namespace mlsmesh::apps
