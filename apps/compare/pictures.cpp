// SPDX-License-Identifier: BSD-3-Clause
#include "compare/pictures.h"

#include "common/app_error.h"
#include "common/mesh_reader.h"
#include "common/virtual_display.h"
#include "compare/loaded_cloud.h"
#include "compare/mark_colors.h"
#include "compare/mesh_props.h"
#include "compare/studio.h"
#include "mlsmesh/core/failure.h"
#include "mlsmesh/mesh_distance.h"

#include <vtkObject.h>

#include <Eigen/Geometry>

#include <optional>

namespace mlsmesh::apps {
namespace {

core::Vec3 middleOf(const std::vector<core::Vec3>& points) {
  Eigen::AlignedBox3d box;
  for (const core::Vec3& point : points) box.extend(point);
  return box.center();
}

Viewpoint viewpointOf(const std::string& view, const std::string& up, const core::Vec3& middle) {
  if (view == "sensor") return {middle.norm() > 0 ? core::Vec3(-middle) : core::Vec3(0, 0, -1), {0, -1, 0}};
  return namedViewpoint(view, up);
}

/// Distances in spacings.
std::vector<double> scaled(std::vector<double> distances, double spacing) {
  for (double& distance : distances) distance /= spacing;
  return distances;
}

std::vector<core::Vec3> centersOf(const Shape& mesh) {
  std::vector<core::Vec3> centers;
  centers.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles)
    centers.emplace_back((mesh.points[a] + mesh.points[b] + mesh.points[c]) / 3);
  return centers;
}

/// Draws what belongs to one cloud, moved so that the middle of the cloud is at the origin.
class Painter {
 public:
  explicit Painter(const Json& task)
      : middle_(0, 0, 0),
        spacing_(task.at("spacing")),
        folder_(task.at("folder").get<std::string>()),
        studio_(task.at("side")) {
    cloud_.points = loadPoints(task.at("cloud").get<std::string>());
    middle_ = middleOf(cloud_.points);
    moveToMiddle(cloud_);
    studio_.aim(cloud_.points, viewpointOf(task.at("view"), task.at("up"), middle_));
  }

  std::string cloud() { return take(coloredDots(cloud_, {}, 1, studio_.side()), "cloud"); }

  std::string truth(const std::string& file) {
    return take(markedSurface(readMesh(file), studio_.side()), "truth");
  }

  Json mesh(const std::string& file, const std::string& name) {
    const Shape mesh = readMesh(file);
    const core::Context context;
    const std::vector<double> of_mesh = distancesFromCloud(centersOf(mesh), cloud_.points, context);
    const std::vector<double> of_cloud =
        distancesFromMesh(cloud_.points, {mesh.points, mesh.triangles}, context);
    const Props surface = markedSurface(mesh, studio_.side());
    const Props map = coloredSurface(mesh, scaled(of_mesh, spacing_), kMeshToCloudEnd);
    const Props dots = coloredDots(cloud_, scaled(of_cloud, spacing_), kCloudToMeshEnd, studio_.side());
    return {{"surface", take(surface, name + "-surface")},
            {"mesh_to_cloud", take(map, name + "-mesh_to_cloud")},
            {"cloud_to_mesh", take(dots, name + "-cloud_to_mesh")}};
  }

 private:
  void moveToMiddle(Shape& shape) const {
    for (core::Vec3& point : shape.points) point -= middle_;
  }

  Shape readMesh(const std::string& file) const {
    TriangleFile mesh = readTriangles(file);
    Shape shape;
    shape.points = std::move(mesh.vertices);
    shape.triangles = std::move(mesh.triangles);
    moveToMiddle(shape);
    return shape;
  }

  std::string take(const Props& props, const std::string& name) {
    std::string file = (folder_ / (name + ".jpg")).string();
    studio_.take(props, file);
    return file;
  }

  Shape cloud_;
  core::Vec3 middle_;
  double spacing_;
  std::filesystem::path folder_;
  Studio studio_;
};

}  // namespace

Json drawPictures(const Json& task) {
  vtkObject::GlobalWarningDisplayOff();
  std::optional<VirtualDisplay> display;
  if (!isDisplayUsable()) display.emplace();
  Json result;
  const Status status = core::guarded([&] {
    Painter painter(task);
    result["cloud"] = painter.cloud();
    const std::string truth = task.at("truth");
    result["truth"] = truth.empty() ? "" : painter.truth(truth);
    result["meshes"] = Json::array();
    for (const std::string mesh : task.at("meshes"))
      result["meshes"].push_back(painter.mesh(mesh, std::to_string(result["meshes"].size())));
  });
  if (!status.ok()) throw AppError(kExitFailure, "pictures: " + status.message);
  return result;
}

}  // namespace mlsmesh::apps
