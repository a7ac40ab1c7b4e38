// SPDX-License-Identifier: BSD-3-Clause
#include "common/stl_mesh.h"

#include "common/app_error.h"
#include "common/file_bytes.h"
#include "common/text_lines.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace mlsmesh::apps {

namespace {

constexpr std::size_t kHead = 84, kTriangle = 50;  // bytes; the head ends with the number of triangles

std::uintmax_t announcedTriangles(const std::string& content) {
  std::uintmax_t triangles = 0;
  for (std::size_t i = kHead; i > kHead - 4; --i)
    triangles = triangles << 8 | static_cast<unsigned char>(content[i - 1]);
  return triangles;
}

/// A normal, three corners, two bytes more; numbers with their lowest byte first, as on this machine.
PolygonSoup readBinary(const std::string& content) {
  PolygonSoup soup;
  for (std::size_t at = kHead; at < content.size(); at += kTriangle) {
    for (std::size_t corner = 1; corner <= 3; ++corner) {
      float place[3];
      std::memcpy(place, content.data() + at + 12 * corner, sizeof place);
      soup.corners.push_back(static_cast<std::int64_t>(soup.vertices.size()));
      soup.vertices.emplace_back(place[0], place[1], place[2]);
    }
    soup.endPolygon();
  }
  return soup;
}

/// Whether a line begins with a word, in letters of either size; it is then taken off.
bool takeWord(std::string_view& line, std::string_view word) {
  const bool is_there =
      line.size() >= word.size() &&
      std::equal(word.begin(), word.end(), line.begin(),
                 [](char a, char b) { return a == std::tolower(static_cast<unsigned char>(b)); }) &&
      (line.size() == word.size() || isSeparator(line[word.size()]));
  if (is_there) line = trimSeparators(line.substr(word.size()));
  return is_there;
}

PolygonSoup readText(const std::string& content, const std::string& file) {
  PolygonSoup soup;
  TextLines lines(content);
  std::vector<double> numbers;
  bool is_ended = false;
  for (std::string_view line; lines.next(line);) {
    const std::string_view whole = line;
    is_ended = is_ended || takeWord(line, "endsolid");
    if (takeWord(line, "endloop")) {
      if (soup.vertices.size() != 3 * (soup.polygonCount() + 1))
        throw lineError(file, lines, whole, "ends a face that has not three corners; write the file again");
      soup.endPolygon();
    }
    if (!takeWord(line, "vertex")) continue;
    numbers.clear();
    if (!appendNumbers(line, numbers) || numbers.size() != 3)
      throw lineError(file, lines, whole, "is not a corner 'vertex x y z'; correct it");
    soup.corners.push_back(static_cast<std::int64_t>(soup.vertices.size()));
    soup.vertices.emplace_back(numbers[0], numbers[1], numbers[2]);
  }
  if (!is_ended) throw fileError(file, "is cut off: text STL without 'endsolid'; copy the file again");
  return soup;
}

}  // namespace

PolygonSoup readStlMesh(const std::filesystem::path& file) {
  const std::string content = readBytes(file);
  const std::string name = file.string();
  const bool has_head = content.size() >= kHead;
  const std::uintmax_t triangles = has_head ? announcedTriangles(content) : 0;
  PolygonSoup soup;
  std::string_view start = trimSeparators(std::string_view(content).substr(0, content.find('\n')));
  if (has_head && content.size() == kHead + triangles * kTriangle) {
    soup = readBinary(content);
  } else if (takeWord(start, "solid") && content.find('\0') == std::string::npos) {
    soup = readText(content, name);
  } else if (has_head) {
    throw fileError(name, "is cut off or has too much: its header announces " + std::to_string(triangles) +
                              " triangles, the file holds " + std::to_string(content.size() - kHead) +
                              " bytes of data; copy the file again");
  } else {
    throw fileError(name, "is not a STL file; give the file the extension of its format");
  }
  if (soup.vertices.empty()) throw fileError(name, "holds no points; give a file with a mesh");
  return soup;
}

}  // namespace mlsmesh::apps
