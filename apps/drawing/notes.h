// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "drawing/palette.h"

#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTextActor.h>

#include <string>
#include <vector>

namespace mlsmesh::apps {

/// What a colour stands for.
struct LegendEntry {
  std::string text;
  Rgb color{};
};

/// Pixels of letters in a pane of that extent.
int fontSize(double pixels);

/// One or more lines at the lower left corner of a pane.
vtkSmartPointer<vtkTextActor> label(const std::string& text, int font_size);

/// Lines in the middle of a pane, on a light ground.
vtkSmartPointer<vtkTextActor> notice(const std::string& text, int font_size);

/// Lines of letters of one width at the upper left corner of a pane, on a light ground.
vtkSmartPointer<vtkTextActor> table(const std::string& text, int font_size);

/// A column at the upper left corner of a pane: a square of each colour, and its text.
std::vector<vtkSmartPointer<vtkTextActor>> legend(const std::vector<LegendEntry>& entries, int font_size);

}  // namespace mlsmesh::apps
