// SPDX-License-Identifier: BSD-3-Clause
#include "common/camera_fit.h"

#include <vtkBoundingBox.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

namespace mlsmesh::apps {
namespace {

constexpr double kPi = 3.141592653589793;
constexpr double kViewAngle = 25.0;  // degrees
constexpr double kMargin = 1.08;     // of the scene's extent on the screen

/// How far from `focus`, in the unit direction `from`, the camera sees all points.
double fittingDistance(const std::vector<vtkPoints*>& scene, const Eigen::Vector3d& focus,
                       const Eigen::Vector3d& from, const Eigen::Vector3d& upwards, double aspect) {
  const Eigen::Vector3d right = upwards.cross(from).normalized();
  const Eigen::Vector3d up = from.cross(right);
  const double slope = std::tan(0.5 * kViewAngle * kPi / 180.0) / kMargin;
  double distance = 0.0;
  for (vtkPoints* points : scene) {
    for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i) {
      const Eigen::Vector3d place = Eigen::Vector3d(points->GetPoint(i)) - focus;
      const double needed =
          std::max(std::abs(place.dot(up)), std::abs(place.dot(right)) / aspect) / slope + place.dot(from);
      if (std::isfinite(needed)) distance = std::max(distance, needed);
    }
  }
  return distance > 0.0 ? distance : 1.0;
}

}  // namespace

void fitCamera(const std::vector<vtkPoints*>& scene, const Viewpoint& viewpoint, double aspect, double zoom,
               vtkCamera& camera) {
  vtkBoundingBox box;
  for (vtkPoints* points : scene) box.AddBounds(points->GetBounds());
  std::array<double, 3> center{};
  box.GetCenter(center.data());
  const Eigen::Vector3d focus(center.data());
  const Eigen::Vector3d from = viewpoint.from.normalized();
  const Eigen::Vector3d position =
      focus + fittingDistance(scene, focus, from, viewpoint.up, aspect) / zoom * from;
  camera.SetViewAngle(kViewAngle);
  camera.SetFocalPoint(focus.data());
  camera.SetPosition(position.data());
  camera.SetViewUp(viewpoint.up.data());
}

}  // namespace mlsmesh::apps
