// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The parameters of every step. Lengths are multiples of spacing: "local spacing" ls is that of the place,
// "spacing" that of the whole cloud (median distance of a point to its nearest other point). Symbols in
// [brackets] are those of Mederos, Velho, de Figueiredo, SIBGRAPI 2003. Default, unit and range stand beside
// each member; `check(parameters)` (core/parameter_check.h) names the first member that is out of range.

namespace mlsmesh {

/// Normal of the plane that splits a cluster at its centroid.
enum class SplitPlane {
  LargestSpread,    ///< v3, the direction of largest variance (Pauly, Gross, Kobbelt 2002)
  RegressionPlane,  ///< v1, the normal of the regression plane, as printed in the paper
};

/// When a cluster of n points and surface variation sigma is split.
enum class SplitRule {
  SizeOrVariation,   ///< n > n_max or sigma > sigma_max (Pauly)
  SizeAndVariation,  ///< n > n_min and sigma > sigma_max, as printed
};

/// Step 1: BSP clustering (paper section 2.1).
struct ClusteringParameters {
  SplitPlane split_plane = SplitPlane::LargestSpread;
  SplitRule split_rule = SplitRule::SizeOrVariation;
  double max_variation = 0.02;  ///< surface variation above which a cluster is split, 0 .. 1/3  [sigma_max]
  int max_size = 11;  ///< points above which a cluster is split, >= 1  [n_max; n_min with SizeAndVariation]
  int min_leaf = 3;   ///< a split leaves no side with fewer points, >= 1
  /// A leaf that bridges parts which do not touch is cut at the longest edge of its minimum spanning tree
  /// where that is longer than max_gap * the median edge; 0 = never, else > 1.
  double max_gap = 8.0;
};

/// How the local reference plane of the projection is found.
enum class ProjectionMethod {
  OneStep,  ///< weighted principal component plane at x, once
  Levin,    ///< plane and foot point alternate to a fixed point (Levin 2003, Alexa et al. 2003), as printed
};

/// Where the support radius h of the weights exp(-d^2/h^2) comes from.
enum class SupportRule {
  LocalSpacing,     ///< factor * d_k / sqrt(k / pi), d_k the distance of the k-th neighbour
  NearestDistance,  ///< factor * d_1, d_1 the distance of the nearest point, as printed
};

/// The projection Psi on the moving-least-squares surface: one function of (Q, x, k, degree, h rule).
struct ProjectionParameters {
  int neighbors = 20;  ///< points in the fit, 4 .. 512  [k]
  int degree = 2;      ///< of the bivariate polynomial, 0 .. 3
  ProjectionMethod method = ProjectionMethod::OneStep;
  SupportRule support_rule = SupportRule::LocalSpacing;
  double support_factor =
      1.5;  ///< of h, in the unit of the rule, > 0 (the paper's h = 3 d_1: 3 with NearestDistance)
  double tolerance = 1e-6;  ///< Levin stops when the foot point moves less than this * local spacing, > 0
  int max_iterations = 40;  ///< Levin gives up after so many rounds, 1 .. 1000
};

/// When a projected representative is refused.
enum class ClampRule {
  Guarded,  ///< farther from its start than half the cluster radius: lower degree, then nearest input point
  FiniteOnly,  ///< only when it is not finite
};

/// Step 2: reduction (paper section 2.2); its projection is ProjectionParameters.
struct ReductionParameters {
  ClampRule clamp = ClampRule::Guarded;
};

/// Order in which border edges are worked off.
enum class FrontOrder {
  Priority,         ///< smallest circumradius / ls * (1 + (bend / 45 degrees)^2) first
  FirstInFirstOut,  ///< as printed
};

/// What the front starts from.
enum class SeedRule {
  AgreedStars,     ///< triangles on which the local Delaunay stars of all three corners agree
  SingleTriangle,  ///< one triangle (p, q, r), as printed
};

/// Where the apex of the next triangle is looked for.
enum class CandidateRule {
  BothEndpoints,  ///< neighbours of u and of v
  FirstEndpoint,  ///< neighbours of u, as printed
};

/// Longest edges a triangle may have.
enum class LengthRule {
  LocalSpacing,     ///< length_factor * max(ls(u), ls(v))
  NearestDistance,  ///< length_factor * min(d_u, d_v), d_x the distance of x to its nearest neighbour, as
                    ///< printed
};

/// Which candidate of the narrowest admissible angle window is taken.
enum class ApexChoice {
  RadiusAndBend,  ///< the one of least priority value (see FrontOrder)
  LargestAngle,   ///< the one that sees uv under the largest angle, as printed
};

/// What keeps a new triangle from overlapping the mesh.
enum class OverlapTest {
  AllCorners,  ///< sectors at all three corners, contained points, crossing front edges
  ApexStar,    ///< star of the apex only, as printed
};

/// Step 3: advancing front (paper section 2.3).
struct TriangulationParameters {
  int neighbors = 16;  ///< candidates around each endpoint, 4 .. 512  [k]
  FrontOrder order = FrontOrder::Priority;
  SeedRule seeds = SeedRule::AgreedStars;
  bool restart = true;  ///< start again on unused points (further components)
  CandidateRule candidates = CandidateRule::BothEndpoints;
  ApexChoice apex_choice = ApexChoice::RadiusAndBend;
  double bend_first = 60.0;  ///< degrees off flat of the first angle window, 0 .. 180  [theta_0]
  double bend_step = 45.0;   ///< degrees by which the window widens, > 0  [epsilon_2]
  double bend_max = 135.0;   ///< degrees, the last window, 0 .. 180
  LengthRule length_rule = LengthRule::LocalSpacing;
  double length_factor = 4.0;  ///< in the unit of the rule, > 0  [epsilon_1]
  OverlapTest overlap_test = OverlapTest::AllCorners;
  bool fill_small_loops = true;  ///< close border loops within the next limits
  int fill_max_edges = 6;        ///< edges of a loop that is filled, 3 .. 64
  /// Of a loop that is filled, in spacings of the cloud, or of its points there where they are sparser, > 0
  double fill_max_perimeter = 50.0;
  int fill_supported_edges = 40;  ///< edges of a loop filled where the cloud supports it, 0 .. 64
  /// Over representatives: a triangle needs a point of the cloud within so many local spacings of its
  /// centroid and of the midpoints of its edges, so that openings stay open; 0 = no such test.
  double support_reach = 2.0;
  double fill_reach = 4.0;  ///< the same for the fill of a loop that lies along the surface
  /// mend what meets itself, cut false handles, fill loops that the cloud supports, take flaps off borders
  bool heal = true;
};

/// Which edges are split.
enum class RefinementTest {
  Displacement,  ///< |<Psi(m) - m, n_m>| >= threshold * local spacing
  MeanOffset,  ///< |alpha| >= threshold * spacing, alpha = mean of (p - m) . n_m, as printed (with the right
               ///< sign)
};

/// How marked edges are split.
enum class SplitMode {
  Templates,   ///< all marked edges of a triangle at once: 1-2, 1-3, 1-4
  Sequential,  ///< one edge after the other, as printed
};

/// Diagonal flips after each level.
enum class FlipRule {
  MinAngle,  ///< when the smallest of the six angles grows
  Length,    ///< when the other diagonal is shorter, as printed
  NoFlips,
};

/// Step 4: refinement (paper section 2.4); its projection is ProjectionParameters.
struct RefinementParameters {
  int levels = 2;  ///< refinement steps, 0 .. 10
  RefinementTest test = RefinementTest::Displacement;
  double threshold = 0.05;  ///< in the unit of the test, >= 0  [epsilon]
  SplitMode split_mode = SplitMode::Templates;
  double min_edge_ratio = 0.1;    ///< shortest / longest edge below which a triangle is not divided, 0 .. 1
  double max_displacement = 0.5;  ///< of a new vertex from the midpoint, in edge lengths, > 0
  double border_displacement = 0.25;  ///< the same on border edges, >= 0
  /// Borders are smooth curves along the rim of the cloud: over representatives, border vertices move there,
  /// and new ones in the surface too; false: they lie inside, and new ones move along the normal alone.
  /// Borders that watertight closes stay: patches go on better from the triangles of the representatives.
  bool smooth_borders = true;
  /// pull a new vertex back where a child turns against its parent, or meets a triangle that it should not
  bool fold_guard = true;
  double fold_angle = 60.0;  ///< degrees that a child may turn, 0 .. 180
  FlipRule flips = FlipRule::MinAngle;
  bool flip_guard = true;  ///< flips must keep convexity, normals and bend; false: topology alone, as printed
};

/// What the noise of the cloud, estimated once, changes in the other steps. It leaves clean clouds alone.
struct NoiseParameters {
  bool adapt = true;  ///< false: every cloud is taken as clean
  double sigma = -1;  ///< standard deviation about the surface, in spacings; negative: estimated
  double residual_limit =
      1.35;  ///< a fit that misses its points by more * sigma shrinks its support; 0 = never
};

/// Points that belong to no surface.
struct OutlierParameters {
  bool remove = true;  ///< false: every cluster gets its representative
  double link = 4.0;  ///< representatives nearer than this many local spacings (at both) belong together, > 0
  int smallest_group = 10;  ///< points of the cloud in the smallest group that is kept, >= 1
};

/// Sharp edges of the surface, found in the cloud and kept by every step.
struct FeatureParameters {
  bool detect = true;
  double angle = 30.0;           ///< degrees between the sides of an edge that counts as sharp, 10 .. 80
  double spacing = 2.0;          ///< local spacings between the vertices that level 0 has on it, 1 .. 4
  double max_noise = 0.1;        ///< estimated noise of a cloud that is searched, in local spacings, > 0
  double threshold_share = 0.6;  ///< in a cloud with sharp edges, edges are split from this share of
                                 ///< refinement.threshold on, > 0
};

/// All four steps.
struct MultiresolutionParameters {
  bool reduce = true;            ///< false: triangulate the input points themselves
  int min_representatives = 50;  ///< clusters shrink until there are so many, down to single points, >= 3
  /// Holes of at most so many (global) spacings around are closed by patches; 0 = none but the gaps that
  /// triangulation.fill_* let the front close, >= 0.
  double hole_size = 0;
  bool watertight = false;  ///< all holes are closed by patches, whatever their size
  ClusteringParameters clustering;
  FeatureParameters features;
  ProjectionParameters projection;  ///< one Psi for reduction and refinement
  NoiseParameters noise;
  OutlierParameters outliers;
  ReductionParameters reduction;
  TriangulationParameters triangulation;
  RefinementParameters refinement;
};

/// The presets `default`, `paper` (the method with the repairs it needs on real clouds) and `printed` (its
/// criteria to the letter). docs/parameters.md lists where they differ.
MultiresolutionParameters defaultPreset();
MultiresolutionParameters paperPreset();
MultiresolutionParameters printedPreset();

}  // namespace mlsmesh
