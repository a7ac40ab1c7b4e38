// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "compare/task.h"

namespace mlsmesh::apps {

/// Draws a cloud, the true surface and meshes, all as seen by one camera, on the display that there is, or
/// else on a virtual one. The task has "cloud", "truth" (may be empty), "spacing", "side" (pixels), "view"
/// (of Viewpoint, or "sensor": from the origin of the coordinates, y down), "up", "folder", and a list
/// "meshes" of files. The result has the files "cloud" and "truth", and a list "meshes" of the files
/// "surface", "mesh_to_cloud", "cloud_to_mesh". Throws AppError.
Json drawPictures(const Json& task);

}  // namespace mlsmesh::apps
