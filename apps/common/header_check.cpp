// SPDX-License-Identifier: BSD-3-Clause
#include "common/header_check.h"

#include "common/app_error.h"
#include "common/file_bytes.h"
#include "common/text_lines.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace mlsmesh::apps {

namespace fs = std::filesystem;

namespace {

constexpr std::uintmax_t kLongestHeader = 1 << 18;

AppError wrongType(const fs::path& file, const std::string& format) {
  return fileError(file.string(), "is not a " + format + " file; give the file the extension of its format");
}

AppError badHeader(const fs::path& file, const std::string& what) {
  return fileError(file.string(), "damaged header, " + what + "; write the file again");
}

/// Throws if fewer bytes are there than `items` items of at least `bytes_each` need. Long double: no
/// overflow.
void checkSize(const fs::path& file, std::uintmax_t available, const std::string& what, std::uintmax_t items,
               std::uintmax_t bytes_each) {
  const long double needed = static_cast<long double>(items) * static_cast<long double>(bytes_each);
  if (needed <= static_cast<long double>(available)) return;
  throw fileError(file.string(), "is cut off: its header announces " + std::to_string(items) + " " + what +
                                     ", the file holds " + std::to_string(available) +
                                     " bytes of data; copy the file again");
}

/// The readers take what is not a number for 0 or NaN, and missing numbers for 0.
void checkRows(const fs::path& file, std::uintmax_t data_offset, std::uintmax_t rows,
               std::uintmax_t columns) {
  const std::string content = readBytes(file);
  const auto offset = static_cast<std::size_t>(data_offset);
  const auto header_lines =
      std::count(content.begin(), content.begin() + static_cast<std::ptrdiff_t>(offset), '\n');
  const TextLines lines(std::string_view(content).substr(offset), static_cast<std::size_t>(header_lines));
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

/// Keyword -> the words that follow, up to and with DATA; and where the data start.
struct PcdHeader {
  std::map<std::string, std::vector<std::string>> entries;
  std::uintmax_t data_offset = 0;

  bool has(const std::string& key) const { return entries.count(key) != 0 && !entries.at(key).empty(); }
  std::uintmax_t count(const std::string& key, const fs::path& file) const {
    std::uintmax_t value = 0;
    if (!has(key) || !readCount(entries.at(key)[0], value)) throw badHeader(file, "no usable " + key);
    return value;
  }
};

PcdHeader readPcdHeader(const fs::path& file) {
  std::istringstream lines(readBytes(file, kLongestHeader));
  PcdHeader header;
  std::string line;
  while (std::getline(lines, line)) {
    std::vector<std::string> entry = words(line);
    if (entry.empty() || entry[0][0] == '#') continue;
    const std::string key = entry[0] == "COLUMNS" ? "FIELDS" : entry[0];
    static const std::array<const char*, 10> kKeys = {"VERSION", "FIELDS", "SIZE",      "TYPE",   "COUNT",
                                                      "WIDTH",   "HEIGHT", "VIEWPOINT", "POINTS", "DATA"};
    if (std::find(kKeys.begin(), kKeys.end(), key) == kKeys.end()) throw wrongType(file, "PCD");
    header.entries[key].assign(entry.begin() + 1, entry.end());
    if (key != "DATA") continue;
    header.data_offset = lines.eof() ? fs::file_size(file) : static_cast<std::uintmax_t>(lines.tellg());
    return header;
  }
  throw wrongType(file, "PCD");
}

/// Values and bytes of a point.
struct PointSize {
  std::uintmax_t values = 0;
  std::uintmax_t bytes = 0;
};

PointSize pcdPointSize(const PcdHeader& header, const fs::path& file) {
  PointSize point;
  if (!header.has("FIELDS")) throw badHeader(file, "no FIELDS");
  const std::size_t fields = header.entries.at("FIELDS").size();
  for (const char* key : {"SIZE", "TYPE", "COUNT"}) {
    if (!header.has(key) && std::string(key) == "COUNT") continue;
    if (!header.has(key) || header.entries.at(key).size() != fields) {
      throw badHeader(file, std::string(key) + " does not match FIELDS");
    }
  }
  for (std::size_t i = 0; i < fields; ++i) {
    std::uintmax_t size = 0;
    std::uintmax_t count = 1;
    const std::string& type = header.entries.at("TYPE")[i];
    const bool known =
        readCount(header.entries.at("SIZE")[i], size) && (size == 1 || size == 2 || size == 4 || size == 8) &&
        (type == "I" || type == "U" || (type == "F" && size >= 4)) &&
        (!header.has("COUNT") || readCount(header.entries.at("COUNT")[i], count)) && count < 1000000;
    if (!known)
      throw badHeader(file, "type, size or count of field '" + header.entries.at("FIELDS")[i] + "'");
    point.values += count;
    point.bytes += size * count;
  }
  return point;
}

/// The two lengths that precede compressed data.
void checkCompressed(const fs::path& file, const PcdHeader& header, std::uintmax_t points,
                     const PointSize& point) {
  const std::string bytes = readBytes(file, header.data_offset + 8);
  if (bytes.size() < header.data_offset + 8) checkSize(file, 0, "points", points, point.bytes);
  const auto length = [&](std::size_t at) {
    std::uintmax_t value = 0;
    for (std::size_t i = 4; i-- > 0;) {
      value = value << 8 |
              static_cast<unsigned char>(bytes[static_cast<std::size_t>(header.data_offset) + at + i]);
    }
    return value;
  };
  checkSize(file, fs::file_size(file) - header.data_offset - 8, "compressed bytes", length(0), 1);
  if (length(4) != points * point.bytes) throw badHeader(file, "length of the compressed data");
}

/// A property of a PLY element; `list_bytes` > 0 for a list: the size of its length.
struct PlyProperty {
  std::string name;
  std::uintmax_t bytes = 0;
  std::uintmax_t list_bytes = 0;
};

struct PlyElement {
  std::string name;
  std::uintmax_t count = 0;
  std::vector<PlyProperty> properties;

  /// The least that one row takes, with empty lists.
  std::uintmax_t leastBytes(bool ascii) const {
    std::uintmax_t sum = 0;
    for (const PlyProperty& p : properties) sum += ascii ? 2 : (p.list_bytes > 0 ? p.list_bytes : p.bytes);
    return sum;
  }
};

struct PlyHeader {
  bool ascii = false;
  std::vector<PlyElement> elements;
  std::uintmax_t data_offset = 0;
};

std::uintmax_t plyTypeSize(const std::string& type, const fs::path& file) {
  static const std::map<std::string, int> kSizes = {
      {"char", 1},   {"int8", 1},    {"uchar", 1},  {"uint8", 1},  {"short", 2}, {"int16", 2},
      {"ushort", 2}, {"uint16", 2},  {"int", 4},    {"int32", 4},  {"uint", 4},  {"uint32", 4},
      {"float", 4},  {"float32", 4}, {"double", 8}, {"float64", 8}};
  const auto found = kSizes.find(type);
  if (found == kSizes.end()) throw badHeader(file, "unknown type '" + type + "'");
  return static_cast<std::uintmax_t>(found->second);
}

PlyProperty readPlyProperty(const std::vector<std::string>& line, const fs::path& file) {
  const bool list = line.size() == 5 && line[1] == "list";
  if (!list && line.size() != 3) throw badHeader(file, "a property line");
  PlyProperty property;
  property.name = line.back();
  property.bytes = plyTypeSize(line[line.size() - 2], file);
  if (list) property.list_bytes = plyTypeSize(line[2], file);
  return property;
}

void readPlyLine(const std::vector<std::string>& line, const fs::path& file, PlyHeader& header) {
  if (line[0] == "format" && line.size() >= 2) {
    header.ascii = line[1] == "ascii";
  } else if (line[0] == "element") {
    PlyElement element;
    if (line.size() != 3 || !readCount(line[2], element.count)) throw badHeader(file, "an element line");
    element.name = line[1];
    header.elements.push_back(element);
  } else if (line[0] == "property") {
    if (header.elements.empty()) throw badHeader(file, "a property before any element");
    header.elements.back().properties.push_back(readPlyProperty(line, file));
  }
}

PlyHeader readPlyHeader(const fs::path& file) {
  std::istringstream lines(readBytes(file, kLongestHeader));
  PlyHeader header;
  std::string line;
  if (!std::getline(lines, line) || words(line) != std::vector<std::string>{"ply"})
    throw wrongType(file, "PLY");
  while (std::getline(lines, line)) {
    const std::vector<std::string> entry = words(line);
    if (entry.empty()) continue;
    if (entry[0] == "end_header") {
      header.data_offset = lines.eof() ? fs::file_size(file) : static_cast<std::uintmax_t>(lines.tellg());
      return header;
    }
    readPlyLine(entry, file, header);
  }
  throw badHeader(file, "no end_header");
}

/// Position of a colour byte among the properties, or npos.
std::size_t colorAt(const std::vector<PlyProperty>& properties, const std::string& name) {
  for (std::size_t i = 0; i < properties.size(); ++i) {
    const PlyProperty& property = properties[i];
    if (property.bytes == 1 && (property.name == name || property.name == "diffuse_" + name)) return i;
  }
  return std::string::npos;
}

bool colorsInOrder(const std::vector<PlyProperty>& properties) {
  const std::size_t none = std::string::npos;
  const std::size_t red = colorAt(properties, "red");
  const std::size_t green = colorAt(properties, "green");
  const std::size_t blue = colorAt(properties, "blue");
  const std::size_t alpha = colorAt(properties, "alpha");
  if (red == none) return green == none && blue == none && alpha == none;
  return green == red + 1 && blue == red + 2 && (alpha == none || alpha == red + 3);
}

void checkPlyVertex(const PlyElement& vertex, const fs::path& file) {
  for (const PlyProperty& property : vertex.properties) {
    if (property.list_bytes == 0) continue;
    throw fileError(file.string(), "has a list property '" + property.name +
                                       "' on its vertices, which cannot be read; remove that property");
  }
  if (!colorsInOrder(vertex.properties)) {
    throw fileError(file.string(),
                    "its vertex colours are not red, green, blue (, alpha) in this order; reorder them");
  }
}

}  // namespace

std::uintmax_t checkPcdHeader(const fs::path& file) {
  const PcdHeader header = readPcdHeader(file);
  const PointSize point = pcdPointSize(header, file);
  const std::uintmax_t points = header.count("POINTS", file);
  const std::uintmax_t width = header.count("WIDTH", file);
  const std::uintmax_t height = header.has("HEIGHT") ? header.count("HEIGHT", file) : 1;
  if (width > UINT32_MAX || height > UINT32_MAX || width * height != points) {
    throw badHeader(file, "POINTS is not WIDTH x HEIGHT");
  }
  const std::uintmax_t available = fs::file_size(file) - header.data_offset;
  const std::string& storage = header.has("DATA") ? header.entries.at("DATA")[0] : std::string();
  if (points == 0) throw fileError(file.string(), "holds no points (POINTS 0); give a file with points");
  if (storage == "ascii") {
    checkSize(file, available + 1, "points", points, 2 * point.values);
    checkRows(file, header.data_offset, points, point.values);
  } else if (storage == "binary") {
    checkSize(file, available, "points", points, point.bytes);
  } else if (storage == "binary_compressed") {
    checkCompressed(file, header, points, point);
  } else {
    throw badHeader(file, "DATA is neither ascii, binary nor binary_compressed");
  }
  return points * point.bytes;
}

std::size_t checkPlyHeader(const fs::path& file) {
  const PlyHeader header = readPlyHeader(file);
  // In text, the last line needs no line end.
  std::uintmax_t available = fs::file_size(file) - header.data_offset + (header.ascii ? 1 : 0);
  const PlyElement* vertex = nullptr;
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex") vertex = &element;
    checkSize(file, available, "'" + element.name + "' rows", element.count,
              element.leastBytes(header.ascii));
    available -= std::min(available, element.count * element.leastBytes(header.ascii));
  }
  if (vertex == nullptr) throw fileError(file.string(), "has no 'vertex' element; give a file with points");
  if (vertex->count == 0)
    throw fileError(file.string(), "holds no points (element vertex 0); give a file with points");
  checkPlyVertex(*vertex, file);
  const bool at_start = vertex == &header.elements.front();
  if (header.ascii && at_start) checkRows(file, header.data_offset, vertex->count, vertex->properties.size());
  return static_cast<std::size_t>(vertex->count);
}

void checkStlLength(const fs::path& file) {
  constexpr std::size_t kHead = 84, kTriangle = 50;  // bytes; the head ends with the number of triangles
  const std::string head = readBytes(file, kHead);
  std::uintmax_t triangles = 0;
  for (std::size_t i = head.size() == kHead ? kHead : 0; i > kHead - 4 && i <= kHead; --i)
    triangles = triangles << 8 | static_cast<unsigned char>(head[i - 1]);
  if (head.size() == kHead && fs::file_size(file) == kHead + triangles * kTriangle) return;
  const std::string text = words(head).empty() ? std::string() : words(head)[0];
  if (text != "solid") {
    if (head.size() < kHead) throw wrongType(file, "STL");
    return checkSize(file, fs::file_size(file) - kHead, "triangles", triangles, kTriangle);
  }
  if (readBytes(file).find("endsolid") == std::string::npos)
    throw fileError(file.string(), "is cut off: text STL without 'endsolid'; copy the file again");
}

void checkVtpHeader(const fs::path& file) {
  if (readBytes(file, 4096).find("<VTKFile") == std::string::npos) throw wrongType(file, "VTK XML");
}

}  // namespace mlsmesh::apps
