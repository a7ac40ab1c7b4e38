// SPDX-License-Identifier: BSD-3-Clause
#include "common/app_error.h"
#include "common/file_bytes.h"
#include "common/header_check.h"
#include "common/header_parts.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace mlsmesh::apps {

namespace fs = std::filesystem;

namespace {

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

template <class Named>
bool hasName(const std::vector<Named>& list, const std::string& name) {
  return std::any_of(list.begin(), list.end(), [&](const Named& item) { return item.name == name; });
}

void readPlyLine(const std::vector<std::string>& line, const fs::path& file, PlyHeader& header) {
  if (line[0] == "format" && line.size() >= 2) {
    header.ascii = line[1] == "ascii";
  } else if (line[0] == "element") {
    PlyElement element;
    if (line.size() != 3 || !readCount(line[2], element.count)) throw badHeader(file, "an element line");
    element.name = line[1];
    if (hasName(header.elements, element.name)) throw badHeader(file, "element '" + element.name + "' twice");
    header.elements.push_back(element);
  } else if (line[0] == "property") {
    if (header.elements.empty()) throw badHeader(file, "a property before any element");
    const PlyProperty property = readPlyProperty(line, file);
    std::vector<PlyProperty>& properties = header.elements.back().properties;
    if (hasName(properties, property.name)) throw badHeader(file, "property '" + property.name + "' twice");
    properties.push_back(property);
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

/// One line a row: those of the elements before the vertices, then the vertices.
void checkPlyRows(const fs::path& file, const PlyHeader& header, const PlyElement& vertex) {
  std::uintmax_t rows_before = 0;
  for (const PlyElement* element = header.elements.data(); element != &vertex; ++element)
    rows_before += element->count;
  for (const PlyProperty& property : vertex.properties)
    if (property.list_bytes > 0) return;
  checkRows(file, header.data_offset, rows_before, vertex.count, vertex.properties.size());
}

}  // namespace

std::size_t checkPlyHeader(const fs::path& file) {
  const PlyHeader header = readPlyHeader(file);
  // In text, the last line needs no line end.
  std::uintmax_t available = fs::file_size(file) - header.data_offset + (header.ascii ? 1 : 0);
  const PlyElement* vertex = nullptr;
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex") vertex = &element;
    if (element.properties.empty() && element.count > 0)
      throw badHeader(file, "no properties of element '" + element.name + "'");
    checkSize(file, available, "'" + element.name + "' rows", element.count,
              element.leastBytes(header.ascii));
    available -= std::min(available, element.count * element.leastBytes(header.ascii));
  }
  if (vertex == nullptr) throw fileError(file.string(), "has no 'vertex' element; give a file with points");
  if (vertex->count == 0)
    throw fileError(file.string(), "holds no points (element vertex 0); give a file with points");
  if (header.ascii) checkPlyRows(file, header, *vertex);
  return static_cast<std::size_t>(vertex->count);
}

}  // namespace mlsmesh::apps
