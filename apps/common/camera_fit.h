// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/viewpoint.h"

#include <vtkCamera.h>
#include <vtkPoints.h>

#include <vector>

namespace mlsmesh::apps {

/// Puts the camera where it sees every finite point of all sets, seen from the middle of the box around them,
/// in a picture that is `aspect` times as wide as high; `zoom` > 1 is nearer.
void fitCamera(const std::vector<vtkPoints*>& scene, const Viewpoint& viewpoint, double aspect, double zoom,
               vtkCamera& camera);

}  // namespace mlsmesh::apps
