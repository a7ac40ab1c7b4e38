// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/mesh_reader.h"
#include "mlsmesh/mesh_distance.h"
#include "mlsmesh/mesh_shape.h"
#include "mlsmesh/mesh_topology.h"

#include <filesystem>
#include <optional>

namespace mlsmesh::apps {

struct InspectOptions;

/// All that was found of a mesh.
struct Inspection {
  TriangleFile mesh;
  MeshTopology topology;
  std::int64_t self_intersections = 0;
  MeshShape shape;
  std::optional<CloudDistances> cloud;
  std::optional<SurfaceDistances> truth;
  MeshTopology truth_topology;
  double seconds = 0;  ///< that reading and measuring took
};

/// Reads the files and measures. Throws AppError that names the file at fault.
Inspection inspect(const InspectOptions& options);

}  // namespace mlsmesh::apps
