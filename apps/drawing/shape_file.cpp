// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/shape_file.h"

#include "common/app_error.h"
#include "common/cloud_columns.h"
#include "common/cloud_io.h"
#include "common/file_bytes.h"
#include "common/mesh_reader.h"

#include <algorithm>
#include <optional>

namespace mlsmesh::apps {
namespace {

namespace fs = std::filesystem;

/// Three fields of a cloud that belong together.
class Triple {
 public:
  Triple(const pcl::PCLPointCloud2& cloud, const std::vector<FieldSlot>& slots,
         const std::array<const char*, 3>& names)
      : cloud_(cloud) {
    std::transform(names.begin(), names.end(), slots_.begin(),
                   [&](const char* name) { return findSlot(slots, name); });
  }

  bool isWhole() const { return std::find(slots_.begin(), slots_.end(), nullptr) == slots_.end(); }
  core::Vec3 at(std::size_t point) const {
    return {slotValue(cloud_, *slots_[0], point), slotValue(cloud_, *slots_[1], point),
            slotValue(cloud_, *slots_[2], point)};
  }

 private:
  const pcl::PCLPointCloud2& cloud_;
  std::array<const FieldSlot*, 3> slots_{};
};

/// Reads points one by one, with what they carry.
class PointReader {
 public:
  explicit PointReader(const pcl::PCLPointCloud2& cloud)
      : slots_(fieldSlots(cloud)),
        position_(cloud, slots_, {"x", "y", "z"}),
        normal_(cloud, slots_, {"nx", "ny", "nz"}),
        color_(cloud, slots_, {"red", "green", "blue"}) {}

  core::Vec3 position(std::size_t point) const { return position_.at(point); }
  /// Adds colour and normal, where there are any.
  void addAttributes(std::size_t point, Shape& shape) const {
    if (normal_.isWhole()) {
      const core::Vec3 normal = normal_.at(point);
      shape.normals.push_back(normal.allFinite() ? normal : core::Vec3(0, 0, 0));
    }
    if (!color_.isWhole()) return;
    const core::Vec3 color = color_.at(point).cwiseMax(0.0).cwiseMin(255.0);
    shape.colors.push_back({static_cast<std::uint8_t>(color[0]), static_cast<std::uint8_t>(color[1]),
                            static_cast<std::uint8_t>(color[2])});
  }

 private:
  std::vector<FieldSlot> slots_;
  Triple position_, normal_, color_;
};

bool canHoldMesh(const fs::path& file) {
  static const std::array<const char*, 5> kExtensions{"ply", "obj", "stl", "vtk", "vtp"};
  return std::find(kExtensions.begin(), kExtensions.end(), extensionOf(file)) != kExtensions.end();
}

/// Colours and normals of the vertices; none if the file has no such fields, or is of a type that has no
/// fields.
void addVertexAttributes(const fs::path& file, Shape& shape) {
  if (extensionOf(file) == "stl") return;
  pcl::PCLPointCloud2 cloud;
  try {
    readCloud(file, cloud);
  } catch (const AppError&) {
    return;
  }
  if (pointCount(cloud) != shape.points.size()) return;
  const PointReader reader(cloud);
  for (std::size_t i = 0; i < shape.points.size(); ++i) reader.addAttributes(i, shape);
}

/// The mesh, if the file holds one.
std::optional<ShapeFile> readMesh(const fs::path& file) {
  TriangleFile mesh = readTriangles(file);
  if (mesh.triangles.empty()) return std::nullopt;
  ShapeFile result;
  result.shape.points = std::move(mesh.vertices);
  result.shape.triangles = std::move(mesh.triangles);
  addVertexAttributes(file, result.shape);
  if (result.shape.normals.empty())
    result.shape.normals = core::vertexNormals(result.shape.triangles, result.shape.points);
  if (mesh.dropped_faces > 0) {
    result.warnings.push_back(
        file.string() + ": " + std::to_string(mesh.dropped_faces) +
        " faces are not drawn: fewer than three corners, or a vertex that is absent or not finite");
  }
  return result;
}

ShapeFile readPoints(const fs::path& file) {
  ShapeFile result;
  readCloud(file, result.cloud);
  result.shape = cloudShape(result.cloud, file);
  return result;
}

/// A legacy VTK file whose data set is not polygons may still be a cloud.
ShapeFile readVtkPoints(const fs::path& file, const AppError& why_no_mesh) {
  ShapeFile result;
  try {
    result = readPoints(file);
  } catch (const AppError&) {
    throw why_no_mesh;
  }
  result.warnings.push_back(std::string(why_no_mesh.what()) + "; shown as points");
  return result;
}

}  // namespace

Shape cloudShape(const pcl::PCLPointCloud2& cloud, const fs::path& file) {
  const PointReader reader(cloud);
  Shape shape;
  for (std::size_t i = 0; i < pointCount(cloud); ++i) {
    const core::Vec3 position = reader.position(i);
    if (!position.allFinite()) continue;
    shape.points.push_back(position);
    reader.addAttributes(i, shape);
  }
  if (shape.points.empty())
    throw fileError(file.string(), "holds no finite point; give a file with points to draw");
  return shape;
}

ShapeFile readShape(const fs::path& file) {
  checkReadable(file);
  try {
    std::optional<ShapeFile> mesh = canHoldMesh(file) ? readMesh(file) : std::nullopt;
    return mesh ? std::move(*mesh) : readPoints(file);
  } catch (const AppError& error) {
    if (extensionOf(file) != "vtk") throw;
    return readVtkPoints(file, error);
  }
}

}  // namespace mlsmesh::apps
