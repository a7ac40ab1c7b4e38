// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "drawing/notes.h"
#include "drawing/palette.h"
#include "mlsmesh/mesh_defects.h"

#include <vtkActor.h>
#include <vtkSmartPointer.h>

#include <string>
#include <vector>

namespace mlsmesh::apps {

/// Things drawn over a shape, and what they are.
struct Marks {
  std::vector<vtkSmartPointer<vtkActor>> actors;
  std::vector<LegendEntry> legend;
};

/// Every border as a tube, in a colour that differs from those of the borders before and after it in length.
Marks borderMarks(const Shape& mesh, const std::vector<BorderEdges>& borders);

/// Faulty triangles, edges and vertices, each kind in its own colour, with dots that shine through the
/// surface; a legend with the counts.
Marks defectMarks(const Shape& mesh, const MeshDefects& defects);

/// Where the marks are, one place for each border, or for each faulty thing.
std::vector<core::Vec3> placesOf(const Shape& mesh, const std::vector<BorderEdges>& borders);
std::vector<core::Vec3> placesOf(const Shape& mesh, const MeshDefects& defects);

/// A dot at every point and a line of that length along its normal.
Marks normalMarks(const Shape& points, double length);

}  // namespace mlsmesh::apps
