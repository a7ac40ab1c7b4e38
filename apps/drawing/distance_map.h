// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "drawing/shape.h"
#include "mlsmesh/core/context.h"
#include "mlsmesh/statistics.h"

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

namespace mlsmesh::apps {

/// A mesh cut fine enough to show, all over its triangles, how far it is from a cloud.
struct DistanceMap {
  Shape surface;
  std::vector<double> values;  ///< one a point of the surface, lengths
  Statistics cloud_to_mesh;    ///< of all points of the cloud
  double spacing = 0;          ///< median distance of a point of the cloud to its nearest other
};

/// The value at a place is the mean distance from the mesh of the points of the cloud that are nearest to it;
/// where there are none within five spacings, the distance to the nearest. `mesh` has triangles; `cloud` is
/// not empty, and finite. Throws core::Failure(Cancelled).
DistanceMap mapDistance(const Shape& mesh, const std::vector<core::Vec3>& cloud,
                        const core::Context& context);

/// The surface with the values times `scale` as scalars.
vtkSmartPointer<vtkPolyData> toPolyData(const DistanceMap& map, double scale);

}  // namespace mlsmesh::apps
