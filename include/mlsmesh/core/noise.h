// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/neighbor_search.h"
#include "mlsmesh/parameters.h"

namespace mlsmesh::core {

/// How far the points of a cloud scatter about the surface.
struct NoiseEstimate {
  double sigma = 0;     ///< standard deviation along the surface normal, in the points' unit
  double relative = 0;  ///< sigma over the local spacing d_k / sqrt(k / pi), median over the sample
};

/// Estimates the noise once for the whole cloud, from quadric fits at evenly spread points of the set: the
/// median residual over growing neighbourhoods stands still at the noise, while for a clean cloud it keeps
/// growing with curvature. Clean clouds are told from a first look at a few hundred points (relative < 0.06
/// then, and no more is done). Sheets with clear air between them are no noise: where fits over the points of
/// one sheet leave less than half the residual, those count. Within 10 % up to a relative noise of 1, low by
/// 10-20 % at 2. Creases and thin parts touch the median only where they are most of the surface. Constant
/// time but for the searches; deterministic, parallel.
NoiseEstimate estimateNoise(const std::vector<Vec3>& points, const NeighborSearch& search,
                            const Context& context);

/// What the noise makes of the parameters.
struct NoiseAdaptation {
  NoiseEstimate estimate;
  MultiresolutionParameters parameters;  ///< as given, with projection, clustering and threshold adapted
  ProjectionParameters denoising;        ///< of the passes over all points
  int passes = 0;                        ///< projections of all points before the first step; 0: none
  double residual_limit = 0;             ///< of MlsSurface; 0: none
  bool drops_crowded = false;            ///< representatives that noise has stacked are dropped
};

/// Below a relative noise of 0.1 nothing changes; below 0.4 the support h and k grow with its fourth root;
/// above, all points are projected two or three times first and the steps then see a clean cloud. `estimate`
/// is taken as it is.
NoiseAdaptation adaptTo(const NoiseEstimate& estimate, const MultiresolutionParameters& parameters);

/// Moves all points onto their own moving-least-squares surface, once: one pass of denoising. O(n k log n),
/// parallel.
std::vector<Vec3> projectAll(const std::vector<Vec3>& points, const NeighborSearch& search,
                             const ProjectionParameters& parameters, double residual_limit,
                             const Context& context);

}  // namespace mlsmesh::core
