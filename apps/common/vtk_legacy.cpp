// SPDX-License-Identifier: BSD-3-Clause
#include "common/vtk_legacy.h"

#include "common/legacy_walk.h"
#include "common/point_arrays.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace mlsmesh::apps {

namespace {

using Type = pcl::PCLPointField::PointFieldTypes;
using Words = LegacyWalk::Words;

bool isCellList(const std::string& keyword) {
  static const Words kKeywords = {"VERTICES", "LINES", "POLYGONS", "TRIANGLE_STRIPS", "CELLS"};
  return std::find(kKeywords.begin(), kKeywords.end(), keyword) != kKeywords.end();
}

/// Three numbers a point, and their type.
struct Points {
  std::vector<double> coordinates;
  std::uint8_t type = 0;

  std::size_t size() const { return coordinates.size() / 3; }
};

Points readPoints(LegacyWalk& walk, const Words& line) {
  if (line.size() != 3) throw walk.damaged("the line POINTS is not whole");
  Points points;
  points.coordinates = walk.numbers(walk.count(line, 1), 3, line[2]);
  points.type = legacyType(line[2]) == Type::FLOAT64 ? Type::FLOAT64 : Type::FLOAT32;
  return points;
}

/// Names hold blanks and the like as %20.
std::string decodedName(const std::string& name) {
  std::string text;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const std::string digits = name[i] == '%' ? name.substr(i + 1, 2) : "";
    const bool is_code =
        digits.size() == 2 && digits.find_first_not_of("0123456789abcdefABCDEF") == std::string::npos;
    text += is_code ? static_cast<char>(std::stoi(digits, nullptr, 16)) : name[i];
    if (is_code) i += 2;
  }
  return text;
}

/// The point data, array by array.
class Attributes {
 public:
  Attributes(LegacyWalk& walk, std::size_t points, std::vector<CloudColumn>& columns)
      : walk_(walk), points_(points), columns_(columns) {}

  /// Up to the end, the data of cells, or what is not known.
  void read() {
    while (!walk_.atEnd() && readNext(walk_.nextLine())) {
    }
  }

 private:
  bool readNext(const Words& line) {
    const std::string& keyword = line[0];
    if (keyword.empty()) return true;
    if (keyword == "METADATA") return skipMetadata();
    if (keyword == "FIELD") return readFields(line);
    if (keyword == "LOOKUP_TABLE") return skipTable(line);
    if (keyword == "COLOR_SCALARS") return readColors(line);
    if (keyword == "SCALARS") return readScalars(line);
    if (keyword == "TEXTURE_COORDINATES")
      return line.size() == 4 && take(line[1], line[3], walk_.count(line, 2));
    if (line.size() != 3) return false;
    if (keyword == "NORMALS") return take(line[1], line[2], 3, true);
    if (keyword == "VECTORS") return take(line[1], line[2], 3);
    if (keyword == "TENSORS") return take(line[1], line[2], 9);
    if (keyword == "TENSORS6") return take(line[1], line[2], 6);
    return (keyword == "GLOBAL_IDS" || keyword == "PEDIGREE_IDS") && take(line[1], line[2], 1);
  }

  /// Lines up to a blank one.
  bool skipMetadata() {
    while (!walk_.atEnd() && !walk_.nextLine()[0].empty()) {
    }
    return true;
  }

  bool take(const std::string& name, const std::string& type, std::size_t components,
            bool is_normals = false) {
    const std::uint8_t field = legacyType(type);
    if (field == 0) return false;
    const std::vector<double> values = walk_.numbers(points_, components, type);
    appendPointArray({decodedName(name), field, components, is_normals}, values, columns_);
    return true;
  }

  bool readScalars(const Words& line) {
    if ((line.size() != 3 && line.size() != 4) || legacyType(line[2]) == 0) return false;
    const std::size_t components = line.size() == 4 ? walk_.count(line, 3) : 1;
    if (walk_.nextFilledLine()[0] != "LOOKUP_TABLE") throw walk_.damaged("SCALARS without LOOKUP_TABLE");
    return take(line[1], line[2], components);
  }

  /// Bytes, or numbers from 0 to 1 in text.
  bool readColors(const Words& line) {
    const std::size_t components = walk_.count(line, 2);
    std::vector<double> values =
        walk_.numbers(points_, components, walk_.isBinary() ? "unsigned_char" : "float");
    if (!walk_.isBinary())
      for (double& value : values) value = std::floor(255 * value + 0.5);
    appendPointArray({decodedName(line[1]), Type::UINT8, components, false}, values, columns_);
    return true;
  }

  bool skipTable(const Words& line) {
    walk_.skipNumbers(walk_.count(line, 2), 4, walk_.isBinary() ? "unsigned_char" : "float");
    return true;
  }

  bool readFields(const Words& line) {
    for (std::size_t left = walk_.count(line, 2); left > 0 && !walk_.atEnd();) {
      const Words array = walk_.nextFilledLine();
      if (array[0] == "METADATA") {
        skipMetadata();
        continue;
      }
      if (array.size() != 4) return false;
      --left;
      if (walk_.count(array, 2) != points_) {
        walk_.skipNumbers(walk_.count(array, 1), walk_.count(array, 2), array[3]);
      } else if (!take(walk_.lastName(), array[3], walk_.count(array, 1))) {
        return false;
      }
    }
    return true;
  }

  LegacyWalk& walk_;
  std::size_t points_;
  std::vector<CloudColumn>& columns_;
};

/// Every other triangle of a strip is listed the other way round.
void appendStrips(const LegacyWalk::Cells& strips, PolygonSoup& soup) {
  std::size_t first = 0;
  for (const std::size_t end : strips.ends) {
    for (std::size_t i = first + 2; i < end; ++i) {
      const std::size_t odd = (i - first) % 2;
      for (const std::size_t place : {i - 2 + odd, i - 1 - odd, i})
        soup.corners.push_back(strips.corners[place]);
      soup.endPolygon();
    }
    first = end;
  }
}

void appendPolygons(const LegacyWalk::Cells& polygons, PolygonSoup& soup) {
  std::size_t first = 0;
  for (const std::size_t end : polygons.ends) {
    for (; first < end; ++first) soup.corners.push_back(polygons.corners[first]);
    soup.endPolygon();
  }
}

AppError noPoints(const std::string& file) {
  return fileError(file, "holds no POINTS; give a file with points");
}

}  // namespace

std::vector<CloudColumn> cloudOfLegacyVtk(const std::string& content, const std::string& file) {
  LegacyWalk walk(content, file);
  Points points;
  std::vector<CloudColumn> data;
  while (!walk.atEnd() && data.empty()) {
    const Words line = walk.nextLine();
    if (line[0] == "POINTS") points = readPoints(walk, line);
    if (line[0] == "FIELD") walk.skipFields(line);
    if (isCellList(line[0])) walk.skipCells(line);
    if (line[0] == "CELL_TYPES") walk.skipNumbers(walk.count(line, 1), 1, "int");
    if (line[0] == "CELL_DATA") walk.skipTo("POINT_DATA");
    if (line[0] != "POINT_DATA" || points.size() == 0) continue;
    if (walk.count(line, 1) != points.size()) throw walk.damaged("POINT_DATA of another number of points");
    Attributes(walk, points.size(), data).read();
    break;
  }
  if (points.size() == 0) throw noPoints(file);
  std::vector<CloudColumn> columns;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    columns.push_back({std::string(1, "xyz"[axis]), points.type, {}});
    for (std::size_t i = axis; i < points.coordinates.size(); i += 3)
      columns.back().values.push_back(points.coordinates[i]);
  }
  std::move(data.begin(), data.end(), std::back_inserter(columns));
  return columns;
}

PolygonSoup meshOfLegacyVtk(const std::string& content, const std::string& file) {
  LegacyWalk walk(content, file);
  bool is_polygons = false;
  Points points;
  PolygonSoup soup;
  LegacyWalk::Cells strips;
  for (Words line = {""}; !walk.atEnd() && line[0] != "CELL_DATA" && line[0] != "POINT_DATA";) {
    line = walk.nextLine();
    if (line[0] == "DATASET") is_polygons = line.size() == 2 && line[1] == "POLYDATA";
    if (line[0] == "POINTS") points = readPoints(walk, line);
    if (line[0] == "FIELD") walk.skipFields(line);
    if (!isCellList(line[0])) continue;
    LegacyWalk::Cells cells = walk.cells(line);
    if (line[0] == "POLYGONS") appendPolygons(cells, soup);
    if (line[0] == "TRIANGLE_STRIPS") strips = std::move(cells);
  }
  if (!is_polygons) throw fileError(file, "its data set is not POLYDATA; save the surface as polygons");
  if (points.size() == 0) throw noPoints(file);
  appendStrips(strips, soup);
  for (std::size_t i = 0; i < points.coordinates.size(); i += 3)
    soup.vertices.emplace_back(points.coordinates[i], points.coordinates[i + 1], points.coordinates[i + 2]);
  return soup;
}

}  // namespace mlsmesh::apps
