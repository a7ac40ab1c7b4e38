// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "view/drawing.h"
#include "view/view_options.h"

#include <vector>

namespace mlsmesh::apps {

/// Draws all side by side, with one camera, into a PNG file that appears whole or not at all. Needs a usable
/// display. Throws AppError.
void writeScreenshot(const std::vector<Drawing>& drawings, const ViewOptions& options);

/// Shows all side by side, with one camera, until the user closes the window. Needs a usable display.
/// Left, Right: one file after the other; a: all again; b: borders; g: edges; others as in VTK (r, w, s, q).
void showWindow(const std::vector<Drawing>& drawings, const ViewOptions& options);

}  // namespace mlsmesh::apps
