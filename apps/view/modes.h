// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace mlsmesh::apps {

/// What is shown of a file.
enum class Mode {
  Auto,  ///< a mesh, also one that was made of a cloud; else the cloud
  Cloud,
  Clusters,
  Representatives,
  Mesh,
  Borders,
  Defects,
  Distance
};

/// cloud, clusters, ..., distance: for --show. Auto has no name.
const std::vector<std::string>& modeNames();

/// Throws AppError (kExitUsage) that names the culprit.
Mode modeNamed(const std::string& name, const std::string& culprit);

/// Whether a cloud must be reconstructed for it.
bool needsMesh(Mode mode);

}  // namespace mlsmesh::apps
