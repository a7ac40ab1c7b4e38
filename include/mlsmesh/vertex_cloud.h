// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/PCLPointCloud2.h>
#include <pcl/PolygonMesh.h>

#include "mlsmesh/core/multiresolution.h"

namespace mlsmesh {

/// Where the attributes of each vertex come from, as indices into the input cloud (not into the point set).
/// All lists have one entry a vertex. A vertex with parents (two different earlier vertices) averages their colours;
/// one without averages those of its members; every field that cannot be averaged is copied from `nearest`.
struct VertexSources {
  core::IndexLists members;
  std::vector<std::array<core::Index, 2>> parents;
  std::vector<core::Index> nearest;
};

/// What is computed for every vertex; any of the last three may be empty, then the input's field, if any, is carried.
struct VertexData {
  std::vector<core::Vec3> position;  ///< world coordinates
  core::StoredAs stored_as = core::StoredAs::Float;
  std::vector<core::Vec3> normal;     ///< -> normal_x, normal_y, normal_z
  std::vector<double> curvature;      ///< -> curvature
  std::vector<core::Index> cluster_size;  ///< -> cluster_size (uint32)
};

/// World coordinates of the x, y, z fields of a cloud, whatever their numeric type (pcl::fromPCLPointCloud2 gives zeros for
/// float64); `stored_as` tells Double when any of them is float64. Throws core::Failure(EmptyInput) if a field is missing,
/// naming it.
std::vector<core::Vec3> worldPositions(const pcl::PCLPointCloud2& cloud, core::StoredAs& stored_as);

/// The vertices as a cloud with every field of `input`: x, y, z, normals and curvature replaced or appended, colour (rgb,
/// rgba, r/g/b, intensity) averaged, all else copied from the nearest input point. Unorganised, header copied. O(vertices).
void makeVertexCloud(const pcl::PCLPointCloud2& input, const VertexData& data, const VertexSources& sources,
                     pcl::PCLPointCloud2& output);

/// Level `level` of a reconstruction as a PCL mesh: header and fields of `input`, oriented normals, curvature, triangles.
void makePolygonMesh(const core::Reconstruction& reconstruction, core::Index level, const pcl::PCLPointCloud2& input,
                     pcl::PolygonMesh& output);

}  // namespace mlsmesh
