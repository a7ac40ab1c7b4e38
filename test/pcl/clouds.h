// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/types.h"
#include "mlsmesh/mesh_report.h"
#include "mlsmesh/vertex_cloud.h"

#include <pcl/PolygonMesh.h>
#include <pcl/point_cloud.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

// Small analytic clouds with fixed seeds, and what tests ask of meshes.
namespace mlsmesh::testing {

constexpr double kPi = 3.14159265358979323846;

/// Uniform in [-1, 1), the same on every platform.
class Jitter {
 public:
  explicit Jitter(unsigned seed) : engine_(seed) {}
  double operator()() { return static_cast<double>(engine_()) / 2147483648.0 - 1.0; }

 private:
  std::mt19937 engine_;
};

/// A jittered Fibonacci lattice on the sphere of radius 1 about `centre`: even, without equal distances.
inline std::vector<core::Vec3> spherePoints(int count, const core::Vec3& centre = core::Vec3::Zero(),
                                            unsigned seed = 1) {
  Jitter jitter(seed);
  const double spread = 0.2 * std::sqrt(4 * kPi / count);
  std::vector<core::Vec3> points;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2 * i + 1.0) / count;
    const double angle = i * kPi * (3 - std::sqrt(5.0));
    const double r = std::sqrt(1 - z * z);
    const core::Vec3 p(r * std::cos(angle) + spread * jitter(), r * std::sin(angle) + spread * jitter(),
                       z + spread * jitter());
    points.push_back(centre + p.normalized());
  }
  return points;
}

/// A jittered grid on the wall of an open cylinder of radius 1 and height 2.
inline std::vector<core::Vec3> cylinderPoints(int around, int rows, unsigned seed = 2) {
  Jitter jitter(seed);
  std::vector<core::Vec3> points;
  for (int row = 0; row < rows; ++row) {
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * kPi * (i + 0.5 * (row % 2) + 0.15 * jitter()) / around;
      points.emplace_back(std::cos(angle), std::sin(angle), 2.0 * (row + 0.15 * jitter()) / (rows - 1));
    }
  }
  return points;
}

/// An exact square lattice in the plane z = 0: every distance is tied.
inline std::vector<core::Vec3> latticePoints(int side) {
  std::vector<core::Vec3> points;
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) points.emplace_back(column, row, 0);
  }
  return points;
}

template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr cloudOf(const std::vector<core::Vec3>& positions) {
  typename pcl::PointCloud<PointT>::Ptr cloud(new pcl::PointCloud<PointT>);
  for (const core::Vec3& position : positions) {
    PointT point;
    point.x = static_cast<decltype(point.x)>(position.x());
    point.y = static_cast<decltype(point.y)>(position.y());
    point.z = static_cast<decltype(point.z)>(position.z());
    cloud->push_back(point);
  }
  cloud->header.frame_id = "scanner";
  return cloud;
}

template <typename PointT>
core::Vec3 positionOf(const PointT& point) {
  return {point.x, point.y, point.z};
}

inline std::vector<core::Vec3> positionsOf(const pcl::PolygonMesh& mesh) {
  core::StoredAs stored_as;
  return worldPositions(mesh.cloud, stored_as);
}

inline std::vector<core::Triangle> trianglesOf(const std::vector<pcl::Vertices>& polygons) {
  std::vector<core::Triangle> triangles;
  for (const auto& polygon : polygons) {
    triangles.push_back({polygon.vertices.at(0), polygon.vertices.at(1), polygon.vertices.at(2)});
  }
  return triangles;
}

inline MeshReport reportOf(const pcl::PolygonMesh& mesh) {
  return reportMesh(positionsOf(mesh), trianglesOf(mesh.polygons));
}

/// The volume that the triangles enclose, positive if they face outward.
inline double volume(const pcl::PolygonMesh& mesh) {
  const auto positions = positionsOf(mesh);
  double sum = 0;
  for (const auto& [a, b, c] : trianglesOf(mesh.polygons))
    sum += positions[a].dot(positions[b].cross(positions[c]));
  return sum / 6;
}

inline bool sameTriangles(const pcl::PolygonMesh& a, const pcl::PolygonMesh& b) {
  return trianglesOf(a.polygons) == trianglesOf(b.polygons);
}

inline bool sameMesh(const pcl::PolygonMesh& a, const pcl::PolygonMesh& b) {
  return a.cloud.data == b.cloud.data && sameTriangles(a, b);
}

inline bool isEmpty(const pcl::PolygonMesh& mesh) {
  return mesh.cloud.width == 0 && mesh.cloud.height == 0 && mesh.cloud.data.empty() &&
         mesh.cloud.row_step == 0 && mesh.polygons.empty();
}

template <typename PointT>
bool isEmpty(const pcl::PointCloud<PointT>& cloud) {
  return cloud.width == 0 && cloud.height == 0 && cloud.empty();
}

/// A mesh with something in it, to see that a verb clears it.
inline pcl::PolygonMesh usedMesh() {
  pcl::PolygonMesh mesh;
  mesh.cloud.width = mesh.cloud.height = 1;
  mesh.cloud.data.resize(12);
  mesh.polygons.resize(3);
  return mesh;
}

}  // namespace mlsmesh::testing
