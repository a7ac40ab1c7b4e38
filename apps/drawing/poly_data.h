// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "drawing/shape.h"
#include "mlsmesh/mesh_defects.h"

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

namespace mlsmesh::apps {

/// A shape as VTK takes it: triangles, or a vertex cell a point; normals, and colours as scalars.
vtkSmartPointer<vtkPolyData> toPolyData(const Shape& shape);

/// Some of a shape's triangles, edges or points, each with a colour where `colors` is not empty (one an
/// item).
vtkSmartPointer<vtkPolyData> trianglesOf(const Shape& shape, const std::vector<core::Index>& triangles);
vtkSmartPointer<vtkPolyData> edgesOf(const Shape& shape, const std::vector<MeshEdge>& edges,
                                     const std::vector<Rgb>& colors = {});
vtkSmartPointer<vtkPolyData> pointsOf(const std::vector<core::Vec3>& points);

/// Gives a cloud normals for its shading, unless it has them or is too small or too large for that; their
/// signs mean nothing.
vtkSmartPointer<vtkPolyData> withShadingNormals(vtkPolyData* cloud);

}  // namespace mlsmesh::apps
