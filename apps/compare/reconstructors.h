// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "compare/method_input.h"
#include "compare/stage_clock.h"

#include <pcl/PolygonMesh.h>

namespace mlsmesh::apps {

// The methods. Each returns its mesh, without polygons if it makes none, and leaves its times in `clock`;
// stages named "normals" and "orientation" prepare what others need, all else is the method's own. Lengths
// are in mean spacings, the one thing that a user of PCL is taken to know. They throw Refusal, and
// std::exception where they fail.

/// MlsMultiresolution, by the input's parameters, to that level.
pcl::PolygonMesh reconstructLevel(const MethodInput& input, int level, StageClock& clock);
/// The same by the preset `paper`, whatever the input's parameters.
pcl::PolygonMesh reconstructPaperLevel(const MethodInput& input, int level, StageClock& clock);
/// By the input's parameters with the points themselves for vertices, not refined.
pcl::PolygonMesh reconstructUnreduced(const MethodInput& input, StageClock& clock);

/// pcl::GreedyProjectionTriangulation over normals as PCL estimates them, all towards the origin.
pcl::PolygonMesh projectGreedily(const MethodInput& input, StageClock& clock);
/// The same over normals that were oriented along a spanning tree, with the options that need such.
pcl::PolygonMesh projectGreedilyOriented(const MethodInput& input, StageClock& clock);
/// The same as the first over the points and normals that pcl::MovingLeastSquares makes.
pcl::PolygonMesh projectGreedilySmoothed(const MethodInput& input, StageClock& clock);

/// pcl::Poisson over oriented normals.
pcl::PolygonMesh reconstructPoisson(const MethodInput& input, int depth, StageClock& clock);

/// pcl::MarchingCubesHoppe over oriented normals, its triangles' corners merged.
pcl::PolygonMesh marchHoppe(const MethodInput& input, StageClock& clock);
/// pcl::MarchingCubesRBF likewise. Refuses more than kMostRbfPoints: its equations are dense, 2n x 2n.
pcl::PolygonMesh marchRbf(const MethodInput& input, StageClock& clock);
inline constexpr std::size_t kMostRbfPoints = 2500;

/// pcl::GridProjection over oriented normals.
pcl::PolygonMesh projectGrid(const MethodInput& input, StageClock& clock);

/// pcl::OrganizedFastMesh. Refuses clouds that are not organised.
pcl::PolygonMesh meshOrganized(const MethodInput& input, StageClock& clock);

}  // namespace mlsmesh::apps
