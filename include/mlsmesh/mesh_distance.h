// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "mlsmesh/core/context.h"
#include "mlsmesh/core/types.h"
#include "mlsmesh/statistics.h"

namespace mlsmesh {

/// A triangle soup to be measured: triangles may be degenerate, doubled or crossed, but their corners are
/// vertices and finite. Refers to what it is made of.
struct SoupView {
  const std::vector<core::Vec3>& vertices;
  const std::vector<core::Triangle>& triangles;
};

/// Points drawn from a surface for each of its distances, unless told otherwise.
constexpr std::size_t kDefaultSurfaceSamples = 200000;

/// Distances between a cloud and a mesh, in both directions, as lengths.
struct CloudDistances {
  core::Index points = 0;         ///< finite ones, which all else is about
  core::Index non_finite = 0;     ///< the others
  double spacing = kUnknown;      ///< median distance of a distinct point to its nearest other
  double diagonal = 0;            ///< of the box around the points
  Statistics cloud_to_mesh;       ///< of every point from the nearest triangle
  Statistics mesh_to_cloud;       ///< of points uniform on the mesh from the nearest point
  double uncovered = kUnknown;    ///< share of the points farther than 0.5 % of the diagonal from the mesh
  double unsupported = kUnknown;  ///< share of the mesh's area farther than 5 spacings from every point
};

/// Statistics of distances are kUnknown if the mesh has no triangle, or no area. `samples` points are drawn
/// from the mesh, the same every time. Throws core::Failure: EmptyInput (no finite point), IndexOverflow,
/// Cancelled. O((points + samples + triangles) log n).
CloudDistances measureCloud(const std::vector<core::Vec3>& points, const SoupView& mesh, std::size_t samples,
                            const core::Context& context);

/// Distance of each point, which must be finite, from the nearest triangle of a mesh that has one: what the
/// statistics are of, for pictures of it. Throws core::Failure: NoTriangles, Cancelled.
std::vector<double> distancesFromMesh(const std::vector<core::Vec3>& points, const SoupView& mesh,
                                      const core::Context& context);
/// Distance of each place from the nearest point of the cloud, which has one; all must be finite. Throws
/// core::Failure: EmptyInput, Cancelled.
std::vector<double> distancesFromCloud(const std::vector<core::Vec3>& places,
                                       const std::vector<core::Vec3>& cloud, const core::Context& context);

/// How much of two surfaces lies within a distance of one another.
struct FScore {
  double tolerance = 0;         ///< as a share of the true surface's diagonal
  double precision = kUnknown;  ///< share of the mesh's area that is near to the true surface
  double recall = kUnknown;     ///< share of the true area that is near to the mesh
  double score = kUnknown;      ///< harmonic mean of both
};

/// Distances between a mesh and the true surface.
struct SurfaceDistances {
  double diagonal = 0;       ///< of the box around the true surface
  Statistics mesh_to_truth;  ///< of points uniform on the one from the other
  Statistics truth_to_mesh;
  double mean = kUnknown;       ///< mean of both means
  double rms = kUnknown;        ///< root mean square of both
  double hausdorff = kUnknown;  ///< greatest distance of points and vertices, both ways
  std::array<FScore, 3> f_scores{{{0.005}, {0.0025}, {0.001}}};
  /// Between a point's triangle and the triangle nearest to it on the other surface, whichever way they face:
  double normal_consistency = kUnknown;  ///< mean cosine
  Statistics normal_error;               ///< angles, degrees
  double same_side = kUnknown;           ///< share of the points where both face the same way
};

/// All kUnknown but the diagonal if the mesh has no area, then precision, recall and scores are 0. Throws
/// core::Failure: NoTriangles (the truth has no area), Cancelled.
SurfaceDistances measureSurface(const SoupView& mesh, const SoupView& truth, std::size_t samples,
                                const core::Context& context);

}  // namespace mlsmesh
