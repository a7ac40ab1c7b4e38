// SPDX-License-Identifier: BSD-3-Clause
// The categories are those of M. Okabe, K. Ito, "Color Universal Design", 2008; the values run through the
// colours of "magma" (N. Smith, S. van der Walt, 2015), from its pale end.
#include "drawing/palette.h"

#include <vtkColorTransferFunction.h>
#include <vtkNew.h>

namespace mlsmesh::apps {

Rgb categoryColor(int category) {
  static constexpr std::array<Rgb, kCategories> kColors{{{0, 114, 178},
                                                         {240, 228, 66},
                                                         {213, 94, 0},
                                                         {86, 180, 233},
                                                         {0, 158, 115},
                                                         {230, 159, 0},
                                                         {204, 121, 167}}};
  return kColors[static_cast<std::size_t>(category) % kColors.size()];
}

vtkSmartPointer<vtkLookupTable> valueColors(double highest) {
  static constexpr std::array<Rgb, 8> kStops{{{252, 253, 191},
                                              {254, 194, 135},
                                              {251, 135, 97},
                                              {229, 80, 100},
                                              {181, 54, 122},
                                              {129, 37, 129},
                                              {79, 18, 123},
                                              {28, 16, 68}}};
  constexpr int kSteps = 256;
  vtkNew<vtkColorTransferFunction> ramp;
  for (std::size_t i = 0; i < kStops.size(); ++i) {
    const std::array<double, 3> color = unitRgb(kStops[i]);
    ramp->AddRGBPoint(static_cast<double>(i) / (kStops.size() - 1), color[0], color[1], color[2]);
  }
  auto table = vtkSmartPointer<vtkLookupTable>::New();
  table->SetNumberOfTableValues(kSteps);
  for (int i = 0; i < kSteps; ++i) {
    std::array<double, 3> color{};
    ramp->GetColor(static_cast<double>(i) / (kSteps - 1), color.data());
    table->SetTableValue(i, color[0], color[1], color[2]);
  }
  table->SetTableRange(0.0, highest);
  return table;
}

std::array<double, 3> unitRgb(const Rgb& color) {
  return {color[0] / 255.0, color[1] / 255.0, color[2] / 255.0};
}

}  // namespace mlsmesh::apps
