// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "drawing/shape.h"

#include <vtkLookupTable.h>
#include <vtkSmartPointer.h>

namespace mlsmesh::apps {

// Colours that can be told apart without colour vision: categories differ in lightness as well, and values
// grow darker.

constexpr int kCategories = 7;
constexpr Rgb kNoCategoryColor{200, 200, 200};
constexpr Rgb kSurfaceColor{158, 178, 204};
constexpr Rgb kPaleSurfaceColor{196, 202, 211};
constexpr Rgb kTextColor{45, 48, 56};
constexpr Rgb kEdgeColor{51, 59, 69};

/// Of the palette of Okabe and Ito; wraps around.
Rgb categoryColor(int category);

/// From pale to dark over 0 .. `highest`; greater values are as dark as the highest.
vtkSmartPointer<vtkLookupTable> valueColors(double highest);

/// As VTK takes it, 0 .. 1.
std::array<double, 3> unitRgb(const Rgb& color);

}  // namespace mlsmesh::apps
