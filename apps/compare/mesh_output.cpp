// SPDX-License-Identifier: BSD-3-Clause
#include "compare/mesh_output.h"

#include "common/cloud_columns.h"
#include "common/mesh_io.h"
#include "compare/method_input.h"

#include <pcl/conversions.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace mlsmesh::apps {

void writeComparedMesh(const pcl::PolygonMesh& mesh, const core::Vec3& origin,
                       const std::filesystem::path& ply) {
  PlainCloud points;
  pcl::fromPCLPointCloud2(mesh.cloud, points);
  std::vector<pcl::index_t> number(points.size(), -1);  // among those that are written
  std::vector<double> x, y, z;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const core::Vec3 place = points[i].getVector3fMap().cast<double>() + origin;
    if (!place.allFinite()) continue;
    number[i] = static_cast<pcl::index_t>(x.size());
    x.push_back(place[0]);
    y.push_back(place[1]);
    z.push_back(place[2]);
  }
  pcl::PolygonMesh written;
  makeCloud(coordinateColumns(std::move(x), std::move(y), std::move(z)), written.cloud);
  for (pcl::Vertices face : mesh.polygons) {
    for (auto& corner : face.vertices) corner = number.at(static_cast<std::size_t>(corner));
    const bool is_whole = std::count(face.vertices.begin(), face.vertices.end(), -1) == 0;
    if (is_whole) written.polygons.push_back(std::move(face));
  }
  writeMesh(ply, ply, written);
  std::filesystem::path vtk = ply;
  vtk.replace_extension(".vtk");
  writeMesh(vtk, vtk, written);
}

}  // namespace mlsmesh::apps
