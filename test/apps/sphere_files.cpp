// SPDX-License-Identifier: BSD-3-Clause
#include "sphere_files.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iomanip>
#include <sstream>
#include <stdexcept>

namespace mlsmesh::test {

namespace {

constexpr double kGoldenAngle = 2.399963229728653;

std::ostringstream exactStream(int digits = 9) {
  std::ostringstream stream;
  stream << std::setprecision(digits);
  return stream;
}

void put(std::ostream& stream, const std::array<double, 3>& p) {
  stream << p[0] << ' ' << p[1] << ' ' << p[2];
}
void put(std::ostream& stream, const std::array<int, 3>& c) {
  stream << c[0] << ' ' << c[1] << ' ' << c[2];
}

double readValue(const std::string& content, std::size_t& position, const std::string& type) {
  const auto take = [&](auto value) {
    if (position + sizeof value > content.size()) throw std::runtime_error("PLY cut off");
    std::memcpy(&value, content.data() + position, sizeof value);
    position += sizeof value;
    return static_cast<double>(value);
  };
  if (type == "uchar") return take(std::uint8_t{});
  if (type == "int") return take(std::int32_t{});
  if (type == "uint") return take(std::uint32_t{});
  if (type == "float") return take(float{});
  if (type == "double") return take(double{});
  throw std::runtime_error("PLY type " + type);
}

}  // namespace

std::array<int, 3> colorAt(const std::array<double, 3>& position) {
  std::array<int, 3> color = {};
  for (std::size_t i = 0; i < 3; ++i) color[i] = static_cast<int>(std::lround(127.5 * (position[i] + 1)));
  return color;
}

int octantOf(const std::array<double, 3>& p) {
  return (p[0] > 0 ? 1 : 0) + (p[1] > 0 ? 2 : 0) + (p[2] > 0 ? 4 : 0);
}

std::vector<SpherePoint> spherePoints(int count) {
  std::vector<SpherePoint> points;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - 2 * (i + 0.5) / count;
    const double radius = std::sqrt(1 - z * z);
    const std::array<double, 3> p = {radius * std::cos(i * kGoldenAngle), radius * std::sin(i * kGoldenAngle),
                                     z};
    points.push_back({p, colorAt(p), octantOf(p)});
  }
  return points;
}

std::string spherePcd(int count) {
  std::ostringstream file = exactStream();
  file << "VERSION 0.7\nFIELDS x y z rgb label\nSIZE 4 4 4 4 4\nTYPE F F F U U\nCOUNT 1 1 1 1 1\nWIDTH "
       << count << "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " << count << "\nDATA ascii\n";
  for (const SpherePoint& point : spherePoints(count)) {
    put(file, point.position);
    file << ' ' << (point.color[0] << 16 | point.color[1] << 8 | point.color[2]) << ' ' << point.label
         << '\n';
  }
  return file.str();
}

std::string spherePly(int count) {
  std::ostringstream file = exactStream();
  file << "ply\nformat ascii 1.0\nelement vertex " << count
       << "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\nproperty uchar green\n"
          "property uchar blue\nproperty int label\nend_header\n";
  for (const SpherePoint& point : spherePoints(count)) {
    put(file, point.position);
    file << ' ';
    put(file, point.color);
    file << ' ' << point.label << '\n';
  }
  return file.str();
}

std::string sphereDoublePly(int count, double radius, const std::array<double, 3>& center) {
  std::ostringstream file = exactStream(17);
  file << "ply\nformat ascii 1.0\nelement vertex " << count
       << "\nproperty double x\nproperty double y\nproperty double z\nend_header\n";
  for (const SpherePoint& point : spherePoints(count)) {
    std::array<double, 3> p = {};
    for (std::size_t i = 0; i < 3; ++i) p[i] = center[i] + radius * point.position[i];
    put(file, p);
    file << '\n';
  }
  return file.str();
}

std::string sphereObj(int count) {
  std::ostringstream file = exactStream();
  file << "# a comment\n";
  for (const SpherePoint& point : spherePoints(count)) {
    file << "v ";
    put(file, point.position);
    for (const int channel : point.color) file << ' ' << channel / 255.0;
    file << '\n';
  }
  return file.str();
}

std::string sphereVtk(int count) {
  std::ostringstream file = exactStream();
  const std::vector<SpherePoint> points = spherePoints(count);
  file << "# vtk DataFile Version 3.0\na sphere\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS " << count
       << " float\n";
  for (const SpherePoint& point : points) {
    put(file, point.position);
    file << '\n';
  }
  file << "CELLS " << count << ' ' << 2 * count << '\n';
  for (int i = 0; i < count; ++i) file << "1 " << i << '\n';
  file << "CELL_TYPES " << count << '\n';
  for (int i = 0; i < count; ++i) file << "1\n";
  file << "POINT_DATA " << count << "\nSCALARS label int 1\nLOOKUP_TABLE default\n";
  for (const SpherePoint& point : points) file << point.label << '\n';
  file << "FIELD FieldData 1\nColors 3 " << count << " unsigned_char\n";
  for (const SpherePoint& point : points) {
    put(file, point.color);
    file << '\n';
  }
  return file.str();
}

std::string sphereXyz(int count) {
  std::ostringstream file = exactStream();
  file << "x y z r g b\n";
  for (const SpherePoint& point : spherePoints(count)) {
    file << point.position[0] << ", " << point.position[1] << ", " << point.position[2] << ", ";
    put(file, point.color);
    file << '\n';
  }
  return file.str();
}

std::size_t PlyMesh::column(const std::string& name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) throw std::out_of_range("no property " + name);
  return static_cast<std::size_t>(found - names.begin());
}

std::vector<std::vector<double>> PlyMesh::sorted(const std::vector<std::string>& columns) const {
  std::vector<std::vector<double>> chosen;
  for (const std::vector<double>& row : rows) {
    chosen.emplace_back();
    for (const std::string& name : columns) chosen.back().push_back(row[column(name)]);
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

PlyMesh parsePly(const std::string& content) {
  PlyMesh mesh;
  const std::string end = "end_header\n";
  std::size_t position = content.find(end);
  if (position == std::string::npos) throw std::runtime_error("no PLY");
  position += end.size();
  mesh.header = content.substr(0, position);
  std::istringstream header(mesh.header);
  std::vector<std::string> types;
  std::size_t vertices = 0;
  std::size_t faces = 0;
  for (std::string word; header >> word;) {
    std::string type;
    std::string name;
    if (word == "element" && header >> name) header >> (name == "vertex" ? vertices : faces);
    if (word != "property" || !(header >> type) || type == "list" || !(header >> name)) continue;
    types.push_back(type);
    mesh.names.push_back(name);
  }
  for (std::size_t i = 0; i < vertices; ++i) {
    mesh.rows.emplace_back();
    for (const std::string& type : types) mesh.rows.back().push_back(readValue(content, position, type));
  }
  for (std::size_t i = 0; i < faces; ++i) {
    if (readValue(content, position, "uchar") != 3) throw std::runtime_error("PLY face is no triangle");
    mesh.faces.emplace_back();
    for (int& corner : mesh.faces.back()) corner = static_cast<int>(readValue(content, position, "int"));
  }
  if (position != content.size()) throw std::runtime_error("PLY has bytes behind its end");
  return mesh;
}

}  // namespace mlsmesh::test
