// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "program.h"

#include <functional>
#include <string>
#include <vector>

namespace mlsmesh::test {

/// A mesh with a border, as the content of a PLY file.
inline constexpr const char* kTetrahedron =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 3\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n";

/// For `prepare`: takes the display away.
bool dropDisplay();
/// Runs mlsmesh_view to its end.
Outcome runView(const std::vector<std::string>& arguments,
                const std::function<bool()>& prepare = dropDisplay);
/// Expects an exit code, and one line on stderr that names the program and the culprit.
void expectOneLine(const Outcome& outcome, int exit_code, const std::string& culprit);

/// Points on a sphere, by the golden angle, without those near its poles.
std::string bandText();

}  // namespace mlsmesh::test
