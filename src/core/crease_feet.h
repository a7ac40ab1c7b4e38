// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "robust_normals.h"
#include "sparse_neighbors.h"

namespace mlsmesh::core {

/// A place on a sharp edge (two sides) or corner (three), found from a point of the cloud near it.
struct CreaseFoot {
  Vec3 position;
  int sides = 0;  ///< 2 or 3; 0: none was found
  std::array<Vec3, 3> side_normal;
  Vec3 bisector;       ///< unit; between the sides, sign arbitrary
  double quality = 0;  ///< residual of the sides over that of one smooth surface: 0 is sharp, 1 is smooth
  double spacing = 0;  ///< local spacing of the cloud there
};

/// The foot of a point on the sharp edge near it. Reads the 25 nearest points of `point` and their normals.
/// `residual` is that of one smooth surface through them, `cosine` that of the least angle between sides.
CreaseFoot creaseFootOf(Index point, double residual, double cosine, const SparseNeighbors& neighbors,
                        const RobustNormals& normals);

/// The nearest place to `start` where the sides of the surface meet whose normals are like the first `count`
/// (2 or 3) of `sides`: fitted to those of the points `nearest` to it (`found`, ascending in distance). No
/// sides if there are too few points of one, or if two are nearly parallel.
CreaseFoot footBetween(const Vec3& start, const std::array<Vec3, 3>& sides, int count, double spacing,
                       const Index* nearest, int found, const std::vector<Vec3>& points,
                       const std::vector<Vec3>& normals);

/// Whether the foot leaves no doubt that there is a sharp edge.
bool isClearlySharp(const CreaseFoot& foot);

constexpr double kSharpShare = 0.4;  // of the feet of a sharp edge that are clearly sharp, at least

/// Whether each foot belongs to a sharp edge, and not to a bend that looks like one here and there: feet are
/// linked where their points are near and they are closer than two local spacings; a linked group stays if
/// at least 10 of its feet, and two in five, are clearly sharp. foot[i] is that of points[i].
std::vector<char> keptFeet(const std::vector<Index>& points, const std::vector<CreaseFoot>& feet,
                           const SparseNeighbors& neighbors);

}  // namespace mlsmesh::core
