// SPDX-License-Identifier: BSD-3-Clause
#include "compare/corner_merging.h"

#include <pcl/conversions.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <vtkBoundingBox.h>
#include <vtkIncrementalOctreePointLocator.h>
#include <vtkNew.h>
#include <vtkPoints.h>

#include <algorithm>
#include <utility>

namespace mlsmesh::apps {
namespace {

constexpr double kTolerance = 1e-4;  // spacings

/// For every point the number of its merged one; `merged` gets those.
std::vector<vtkIdType> mergePoints(const pcl::PointCloud<pcl::PointXYZ>& points, double tolerance,
                                   vtkPoints* merged) {
  vtkBoundingBox box;
  for (const pcl::PointXYZ& point : points) box.AddPoint(point.x, point.y, point.z);
  box.Inflate(tolerance);
  double bounds[6];
  box.GetBounds(bounds);
  vtkNew<vtkIncrementalOctreePointLocator> locator;
  locator->SetTolerance(tolerance);
  locator->InitPointInsertion(merged, bounds);
  std::vector<vtkIdType> number(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double place[3] = {points[i].x, points[i].y, points[i].z};
    locator->InsertUniquePoint(place, number[i]);
  }
  return number;
}

bool hasRepeatedCorner(pcl::Vertices face) {
  std::sort(face.vertices.begin(), face.vertices.end());
  return std::adjacent_find(face.vertices.begin(), face.vertices.end()) != face.vertices.end();
}

}  // namespace

void mergeCorners(double spacing, pcl::PolygonMesh& mesh) {
  pcl::PointCloud<pcl::PointXYZ> points;
  pcl::fromPCLPointCloud2(mesh.cloud, points);
  if (points.empty()) return;
  vtkNew<vtkPoints> merged;  // of floats
  const std::vector<vtkIdType> number = mergePoints(points, kTolerance * spacing, merged);
  std::vector<pcl::Vertices> faces;
  for (pcl::Vertices& face : mesh.polygons) {
    for (auto& corner : face.vertices) corner = static_cast<pcl::index_t>(number[corner]);
    if (!hasRepeatedCorner(face)) faces.push_back(std::move(face));
  }
  mesh.polygons.swap(faces);
  points.clear();
  for (vtkIdType i = 0; i < merged->GetNumberOfPoints(); ++i) {
    double place[3];
    merged->GetPoint(i, place);
    points.push_back(
        {static_cast<float>(place[0]), static_cast<float>(place[1]), static_cast<float>(place[2])});
  }
  pcl::toPCLPointCloud2(points, mesh.cloud);
}

}  // namespace mlsmesh::apps
