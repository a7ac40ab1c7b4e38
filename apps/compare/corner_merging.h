// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/PolygonMesh.h>

namespace mlsmesh::apps {

/// Merges vertices (of float32 coordinates) nearer to each other than 1e-4 spacings, and leaves out faces
/// that lose a corner by it: PCL's grid methods write every face with corners of its own, which differ in
/// their last bits. Other fields of the vertices are lost.
void mergeCorners(double spacing, pcl::PolygonMesh& mesh);

}  // namespace mlsmesh::apps
