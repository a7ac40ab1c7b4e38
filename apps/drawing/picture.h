// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkRenderWindow.h>

#include <filesystem>

namespace mlsmesh::apps {

/// Pictures are PNG files. Throws AppError (kExitUsage) that names `culprit` if `file` does not end in .png.
void checkPictureFormat(const char* culprit, const std::filesystem::path& file);

/// Draws the window, as large as it is, into a file that appears whole or not at all. Throws AppError.
void writePicture(vtkRenderWindow& window, const std::filesystem::path& file);

}  // namespace mlsmesh::apps
