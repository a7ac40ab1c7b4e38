// SPDX-License-Identifier: BSD-3-Clause
// Related: C. Lange, K. Polthier 2005 and N. J. Mitra, A. Nguyen, L. Guibas, "Estimating surface normals in
// noisy point cloud data", 2004 (neighbourhoods chosen from noise and curvature). Here the size at which the
// residual of a quadric grows least is taken: smaller ones let the frame follow the noise, larger ones see
// the shape.
#include "mlsmesh/core/noise.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

#include "mlsmesh/core/mls_surface.h"
#include "mlsmesh/core/parallel.h"
#include "near_sheets.h"

namespace mlsmesh::core {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kFirstLook = 25;  // neighbours of the first look
constexpr std::size_t kFirstSample = 300;
constexpr double kClean = 0.06;  // relative residual of the first look below which a cloud is clean
constexpr std::size_t kSample = 1000;
constexpr std::array<int, 9> kSizes = {12, 18, 25, 35, 50, 70, 100, 140, 200};
constexpr double kNoisy = 0.1;      // relative noise from which the support adapts
constexpr double kVeryNoisy = 0.4;  // from which all points are projected first
constexpr double kThreePasses = 0.8;
constexpr double kSheets = 0.5;     // share of the residual on one sheet from which it was sheets, not noise
constexpr double kNoPlateau = 0.4;  // growth exponent above which the residual is shape, not noise
constexpr double kShape = 4;        // residuals so many times that of the smallest size are shape, not noise

using Quadric = Eigen::Matrix<double, 6, 1>;

Quadric basis(double u, double v) {
  Quadric b;
  b << 1, u, v, u * u, u * v, v * v;
  return b;
}

// Residual sqrt(RSS / (k - 6)) of the quadric over these neighbours, in their principal frame.
double residualOf(const std::vector<Vec3>& points, const Index* neighbors, int count) {
  Vec3 mean = Vec3::Zero();
  const Vec3& reference = points[neighbors[0]];
  for (int i = 0; i < count; ++i) mean += points[neighbors[i]] - reference;
  mean = reference + mean / count;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double reach = 0;
  for (int i = 0; i < count; ++i) {
    const Vec3 d = points[neighbors[i]] - mean;
    covariance.noalias() += d * d.transpose();
    reach = std::max(reach, d.squaredNorm());
  }
  if (!(reach > 0)) return 0;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(covariance);
  const Eigen::Matrix3d axes = solver.eigenvectors() / std::sqrt(reach);
  Eigen::Matrix<double, 6, 6> matrix = Eigen::Matrix<double, 6, 6>::Identity() * 1e-12;
  Quadric right = Quadric::Zero();
  for (int i = 0; i < count; ++i) {
    const Vec3 local = axes.transpose() * (points[neighbors[i]] - mean);
    const Quadric b = basis(local[1], local[2]);
    matrix.noalias() += b * b.transpose();
    right += local[0] * b;
  }
  const Quadric fit = matrix.ldlt().solve(right);
  double sum = 0;
  for (int i = 0; i < count; ++i) {
    const Vec3 local = axes.transpose() * (points[neighbors[i]] - mean);
    const double miss = local[0] - fit.dot(basis(local[1], local[2]));
    sum += miss * miss;
  }
  return std::sqrt(sum / (count - 6) * reach);
}

// The same over those of the first `count` that lie on the sheet of the first. Sheets must be farther apart
// than those that projections tell apart.
double residualOnSheet(const std::vector<Vec3>& points, const Index* neighbors, int count, double spacing,
                       double whole) {
  constexpr double kGap = 1.5;  // of the spacing
  if (whole < kNoisy * spacing) return whole;
  const std::optional<Slab> slab = sheetOfFirst(points, neighbors, count, kGap * spacing);
  if (!slab) return whole;
  std::vector<Index> sheet;
  std::copy_if(neighbors, neighbors + count, std::back_inserter(sheet),
               [&](Index p) { return slab->contains(points[p]); });
  constexpr std::size_t kLeast = 9;  // points that a quadric does not all but interpolate
  return sheet.size() < kLeast ? whole : residualOf(points, sheet.data(), static_cast<int>(sheet.size()));
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Residuals at `sizes` (as far as the cloud is large enough) and local spacing, at evenly spread points:
// medians.
struct Medians {
  std::vector<double> residual;  // one a size
  std::vector<double> on_sheet;  // those of one sheet alone
  double relative = 0;           // on a sheet, of the last size, over the local spacing
  double spacing = 0;
};

template <std::size_t kCount>
Medians measure(const std::vector<Vec3>& points, const NeighborSearch& search, std::size_t sample,
                const std::array<int, kCount>& sizes, const Context& context) {
  const std::size_t step = std::max<std::size_t>(1, points.size() / sample);
  const std::size_t count = (points.size() + step - 1) / step;
  std::size_t usable = 0;
  while (usable < kCount && static_cast<std::size_t>(sizes[usable]) <= points.size()) ++usable;
  Medians medians;
  if (usable == 0) return medians;
  std::vector<std::vector<double>> residual(usable, std::vector<double>(count)), on_sheet = residual;
  std::vector<double> spacing(count);
  const int most = sizes[usable - 1];
  parallelBlocks(context, count, 16, [&](std::size_t first, std::size_t last) {
    std::vector<Index> neighbors(static_cast<std::size_t>(most));
    std::vector<double> squared(static_cast<std::size_t>(most));
    for (std::size_t i = first; i < last; ++i) {
      search.nearest(points[i * step], most, neighbors.data(), squared.data());
      const int near = std::min(most, 20);
      spacing[i] = std::sqrt(squared[static_cast<std::size_t>(near - 1)]) / std::sqrt(near / kPi);
      for (std::size_t j = 0; j < usable; ++j) {
        residual[j][i] = residualOf(points, neighbors.data(), sizes[j]);
        on_sheet[j][i] = residualOnSheet(points, neighbors.data(), sizes[j], spacing[i], residual[j][i]);
      }
    }
  });
  for (std::size_t j = 0; j < usable; ++j) {
    medians.residual.push_back(median(residual[j]));
    medians.on_sheet.push_back(median(on_sheet[j]));
  }
  medians.spacing = median(spacing);
  for (std::size_t i = 0; i < count; ++i) on_sheet[usable - 1][i] /= spacing[i];
  medians.relative = median(on_sheet[usable - 1]);
  return medians;
}

// The residual of the size at which it grows least; of the first where it grows everywhere. Noise is there at
// the smallest size already (a third of it at least, though the frame follows it); what is so much larger is
// the shape, whose residual stands still, too, once the neighbours are all around a thin part.
double atPlateau(const std::vector<double>& residual) {
  double least_growth = kNoPlateau;
  double sigma = residual[0];
  for (std::size_t j = 1; j < residual.size(); ++j) {
    const double growth =
        std::log(residual[j] / residual[j - 1]) / std::log(static_cast<double>(kSizes[j]) / kSizes[j - 1]);
    if (residual[j] > kShape * residual[0]) break;
    if (!(growth < least_growth)) continue;  // or both are 0
    least_growth = growth;
    sigma = residual[j];
  }
  return sigma;
}

}  // namespace

NoiseEstimate estimateNoise(const std::vector<Vec3>& points, const NeighborSearch& search,
                            const Context& context) {
  const Medians look = measure(points, search, kFirstSample, std::array<int, 1>{kFirstLook}, context);
  if (look.residual.empty()) return {};
  if (look.relative < kClean) return {look.on_sheet[0], look.relative};
  const Medians medians = measure(points, search, kSample, kSizes, context);
  const double whole = atPlateau(medians.residual), on_sheet = atPlateau(medians.on_sheet);
  const double sigma = on_sheet < kSheets * whole ? on_sheet : whole;
  return {sigma, sigma / medians.spacing};
}

NoiseAdaptation adaptTo(const NoiseEstimate& estimate, const MultiresolutionParameters& parameters) {
  NoiseAdaptation adaptation;
  adaptation.estimate = estimate;
  adaptation.parameters = parameters;
  const double relative = estimate.relative;
  if (!parameters.noise.adapt || relative < kNoisy) return adaptation;
  const double root = std::pow(relative, 0.25);
  ProjectionParameters& projection = adaptation.parameters.projection;
  adaptation.drops_crowded = true;
  adaptation.residual_limit = parameters.noise.residual_limit * estimate.sigma;
  adaptation.parameters.clustering.max_variation = 1.0 / 3;  // it would measure the noise
  const double support = std::clamp(3.4 * root, projection.support_factor, 6.0);
  RefinementParameters& refinement = adaptation.parameters.refinement;
  refinement.threshold = std::max(refinement.threshold, std::min(0.5 * relative / support, 0.1));
  if (relative < kVeryNoisy) {
    projection.support_factor = support;
    projection.neighbors = std::max(projection.neighbors, static_cast<int>(kPi * 4 * support * support));
    return adaptation;
  }
  adaptation.passes = relative < kThreePasses ? 2 : 3;
  adaptation.denoising = projection;
  adaptation.denoising.support_factor = std::clamp(2.8 * root, projection.support_factor, 6.0);
  const double reach = 1.8 * adaptation.denoising.support_factor;
  adaptation.denoising.neighbors = std::max(projection.neighbors, static_cast<int>(kPi * reach * reach));
  return adaptation;
}

std::vector<Vec3> projectAll(const std::vector<Vec3>& points, const NeighborSearch& search,
                             const ProjectionParameters& parameters, double residual_limit,
                             const Context& context) {
  const MlsSurface surface(points, search, parameters, residual_limit);
  std::vector<Vec3> projected(points.size());
  parallelBlocks(context, points.size(), 256, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const Projection projection = surface.project(points[i]);
      const bool stays_near =
          (projection.position - points[i]).norm() <= 2 * projection.support;  // false for NaN too
      projected[i] = stays_near ? projection.position : points[i];
    }
  });
  return projected;
}

}  // namespace mlsmesh::core
