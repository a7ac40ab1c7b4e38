// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "drawing/palette.h"

#include <vtkActor.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkSmartPointer.h>

#include <string>

namespace mlsmesh::apps {

/// How surfaces are drawn.
struct SurfaceLook {
  bool flat = false;   ///< one shade a triangle
  bool edges = false;  ///< of the triangles, on them
  bool wireframe = false;
};

/// Background and lights, the same in every picture.
void setUpRenderer(vtkRenderer& renderer);

/// A mesh in its own colours, or in `color` if it has none.
vtkSmartPointer<vtkActor> surfaceActor(vtkPolyData* mesh, const Rgb& color = kSurfaceColor);
void setLook(const SurfaceLook& look, vtkActor& surface);

/// A mesh whose scalars are values, in the colours of the table.
vtkSmartPointer<vtkActor> valueActor(vtkPolyData* mesh, vtkLookupTable* colors);

/// A scale of the table's colours at the right border of a pane that is so many pixels high.
vtkSmartPointer<vtkScalarBarActor> scaleBar(vtkLookupTable* colors, const std::string& title, double pixels);

/// A cloud in its own colours, or in `color`; its normals, if any, shade it from both sides.
vtkSmartPointer<vtkActor> cloudActor(vtkPolyData* cloud, const Rgb& color = kSurfaceColor);

/// Pixels that dots are wide so that so many points look like a surface in a pane of that extent.
float dotSize(double points, double pixels);

}  // namespace mlsmesh::apps
