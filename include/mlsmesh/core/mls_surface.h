// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>

#include "mlsmesh/core/neighbor_search.h"
#include "mlsmesh/parameters.h"

namespace mlsmesh::core {

/// How a projection, or the vertex made from it, came about.
enum class VertexKind : std::uint8_t {
  Projected,    ///< Psi with the degree that was asked for
  LowerDegree,  ///< Psi with a lower degree, because the fit was ill-posed or the step too long
  InputPoint,   ///< an input point: what was asked for, or the last resort
  Clamped,      ///< displacement cut to its limit
  FoldGuarded,  ///< pulled towards the edge's midpoint, or onto it, to keep the mesh from folding
  Border,       ///< on a border: moved to the rim of the cloud, or along the normal and to a smooth loop
  Crease,       ///< on a sharp edge: where the surfaces of its sides meet
  Patch,        ///< on a patch over a hole, where there are no points
};

/// Psi(x) and what was learnt on the way.
struct Projection {
  Vec3 position;  ///< Psi(x)
  Vec3 normal;    ///< unit, of the fitted polynomial at Psi(x), sign arbitrary
  double variation =
      0;  ///< surface variation lambda_1 / (lambda_1 + lambda_2 + lambda_3) of the weighted neighbours
  double spacing = 0;                                          ///< local spacing d_k / sqrt(k / pi) at x
  double support = 0;                                          ///< h
  double sheet_gap = std::numeric_limits<double>::infinity();  ///< to the nearest sheet left out of the fit
  Vec3 mean_difference;   ///< (1/k) sum (p - x): along n it is the paper's t_min (n = n_c) or alpha (n = n_m)
  Index nearest = kNone;  ///< point nearest to Psi(x) among the neighbours of x
  VertexKind kind = VertexKind::Projected;
};

/// The moving-least-squares surface of a set of points: the fixed points of Psi. Holds references; the points
/// and the search must outlive it. All members are const and thread-safe.
class MlsSurface {
 public:
  /// With residual_limit > 0 (a length) a one-step fit whose weighted rms residual is larger shrinks its
  /// support, down to 1.5 local spacings: it has seen two sheets or a crease.
  MlsSurface(const std::vector<Vec3>& points, const NeighborSearch& search,
             const ProjectionParameters& parameters, double residual_limit = 0);

  /// Psi(x), with neighbours and support taken at x. Falls back to lower degrees where the fit is not
  /// finite. Of an x that is not finite itself, or too far away for the square of a distance to be, position
  /// and normal are NaN and nearest is 0. O(k log n + k m^2), m the number of coefficients (1, 3, 6, 10).
  /// With OneStep, where the fit misses its points as two sheets make it, and air is seen between them, the
  /// neighbours are those on the sheet of the nearest one alone (sheet_gap tells): one more search and fit.
  Projection project(const Vec3& x) const { return project(x, parameters_.degree); }
  Projection project(const Vec3& x, int degree) const;
  /// Psi(x) from the points of one side alone: of twice as many neighbours, the nearest whose normal is
  /// within arccos(cone) of `normal` (either sign) or unknown (zero). The spacing is that of all. All of the
  /// nearest where the side has too few.
  Projection projectSide(const Vec3& x, int degree, const Vec3& normal, const std::vector<Vec3>& normals,
                         double cone) const;
  /// ||Psi(x) - x||: 0 on the surface.
  double residual(const Vec3& x) const { return (project(x).position - x).norm(); }

  /// Where the paper's projection of a centroid starts (section 2.2, 3-4): c + t_min n_c, n_c the direction
  /// in which the weighted neighbours spread least about c, t_min the mean of (p - c) . n_c. Sheets as above.
  Vec3 startFrom(const Vec3& c) const;
  /// (1/k) sum (p - x) over the neighbours of x alone, without a fit.
  Vec3 meanDifference(const Vec3& x) const;

  const std::vector<Vec3>& points() const { return points_; }
  const NeighborSearch& search() const { return search_; }
  const ProjectionParameters& parameters() const { return parameters_; }

 private:
  const std::vector<Vec3>& points_;
  const NeighborSearch& search_;
  ProjectionParameters parameters_;
  double residual_limit_;
};

}  // namespace mlsmesh::core
