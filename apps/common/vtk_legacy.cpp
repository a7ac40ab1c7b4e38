// SPDX-License-Identifier: BSD-3-Clause
#include "common/vtk_legacy.h"

#include "common/app_error.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <map>
#include <sstream>
#include <vector>

namespace mlsmesh::apps {

namespace {

using Words = std::vector<std::string>;

constexpr const char* kBlanks = " \t\r\n";

/// Walks over the lines and blocks of numbers of a legacy file.
class LegacyWalk {
 public:
  LegacyWalk(const std::string& content, const std::string& file) : content_(content), file_(file) {
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

  bool atEnd() const { return position_ >= content_.size(); }
  std::size_t position() const { return position_; }
  bool isBinary() const { return binary_; }
  bool hasOffsets() const { return has_offsets_; }
  AppError damaged(const std::string& what) const {
    return fileError(file_, "damaged VTK file, " + what + "; write the file again");
  }

  /// The words of the next line, the first one in capitals.
  Words nextLine() {
    const std::size_t end = std::min(content_.find('\n', position_), content_.size());
    std::istringstream line(content_.substr(position_, std::min<std::size_t>(end - position_, 1000)));
    position_ = end + 1;
    Words words;
    for (std::string word; line >> word;) words.push_back(word);
    if (words.empty()) return {""};
    for (char& c : words[0]) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return words;
  }

  /// The same of the next line that is not blank, such as the end of the line that numbers are on.
  Words nextFilledLine() {
    Words words;
    do words = nextLine();
    while (words[0].empty() && !atEnd());
    return words;
  }

  std::size_t count(const Words& line, std::size_t index) const {
    const std::string text = index < line.size() ? line[index] : "";
    const bool number =
        !text.empty() && text.size() < 16 && text.find_first_not_of("0123456789") == std::string::npos;
    if (!number) throw damaged("the line '" + line[0] + "' lacks a count");
    return std::stoull(text);
  }

  /// Steps over `values` numbers of a type.
  void skipNumbers(std::size_t values, const std::string& type) {
    if (binary_) skipBytes(values, sizeOf(type));
    for (std::size_t i = 0; !binary_ && i < values; ++i) skipWord(type);
  }

  /// A list of cells: two counts, and as many numbers.
  void skipCells(const Words& line) {
    const std::size_t first = count(line, 1);
    const std::size_t second = count(line, 2);
    if (!has_offsets_) return skipNumbers(second, "int");
    for (const std::size_t values : {first, second}) {
      const Words block = nextLine();
      if (block.size() == 2) skipNumbers(values, block[1]);
    }
  }

  /// Steps over a list of cells of the older layout, each a count and as many corners, none beyond the end.
  void checkCells(const Words& line) {
    if (has_offsets_) return checkOffsetCells(line);
    const std::size_t cells = count(line, 1), numbers = count(line, 2);
    std::size_t used = 0;
    for (std::size_t cell = 0; cell < cells; ++cell) {
      const std::int64_t corners = used < numbers ? nextInteger() : -1;
      if (corners < 0 || static_cast<std::size_t>(corners) >= numbers - used)
        throw damaged("the cells of '" + line[0] + "' do not fit its size");
      skipNumbers(static_cast<std::size_t>(corners), "int");
      used += 1 + static_cast<std::size_t>(corners);
    }
    if (used != numbers) throw damaged("the cells of '" + line[0] + "' do not fill its size");
  }

  /// The newer layout: where every cell begins, and the corners of all; the first count is one more than the
  /// cells.
  void checkOffsetCells(const Words& line) {
    for (const std::size_t index : {1, 2}) {
      const Words block = nextFilledLine();
      const bool is_known = block.size() == 2 && block[0] == (index == 1 ? "OFFSETS" : "CONNECTIVITY");
      if (!is_known) throw damaged("'" + line[0] + "' without OFFSETS and CONNECTIVITY");
      skipNumbers(count(line, index), block[1]);
    }
  }

  void skipFields(const Words& line) {
    for (std::size_t i = 0; i < count(line, 2); ++i) {
      const Words array = nextLine();
      if (array.size() == 4) skipNumbers(count(array, 1) * count(array, 2), array[3]);
    }
  }

 private:
  std::size_t sizeOf(std::string type) const {
    static const std::map<std::string, std::size_t> kSizes = {
        {"char", 1},         {"unsigned_char", 1}, {"short", 2}, {"unsigned_short", 2}, {"int", 4},
        {"unsigned_int", 4}, {"vtktypeint32", 4},  {"float", 4}, {"long", 8},           {"unsigned_long", 8},
        {"vtkidtype", 4},    {"vtktypeint64", 8},  {"double", 8}};
    std::transform(type.begin(), type.end(), type.begin(), [](unsigned char c) { return std::tolower(c); });
    const auto found = kSizes.find(type);
    if (found == kSizes.end()) throw damaged("unknown type '" + type + "'");
    return found->second;
  }

  void skipBytes(std::size_t values, std::size_t bytes_each) {
    if (values > (content_.size() - std::min(position_, content_.size())) / bytes_each) throw cutOff();
    position_ += values * bytes_each;
  }

  /// One number of a list of cells: big-endian, or a word.
  std::int64_t nextInteger() {
    const std::size_t start = position_;
    skipNumbers(1, "int");
    if (binary_) {
      std::uint32_t value = 0;
      for (std::size_t i = start; i < position_; ++i)
        value = value << 8 | static_cast<unsigned char>(content_[i]);
      return static_cast<std::int32_t>(value);
    }
    const std::size_t first = content_.find_first_not_of(kBlanks, start);
    std::int64_t value = -1;
    std::from_chars(content_.data() + first, content_.data() + position_, value);
    return value;
  }

  /// A word that VTK can read as a number of that type; it crashes over others, also over NaN.
  void skipWord(const std::string& type) {
    const std::size_t first = content_.find_first_not_of(kBlanks, position_);
    if (first == std::string::npos) throw cutOff();
    position_ = std::min(content_.find_first_of(kBlanks, first), content_.size());
    const bool is_real = type == "float" || type == "double";
    const std::string word = content_.substr(first, std::min<std::size_t>(position_ - first, 60));
    const bool has_digit = word.find_first_of("0123456789") != std::string::npos;
    if (!has_digit ||
        word.find_first_not_of(is_real ? "+-.0123456789eE" : "-0123456789") != std::string::npos)
      throw damaged("'" + word + "' is not a number of type " + type);
  }

  AppError cutOff() const {
    return fileError(file_, "is cut off: it holds fewer numbers than it announces; copy the file again");
  }

  const std::string& content_;
  const std::string& file_;
  std::size_t position_ = 0;
  bool binary_ = false;
  bool has_offsets_ = false;
};

bool isCellList(const std::string& keyword) {
  static const Words kKeywords = {"VERTICES", "LINES", "POLYGONS", "TRIANGLE_STRIPS", "CELLS"};
  return std::find(kKeywords.begin(), kKeywords.end(), keyword) != kKeywords.end();
}

/// Where the point data begin, from the present position on.
std::size_t findPointData(const std::string& content, std::size_t from) {
  const std::size_t found = content.find("\nPOINT_DATA", from > 0 ? from - 1 : 0);
  return found == std::string::npos ? content.size() : found + 1;
}

}  // namespace

std::string pointsOfLegacyVtk(const std::string& content, const std::string& file) {
  LegacyWalk walk(content, file);
  std::string points;
  std::size_t point_data = content.size();
  while (!walk.atEnd() && point_data == content.size()) {
    const std::size_t start = walk.position();
    const Words line = walk.nextLine();
    if (line[0] == "POINTS") {
      if (line.size() != 3) throw walk.damaged("the line POINTS is not whole");
      walk.skipNumbers(3 * walk.count(line, 1), line[2]);
      points = content.substr(start, walk.position() - start) + "\n";
    } else if (line[0] == "FIELD") {
      walk.skipFields(line);
    } else if (isCellList(line[0])) {
      walk.skipCells(line);
    } else if (line[0] == "CELL_TYPES") {
      walk.skipNumbers(walk.count(line, 1), "int");
    } else if (line[0] == "CELL_DATA") {
      point_data = findPointData(content, walk.position());
      if (point_data == content.size()) break;
    } else if (line[0] == "POINT_DATA") {
      point_data = start;
    }
  }
  if (points.empty()) throw fileError(file, "holds no POINTS; give a file with points");
  const std::string heading = "# vtk DataFile Version 4.2\npoints\n";
  const std::string storage = walk.isBinary() ? "BINARY\n" : "ASCII\n";
  return heading + storage + "DATASET POLYDATA\n" + points + content.substr(point_data);
}

std::string polygonsOfLegacyVtk(const std::string& content, const std::string& file) {
  LegacyWalk walk(content, file);
  bool is_polygons = false;
  std::string blocks;
  while (!walk.atEnd()) {
    const std::size_t start = walk.position();
    const Words line = walk.nextLine();
    const bool is_points = line[0] == "POINTS";
    const bool is_surface = line[0] == "POLYGONS" || line[0] == "TRIANGLE_STRIPS";
    if (line[0] == "DATASET") is_polygons = line.size() == 2 && line[1] == "POLYDATA";
    if (is_points && line.size() != 3) throw walk.damaged("the line POINTS is not whole");
    if (is_points) walk.skipNumbers(3 * walk.count(line, 1), line[2]);
    if (line[0] == "FIELD") walk.skipFields(line);
    if (isCellList(line[0])) walk.checkCells(line);
    if (is_points || is_surface) blocks += content.substr(start, walk.position() - start) + "\n";
    if (line[0] == "CELL_DATA" || line[0] == "POINT_DATA") break;
  }
  if (!is_polygons) throw fileError(file, "its data set is not POLYDATA; save the surface as polygons");
  const std::string version = walk.hasOffsets() ? "5.1" : "4.2";
  const std::string storage = walk.isBinary() ? "BINARY\n" : "ASCII\n";
  return "# vtk DataFile Version " + version + "\npolygons\n" + storage + "DATASET POLYDATA\n" + blocks;
}

}  // namespace mlsmesh::apps
