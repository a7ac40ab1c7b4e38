// SPDX-License-Identifier: BSD-3-Clause
#include "common/text_cloud.h"

#include "common/app_error.h"
#include "common/cloud_columns.h"
#include "common/text_lines.h"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace mlsmesh::apps {

namespace {

using Type = pcl::PCLPointField::PointFieldTypes;

void refuseBinary(const std::string& content, const std::string& file, const std::string& format) {
  if (content.find('\0') == std::string::npos) return;
  throw fileError(file,
                  "holds binary data, not " + format + " text; give the file the extension of its format");
}

/// Rows of equally many numbers, one after the other.
struct NumberTable {
  std::vector<double> numbers;
  std::size_t columns = 0;

  std::size_t rows() const { return columns == 0 ? 0 : numbers.size() / columns; }
  std::vector<double> column(std::size_t index) const {
    std::vector<double> values(rows());
    for (std::size_t row = 0; row < values.size(); ++row) values[row] = numbers[row * columns + index];
    return values;
  }
};

bool isComment(std::string_view line) {
  return line.front() == '#' || line.substr(0, 2) == "//";
}

void checkRow(const NumberTable& table, std::size_t added, const std::string& file, const TextLines& lines,
              std::string_view line) {
  constexpr std::size_t kMostColumns = 10000;
  if (added > kMostColumns)
    throw lineError(file, lines, line, "too many numbers in a line; every line is one point");
  if (added < 3) throw lineError(file, lines, line, "fewer than three numbers; every line needs x y z");
  if (added != table.columns) {
    throw lineError(file, lines, line,
                    std::to_string(added) + " numbers where the first point has " +
                        std::to_string(table.columns) + "; correct the line");
  }
}

/// What the first line may be instead of a point.
struct FirstLine {
  bool heading = false;
  std::size_t announced = 0;  ///< number of points, 0 if not said
};

FirstLine readFirstLine(std::string_view line) {
  FirstLine first;
  std::vector<double> numbers;
  if (!appendNumbers(line, numbers)) {
    first.heading = numbers.empty();
  } else if (numbers.size() == 1 && numbers[0] >= 1 && numbers[0] == std::floor(numbers[0]) &&
             numbers[0] < 1e15) {
    first.heading = true;
    first.announced = static_cast<std::size_t>(numbers[0]);
  }
  return first;
}

NumberTable readTable(const std::string& content, const std::string& file) {
  NumberTable table;
  TextLines lines(content);
  FirstLine first;
  std::string_view line;
  bool at_start = true;
  while (lines.next(line)) {
    if (isComment(line)) continue;
    if (at_start) first = readFirstLine(line);
    const bool skip = at_start && first.heading;
    at_start = false;
    if (skip) continue;
    const std::size_t before = table.numbers.size();
    if (!appendNumbers(line, table.numbers))
      throw lineError(file, lines, line, "is not a row of numbers; correct it");
    if (table.columns == 0) table.columns = table.numbers.size();
    checkRow(table, table.numbers.size() - before, file, lines, line);
  }
  if (table.rows() == 0) throw fileError(file, "holds no points; write lines of x y z");
  if (first.announced > table.rows()) {
    throw fileError(file, "is cut off: it announces " + std::to_string(first.announced) +
                              " points and holds " + std::to_string(table.rows()) + "; copy the file again");
  }
  return table;
}

bool areBytes(const NumberTable& table, std::size_t first) {
  double largest = 0;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    for (std::size_t c = first; c < first + 3; ++c) {
      const double value = table.numbers[row * table.columns + c];
      if (!(value >= 0 && value <= 255 && value == std::floor(value))) return false;
      largest = std::max(largest, value);
    }
  }
  return largest > 1;
}

void appendFloats(const NumberTable& table, const std::vector<std::string>& names,
                  std::vector<CloudColumn>& columns) {
  for (std::size_t i = 0; i < names.size(); ++i)
    columns.push_back({names[i], Type::FLOAT32, table.column(3 + i)});
}

void appendAttributes(const NumberTable& table, std::vector<CloudColumn>& columns) {
  const std::size_t count = table.columns;
  const std::size_t color_at = count == 6 ? 3 : 4;
  if ((count == 6 || count == 7) && areBytes(table, color_at)) {
    if (count == 7) appendFloats(table, {"intensity"}, columns);
    columns.push_back(
        colorColumn(table.column(color_at), table.column(color_at + 1), table.column(color_at + 2)));
  } else if (count == 4) {
    appendFloats(table, {"intensity"}, columns);
  } else if (count == 6) {
    appendFloats(table, {"normal_x", "normal_y", "normal_z"}, columns);
  } else {
    std::vector<std::string> names;
    for (std::size_t c = 4; c <= count; ++c) names.push_back("column_" + std::to_string(c));
    appendFloats(table, names, columns);
  }
}

/// Vertices of an OBJ file and their colours, as long as all have one.
struct ObjVertices {
  std::vector<double> x, y, z;
  std::vector<double> red, green, blue;

  void add(const std::vector<double>& numbers) {
    x.push_back(numbers[0]);
    y.push_back(numbers[1]);
    z.push_back(numbers[2]);
    if (numbers.size() < 6) return;
    const std::size_t first = numbers.size() - 3;
    red.push_back(numbers[first]);
    green.push_back(numbers[first + 1]);
    blue.push_back(numbers[first + 2]);
  }
};

/// OBJ colours are 0 .. 1; some programs write 0 .. 255.
void scaleToBytes(ObjVertices& vertices) {
  double largest = 0;
  for (const auto* channel : {&vertices.red, &vertices.green, &vertices.blue}) {
    for (const double value : *channel) largest = std::max(largest, value);
  }
  if (largest > 1) return;
  for (auto* channel : {&vertices.red, &vertices.green, &vertices.blue}) {
    for (double& value : *channel) value *= 255;
  }
}

}  // namespace

void readXyz(const std::string& content, const std::string& file, pcl::PCLPointCloud2& cloud) {
  refuseBinary(content, file, "XYZ");
  const NumberTable table = readTable(content, file);
  std::vector<CloudColumn> columns = coordinateColumns(table.column(0), table.column(1), table.column(2));
  appendAttributes(table, columns);
  makeCloud(columns, cloud);
}

void readObj(const std::string& content, const std::string& file, pcl::PCLPointCloud2& cloud) {
  refuseBinary(content, file, "OBJ");
  ObjVertices vertices;
  TextLines lines(content);
  std::string_view line;
  std::vector<double> numbers;
  while (lines.next(line)) {
    if (line.size() < 2 || line[0] != 'v' || !isSeparator(line[1])) continue;
    numbers.clear();
    if (!appendNumbers(trimSeparators(line.substr(1)), numbers) || numbers.size() < 3) {
      throw lineError(file, lines, line, "is not a vertex 'v x y z'; correct it");
    }
    vertices.add(numbers);
  }
  const std::size_t count = vertices.x.size();
  if (count == 0) throw fileError(file, "holds no vertices ('v x y z' lines); is it a Wavefront OBJ file?");
  std::vector<CloudColumn> columns =
      coordinateColumns(std::move(vertices.x), std::move(vertices.y), std::move(vertices.z));
  if (vertices.red.size() == count) {
    scaleToBytes(vertices);
    columns.push_back(colorColumn(vertices.red, vertices.green, vertices.blue));
  }
  makeCloud(columns, cloud);
}

}  // namespace mlsmesh::apps
