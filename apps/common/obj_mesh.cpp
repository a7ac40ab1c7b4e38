// SPDX-License-Identifier: BSD-3-Clause
#include "common/obj_mesh.h"

#include "common/app_error.h"
#include "common/file_bytes.h"
#include "common/text_lines.h"

#include <charconv>
#include <string>

namespace mlsmesh::apps {

namespace {

bool isStatement(std::string_view line, char keyword) {
  return line.size() > 1 && line[0] == keyword && isSeparator(line[1]);
}

bool appendVertex(std::string_view line, std::vector<double>& numbers, PolygonSoup& soup) {
  numbers.clear();
  if (!appendNumbers(trimSeparators(line.substr(1)), numbers) || numbers.size() < 3) return false;
  soup.vertices.emplace_back(numbers[0], numbers[1], numbers[2]);
  return true;
}

/// Corners "vertex", "vertex/texture", "vertex//normal", ...; vertices count from 1, or backwards from -1.
bool appendFace(std::string_view line, PolygonSoup& soup) {
  for (line = trimSeparators(line.substr(1)); !line.empty(); line = trimSeparators(line)) {
    std::int64_t number = 0;
    const std::from_chars_result end = std::from_chars(line.data(), line.data() + line.size(), number);
    if (end.ec != std::errc()) return false;
    soup.corners.push_back(number < 0 ? static_cast<std::int64_t>(soup.vertices.size()) + number
                                      : number - 1);
    std::size_t length = static_cast<std::size_t>(end.ptr - line.data());
    if (length < line.size() && line[length] != '/' && !isSeparator(line[length])) return false;
    while (length < line.size() && !isSeparator(line[length])) ++length;
    line.remove_prefix(length);
  }
  soup.endPolygon();
  return true;
}

}  // namespace

PolygonSoup readObjMesh(const std::filesystem::path& file) {
  const std::string content = readBytes(file);
  if (content.find('\0') != std::string::npos) {
    throw fileError(file.string(),
                    "holds binary data, not OBJ text; give the file the extension of its format");
  }
  PolygonSoup soup;
  TextLines lines(content);
  std::string_view line;
  std::vector<double> numbers;
  while (lines.next(line)) {
    if (isStatement(line, 'v') && !appendVertex(line, numbers, soup))
      throw lineError(file.string(), lines, line, "is not a vertex 'v x y z'; correct it");
    if (isStatement(line, 'f') && !appendFace(line, soup))
      throw lineError(file.string(), lines, line, "is not a face 'f 1 2 3'; correct it");
  }
  if (!soup.vertices.empty()) return soup;
  throw fileError(file.string(), "holds no vertices ('v x y z' lines); is it a Wavefront OBJ file?");
}

}  // namespace mlsmesh::apps
