// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>

#include "clouds.h"

namespace mlsmesh::bench {

/// Ours through the PCL face, as a user of PCL calls it: from a pcl::PointCloud to PCL's types. The functions
/// throw std::runtime_error with the status' message if the run fails.

/// Which run of the pipeline, all else as by default.
struct PipelineRun {
  bool reduce = true;  ///< false: the points are triangulated as they are
  int levels = 0;      ///< refinement steps
  int threads = 1;
};

/// MlsMultiresolution to the pcl::PolygonMesh of the finest level. Returns its number of triangles.
/// `while_held` is called when all is made and nothing of it freed.
std::size_t makePolygonMesh(
    const Cloud::ConstPtr& cloud, const PipelineRun& run, const std::function<void()>& while_held = [] {});

/// The same run to plain data alone, before any pcl::PolygonMesh: point set and core::reconstruct. Returns
/// the number of triangles of the finest level.
std::size_t makeFlatTriangles(
    const Cloud::ConstPtr& cloud, const PipelineRun& run, const std::function<void()>& while_held = [] {});

/// Projects every point on the moving-least-squares surface (degree 2, 20 neighbours) into a new cloud of the
/// same order, from nothing: point set and k-d tree are made here. Returns the number of points.
std::size_t projectEveryPoint(const Cloud::ConstPtr& cloud, int threads);

}  // namespace mlsmesh::bench
