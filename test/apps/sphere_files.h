// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

namespace mlsmesh::test {

/// A point of the unit sphere, its colour (the position, scaled to bytes) and its label (the octant).
struct SpherePoint {
  std::array<double, 3> position = {};
  std::array<int, 3> color = {};
  int label = 0;
};

/// Evenly spread points.
std::vector<SpherePoint> spherePoints(int count);
std::array<int, 3> colorAt(const std::array<double, 3>& position);
int octantOf(const std::array<double, 3>& position);

// The sphere as the content of a file, with colour and label where the format has them.
std::string spherePcd(int count);
std::string spherePly(int count);
/// With double coordinates: radius `radius` around `center`.
std::string sphereDoublePly(int count, double radius, const std::array<double, 3>& center);
std::string sphereObj(int count);
std::string sphereVtk(int count);
std::string sphereXyz(int count);

/// A binary little-endian PLY mesh: header, one column a vertex property, faces.
struct PlyMesh {
  std::string header;
  std::vector<std::string> names;
  std::vector<std::vector<double>> rows;  ///< one a vertex, values in the order of names
  std::vector<std::array<int, 3>> faces;

  /// Position of a property in the rows; throws std::out_of_range if there is none.
  std::size_t column(const std::string& name) const;
  /// Rows reduced to some columns, sorted.
  std::vector<std::vector<double>> sorted(const std::vector<std::string>& columns) const;
};

/// Throws std::runtime_error unless the content is a whole binary PLY of triangles with nothing behind.
PlyMesh parsePly(const std::string& content);

}  // namespace mlsmesh::test
