// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/multiresolution.h"

#include <pcl/PCLPointCloud2.h>
#include <pcl/PolygonMesh.h>

#include <array>
#include <vector>

namespace mlsmesh {

// All functions below ask the context's handle as they go, and throw core::Failure(Cancelled).

/// Where the attributes of each vertex come from, as indices into the input cloud (not into the point set).
/// A vertex with parents (two different earlier vertices) averages their colours; one without averages those
/// of its members, or takes that of `nearest` if it has none; every field that cannot be averaged is copied
/// from `nearest`. `nearest` has one entry a vertex; `members` and `parents` may be shorter: vertices beyond
/// their end have none.
struct VertexSources {
  core::IndexLists members;
  std::vector<std::array<core::Index, 2>> parents;
  std::vector<core::Index> nearest;
};

/// What is computed for every vertex; any of the last three may be empty, then the input's field, if any, is
/// carried.
struct VertexData {
  std::vector<core::Vec3> position;  ///< world coordinates
  core::StoredAs stored_as = core::StoredAs::Float;
  std::vector<core::Vec3> normal;         ///< -> normal_x, normal_y, normal_z
  std::vector<double> curvature;          ///< -> curvature
  std::vector<core::Index> cluster_size;  ///< -> cluster_size (uint32)
};

/// World coordinates of the x, y, z fields of a cloud, whatever their numeric type (pcl::fromPCLPointCloud2
/// gives zeros for float64); `stored_as` tells Double when any of them is float64. Throws
/// core::Failure(EmptyInput) if a field is missing, naming it, or if the cloud's data is shorter than its
/// sizes say or in the other byte order.
std::vector<core::Vec3> worldPositions(const pcl::PCLPointCloud2& cloud, core::StoredAs& stored_as,
                                       const core::Context& context = {});

/// The vertices as a cloud with every field of `input`: x, y, z, normals and curvature replaced or appended,
/// colour (rgb, rgba, r/g/b/a as uint8, intensity) averaged, all else copied from the nearest input point.
/// Averages are rounded to nearest and do not depend on the order of the members. Unorganised, header copied,
/// fields packed in the order of the input and aligned, new ones last; padding ("_") is dropped. `output` may
/// not be `input`. O(vertices + members). Throws core::Failure: EmptyInput as worldPositions, IndexOverflow
/// if the output would not fit PCL's sizes.
void makeVertexCloud(const pcl::PCLPointCloud2& input, const VertexData& data, const VertexSources& sources,
                     pcl::PCLPointCloud2& output, const core::Context& context = {});

/// Lists of points of a set as lists of input indices, with the duplicates of each point.
core::IndexLists inputIndices(const core::PointSet& points, const core::IndexLists& lists,
                              const core::Context& context = {});

/// Triangles as PCL polygons.
std::vector<pcl::Vertices> toPolygons(const std::vector<core::Triangle>& triangles,
                                      const core::Context& context = {});

/// The vertices of level `level` of a reconstruction, as in makePolygonMesh.
void makeLevelCloud(const core::Reconstruction& reconstruction, core::Index level,
                    const pcl::PCLPointCloud2& input, pcl::PCLPointCloud2& output,
                    const core::Context& context = {});

/// Level `level` of a reconstruction as a PCL mesh: header and fields of `input`, oriented normals,
/// curvature, triangles.
void makePolygonMesh(const core::Reconstruction& reconstruction, core::Index level,
                     const pcl::PCLPointCloud2& input, pcl::PolygonMesh& output,
                     const core::Context& context = {});

/// The same from the vertices of the finest level, whose first ones are those of every level. Throws
/// core::Failure(InvalidParameter) if there is no such level.
void makePolygonMesh(const core::RefinedMesh& mesh, core::Index level, const pcl::PCLPointCloud2& finest,
                     pcl::PolygonMesh& output, const core::Context& context = {});

}  // namespace mlsmesh
