// SPDX-License-Identifier: BSD-3-Clause
#include "common/legacy_walk.h"

#include "common/text_lines.h"

#include <pcl/PCLPointField.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <map>
#include <sstream>

namespace mlsmesh::apps {

namespace {

using Type = pcl::PCLPointField::PointFieldTypes;

constexpr const char* kBlanks = " \t\r\n";
constexpr std::size_t kLongestLine = 1000;

enum class Kind { Signed, Unsigned, Real };

struct NumberType {
  std::size_t bytes = 0;
  Kind kind = Kind::Signed;
  std::uint8_t field = 0;
};

/// Null for what is not numbers of whole bytes.
const NumberType* findType(std::string name) {
  static const std::map<std::string, NumberType> kTypes = {
      {"char", {1, Kind::Signed, Type::INT8}},
      {"signed_char", {1, Kind::Signed, Type::INT8}},
      {"unsigned_char", {1, Kind::Unsigned, Type::UINT8}},
      {"short", {2, Kind::Signed, Type::INT16}},
      {"unsigned_short", {2, Kind::Unsigned, Type::UINT16}},
      {"int", {4, Kind::Signed, Type::INT32}},
      {"unsigned_int", {4, Kind::Unsigned, Type::UINT32}},
      {"vtktypeint32", {4, Kind::Signed, Type::INT32}},
      {"vtkidtype", {4, Kind::Signed, Type::INT32}},
      {"float", {4, Kind::Real, Type::FLOAT32}},
      {"long", {8, Kind::Signed, Type::FLOAT64}},
      {"unsigned_long", {8, Kind::Unsigned, Type::FLOAT64}},
      {"vtktypeint64", {8, Kind::Signed, Type::FLOAT64}},
      {"vtktypeuint64", {8, Kind::Unsigned, Type::FLOAT64}},
      {"double", {8, Kind::Real, Type::FLOAT64}}};
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
  const auto found = kTypes.find(name);
  return found == kTypes.end() ? nullptr : &found->second;
}

template <class T>
T fromBits(std::uint64_t bits) {
  T value;
  static_assert(sizeof value <= sizeof bits);
  std::memcpy(&value, &bits, sizeof value);  // the host is little-endian
  return value;
}

/// A number that is stored with its highest byte first.
double decoded(const char* bytes, const NumberType& type) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < type.bytes; ++i) bits = bits << 8 | static_cast<unsigned char>(bytes[i]);
  if (type.kind == Kind::Unsigned) return static_cast<double>(bits);
  if (type.kind == Kind::Real)
    return type.bytes == 4 ? static_cast<double>(fromBits<float>(bits)) : fromBits<double>(bits);
  const std::size_t unused = 64 - 8 * type.bytes;
  return static_cast<double>(fromBits<std::int64_t>(bits << unused) >> unused);
}

bool isWhole(double value) {
  return std::isfinite(value) && value == std::floor(value);
}

/// -1, which is no vertex, for what no index can be.
std::int64_t asCorner(double value) {
  constexpr double kMost = 9007199254740992.0;  // 2^53
  return value >= 0 && value < kMost ? static_cast<std::int64_t>(value) : -1;
}

}  // namespace

LegacyWalk::LegacyWalk(const std::string& content, const std::string& file) : content_(content), file_(file) {
  const Words version = nextLine();
  if (content_.rfind("# vtk DataFile Version ", 0) != 0 || version.size() < 5) {
    throw fileError(file_, "is not a legacy VTK file; give the file the extension of its format");
  }
  has_offsets_ = version[4] >= "5";
  nextLine();
  const Words storage = nextLine();
  if (storage.size() != 1 || (storage[0] != "ASCII" && storage[0] != "BINARY"))
    throw damaged("neither ASCII nor BINARY");
  binary_ = storage[0] == "BINARY";
}

AppError LegacyWalk::damaged(const std::string& what) const {
  return fileError(file_, "damaged VTK file, " + what + "; write the file again");
}

AppError LegacyWalk::cutOff() const {
  return fileError(file_, "is cut off: it holds fewer numbers than it announces; copy the file again");
}

LegacyWalk::Words LegacyWalk::nextLine() {
  if (atEnd()) return {""};
  const std::size_t end = std::min(content_.find('\n', position_), content_.size());
  std::istringstream line(content_.substr(position_, std::min(end - position_, kLongestLine)));
  position_ = end + 1;
  Words words;
  for (std::string word; line >> word;) words.push_back(word);
  if (words.empty()) return {""};
  last_name_ = words[0];
  for (char& c : words[0]) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return words;
}

LegacyWalk::Words LegacyWalk::nextFilledLine() {
  Words words;
  do words = nextLine();
  while (words[0].empty() && !atEnd());
  return words;
}

void LegacyWalk::skipTo(const std::string& keyword) {
  const std::size_t found = content_.find('\n' + keyword, position_ > 0 ? position_ - 1 : 0);
  position_ = found == std::string::npos ? content_.size() : found + 1;
}

std::size_t LegacyWalk::count(const Words& line, std::size_t index) const {
  const std::string text = index < line.size() ? line[index] : "";
  const bool number =
      !text.empty() && text.size() < 16 && text.find_first_not_of("0123456789") == std::string::npos;
  if (!number) throw damaged("the line '" + line[0] + "' lacks a count");
  return std::stoull(text);
}

/// Where a block begins that is there whole, and is stepped over.
std::size_t LegacyWalk::takeBlock(std::size_t rows, std::size_t columns, std::size_t bytes_each) {
  const std::size_t start = std::min(position_, content_.size());
  const long double needed = static_cast<long double>(rows) * static_cast<long double>(columns) *
                             static_cast<long double>(bytes_each);
  if (needed > static_cast<long double>(content_.size() - start)) throw cutOff();
  position_ = start + rows * columns * bytes_each;
  return start;
}

double LegacyWalk::nextWord(const std::string& type) {
  const std::size_t first = content_.find_first_not_of(kBlanks, std::min(position_, content_.size()));
  if (first == std::string::npos) throw cutOff();
  position_ = std::min(content_.find_first_of(kBlanks, first), content_.size());
  const std::string word = content_.substr(first, std::min<std::size_t>(position_ - first, 60));
  const NumberType* known = findType(type);
  std::vector<double> value;
  const bool is_number = known != nullptr && appendNumbers(word, value) && value.size() == 1 &&
                         (known->kind == Kind::Real || isWhole(value[0]));
  if (!is_number) throw damaged("'" + word + "' is not a number of type " + type);
  return value[0];
}

std::vector<double> LegacyWalk::numbers(std::size_t rows, std::size_t columns, const std::string& type) {
  const NumberType* known = findType(type);
  if (known == nullptr) throw damaged("unknown type '" + type + "'");
  std::vector<double> values;
  if (!binary_) {
    const std::size_t start = position_;
    takeBlock(rows, columns, 1);  // a word takes no less
    position_ = start;
    values.resize(rows * columns);
    for (double& value : values) value = nextWord(type);
    return values;
  }
  const std::size_t start = takeBlock(rows, columns, known->bytes);
  values.resize(rows * columns);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = decoded(&content_[start + i * known->bytes], *known);
  return values;
}

void LegacyWalk::skipNumbers(std::size_t rows, std::size_t columns, const std::string& type) {
  const NumberType* known = findType(type);
  if (known == nullptr) throw damaged("unknown type '" + type + "'");
  if (binary_) {
    takeBlock(rows, columns, known->bytes);
    return;
  }
  const std::size_t start = position_;
  takeBlock(rows, columns, 1);
  position_ = start;
  for (std::size_t i = 0; i < rows * columns; ++i) nextWord(type);
}

/// The older layout: of each cell how many corners it has, and these.
LegacyWalk::Cells LegacyWalk::countedCells(const Words& line) {
  const std::size_t cells = count(line, 1);
  const std::vector<double> list = numbers(count(line, 2), 1, "int");
  Cells result;
  std::size_t used = 0;
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const double corners = used < list.size() ? list[used] : -1;
    if (!(corners >= 0 && corners < static_cast<double>(list.size() - used)))
      throw damaged("the cells of '" + line[0] + "' do not fit its size");
    const std::size_t end = used + 1 + static_cast<std::size_t>(corners);
    for (++used; used < end; ++used) result.corners.push_back(asCorner(list[used]));
    result.ends.push_back(result.corners.size());
  }
  if (used != list.size()) throw damaged("the cells of '" + line[0] + "' do not fill its size");
  return result;
}

/// The newer layout: where every cell begins, and the corners of all; the first count is one more than the
/// cells.
LegacyWalk::Cells LegacyWalk::offsetCells(const Words& line) {
  std::vector<double> lists[2];
  for (const std::size_t index : {0, 1}) {
    const Words block = nextFilledLine();
    const bool is_known = block.size() == 2 && block[0] == (index == 0 ? "OFFSETS" : "CONNECTIVITY");
    if (!is_known) throw damaged("'" + line[0] + "' without OFFSETS and CONNECTIVITY");
    lists[index] = numbers(count(line, index + 1), 1, block[1]);
  }
  const auto& [begins, corners] = lists;
  Cells result;
  double last = 0;
  for (std::size_t i = 0; i < begins.size(); ++i) {
    if (!(begins[i] >= last && begins[i] <= static_cast<double>(corners.size())) ||
        (i == 0 && begins[i] != 0))
      throw damaged("the OFFSETS of '" + line[0] + "' do not rise from 0 to the number of corners");
    last = begins[i];
    if (i > 0) result.ends.push_back(static_cast<std::size_t>(last));
  }
  for (double i = 0; i < last; ++i) result.corners.push_back(asCorner(corners[static_cast<std::size_t>(i)]));
  return result;
}

LegacyWalk::Cells LegacyWalk::cells(const Words& line) {
  return has_offsets_ ? offsetCells(line) : countedCells(line);
}

void LegacyWalk::skipCells(const Words& line) {
  if (!has_offsets_) return skipNumbers(count(line, 2), 1, "int");
  for (const std::size_t index : {1, 2}) {
    const Words block = nextFilledLine();
    if (block.size() == 2) skipNumbers(count(line, index), 1, block[1]);
  }
}

void LegacyWalk::skipFields(const Words& line) {
  for (std::size_t left = count(line, 2); left > 0 && !atEnd();) {
    const Words array = nextLine();
    if (array.size() != 4) continue;
    skipNumbers(count(array, 1), count(array, 2), array[3]);
    --left;
  }
}

std::uint8_t legacyType(std::string name) {
  const NumberType* type = findType(std::move(name));
  return type == nullptr ? std::uint8_t{0} : type->field;
}

}  // namespace mlsmesh::apps
