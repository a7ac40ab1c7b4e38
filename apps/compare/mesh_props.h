// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/mesh_reader.h"

#include <vtkProp.h>
#include <vtkSmartPointer.h>

#include <vector>

namespace mlsmesh::apps {

using Props = std::vector<vtkSmartPointer<vtkProp>>;

// What is seen in pictures that are `side` pixels wide. `middle` is taken off all positions, so that those
// far from the origin survive OpenGL's floats.

/// The surface, sides in two shades, with borders, non-manifold and misoriented edges, and triangles that
/// meet others (unless `crossings`, the number of such pairs, is very large) in MarkColors.
Props markedSurface(const TriangleFile& mesh, double crossings, const core::Vec3& middle, int side);

/// The surface, each triangle in the colour of its value; `end` is the end of the scale.
Props coloredSurface(const TriangleFile& mesh, const std::vector<double>& values, double end,
                     const core::Vec3& middle);

/// Dots in the colours of their values, or lit like a surface if `values` is empty. Of very many points some
/// are left out.
Props coloredDots(const std::vector<core::Vec3>& points, const std::vector<double>& values, double end,
                  const core::Vec3& middle, int side);

}  // namespace mlsmesh::apps
