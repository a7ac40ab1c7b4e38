// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "view/subject.h"
#include "view/view_options.h"

#include <vector>

namespace mlsmesh::apps {

/// Draws all side by side, with one camera, when all that the options ask for is reconstructed and their
/// script is done, into a PNG file that appears whole or not at all. Shows progress on a terminal. Needs a
/// usable display. Throws AppError, also where a reconstruction fails that was asked for.
void writeScreenshot(std::vector<Subject>& subjects, const ViewOptions& options);

/// Shows all side by side, with one camera, until the user closes the window; keys as in keys.h. With
/// `ends_with_script`, ends when the script of the options does. Needs a usable display. Throws AppError if a
/// picture cannot be written.
void showWindow(std::vector<Subject>& subjects, const ViewOptions& options, bool ends_with_script);

}  // namespace mlsmesh::apps
