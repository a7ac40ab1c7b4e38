// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <string>

namespace mlsmesh::apps {

/// From where a scene is looked at: directions, of any length but 0, not along one line.
struct Viewpoint {
  Eigen::Vector3d from{0, 0, 1};  ///< from the middle of the scene to the camera
  Eigen::Vector3d up{0, 1, 0};
};

/// "front", "back", "left", "right", "top", "bottom" or "iso", turned so that the axis `up` ("x", "y" or "z")
/// points up. Throws AppError (kExitUsage) that names the culprit of the two.
Viewpoint namedViewpoint(const std::string& view, const std::string& up,
                         const std::string& view_culprit = "--view", const std::string& up_culprit = "--up");

}  // namespace mlsmesh::apps
