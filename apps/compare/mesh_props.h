// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "drawing/shape.h"

#include <vtkProp.h>
#include <vtkSmartPointer.h>

#include <vector>

namespace mlsmesh::apps {

using Props = std::vector<vtkSmartPointer<vtkProp>>;

// What is seen in pictures that are `side` pixels wide. Shapes should be near the origin: OpenGL has floats.

/// The surface, its sides in two shades, with borders, faulty edges and triangles that meet others in
/// MarkColors.
Props markedSurface(const Shape& mesh, int side);

/// The surface, each triangle in the colour of its value; `end` is the end of the scale.
Props coloredSurface(const Shape& mesh, const std::vector<double>& values, double end);

/// Shaded dots, in the colours of their values unless there are none. Of very many points some are left out.
Props coloredDots(const Shape& cloud, const std::vector<double>& values, double end, int side);

}  // namespace mlsmesh::apps
