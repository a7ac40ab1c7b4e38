// SPDX-License-Identifier: BSD-3-Clause
#include "mlsmesh/parameters.h"

namespace mlsmesh {

MultiresolutionParameters defaultPreset() {
  return {};
}

MultiresolutionParameters paperPreset() {
  MultiresolutionParameters paper;
  paper.clustering.split_rule = SplitRule::SizeAndVariation;
  paper.clustering.max_variation = 0;
  paper.clustering.min_leaf = 1;
  paper.clustering.max_gap = 0;

  paper.projection.method = ProjectionMethod::Levin;
  paper.projection.support_rule = SupportRule::NearestDistance;
  paper.projection.support_factor = 3;

  paper.noise.adapt = false;
  paper.outliers.remove = false;

  paper.triangulation.seeds = SeedRule::SingleTriangle;

  paper.refinement.test = RefinementTest::MeanOffset;
  paper.refinement.threshold = 0.015;
  paper.refinement.min_edge_ratio = 0.45;
  paper.refinement.flips = FlipRule::Length;
  paper.refinement.smooth_borders = false;

  paper.features.detect = false;
  return paper;
}

MultiresolutionParameters printedPreset() {
  MultiresolutionParameters printed = paperPreset();
  printed.clustering.split_plane = SplitPlane::RegressionPlane;
  printed.reduction.clamp = ClampRule::FiniteOnly;

  printed.triangulation.neighbors = 20;
  printed.triangulation.order = FrontOrder::FirstInFirstOut;
  printed.triangulation.restart = false;
  printed.triangulation.candidates = CandidateRule::FirstEndpoint;
  printed.triangulation.apex_choice = ApexChoice::LargestAngle;
  printed.triangulation.bend_first = 15;
  printed.triangulation.bend_step = 15;
  printed.triangulation.bend_max = 90;
  printed.triangulation.length_rule = LengthRule::NearestDistance;
  printed.triangulation.length_factor = 3;
  printed.triangulation.overlap_test = OverlapTest::ApexStar;
  printed.triangulation.fill_small_loops = false;
  printed.triangulation.support_reach = 0;
  printed.triangulation.heal = false;

  printed.refinement.split_mode = SplitMode::Sequential;
  printed.refinement.fold_guard = false;
  printed.refinement.flip_guard = false;
  return printed;
}

}  // namespace mlsmesh
