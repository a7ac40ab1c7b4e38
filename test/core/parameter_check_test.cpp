// SPDX-License-Identifier: BSD-3-Clause
#include "mlsmesh/core/parameter_check.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "mlsmesh/core/failure.h"

namespace mlsmesh::core {
namespace {

using Parameters = MultiresolutionParameters;

std::string refusal(const Parameters& parameters) {
  const Status status = guarded([&] { check(parameters); });
  EXPECT_TRUE(status.ok() || status.code == StatusCode::InvalidParameter);
  return status.message;
}

/// A member with the ends of its range, and values just outside.
struct Member {
  std::string name;
  std::function<void(Parameters&, double)> set;
  std::vector<double> good;
  std::vector<double> bad;
  bool is_real = true;
};

std::vector<Member> members() {
  const double tiny = 1e-300, large = 1e300;
  return {
      {"min_representatives",
       [](auto& p, double v) { p.min_representatives = static_cast<int>(v); },
       {3, 1e9},
       {2, -1},
       false},
      {"clustering.max_variation",
       [](auto& p, double v) { p.clustering.max_variation = v; },
       {0, 1.0 / 3},
       {-tiny, 0.34}},
      {"clustering.max_size",
       [](auto& p, double v) { p.clustering.max_size = static_cast<int>(v); },
       {1, 1e9},
       {0},
       false},
      {"clustering.min_leaf",
       [](auto& p, double v) { p.clustering.min_leaf = static_cast<int>(v); },
       {1, 1e9},
       {0},
       false},
      {"clustering.max_gap",
       [](auto& p, double v) { p.clustering.max_gap = v; },
       {0, 1.001, large},
       {-1, 0.5, 1}},
      {"projection.neighbors",
       [](auto& p, double v) { p.projection.neighbors = static_cast<int>(v); },
       {4, 512},
       {3, 513},
       false},
      {"projection.degree",
       [](auto& p, double v) { p.projection.degree = static_cast<int>(v); },
       {0, 3},
       {-1, 4},
       false},
      {"projection.support_factor",
       [](auto& p, double v) { p.projection.support_factor = v; },
       {tiny, large},
       {0, -1}},
      {"projection.tolerance", [](auto& p, double v) { p.projection.tolerance = v; }, {tiny, large}, {0, -1}},
      {"projection.max_iterations",
       [](auto& p, double v) { p.projection.max_iterations = static_cast<int>(v); },
       {1, 1000},
       {0, 1001},
       false},
      {"triangulation.neighbors",
       [](auto& p, double v) { p.triangulation.neighbors = static_cast<int>(v); },
       {4, 512},
       {2, 513},
       false},
      {"triangulation.bend_first",
       [](auto& p, double v) { p.triangulation.bend_first = v; },
       {0, 180},
       {-1, 181}},
      {"triangulation.bend_step",
       [](auto& p, double v) { p.triangulation.bend_step = v; },
       {tiny, large},
       {0, -1}},
      {"triangulation.bend_max",
       [](auto& p, double v) { p.triangulation.bend_max = v; },
       {0, 180},
       {-1, 181}},
      {"triangulation.length_factor",
       [](auto& p, double v) { p.triangulation.length_factor = v; },
       {tiny, large},
       {0, -1}},
      {"triangulation.fill_max_edges",
       [](auto& p, double v) { p.triangulation.fill_max_edges = static_cast<int>(v); },
       {3, 64},
       {2, 65},
       false},
      {"triangulation.fill_max_perimeter",
       [](auto& p, double v) { p.triangulation.fill_max_perimeter = v; },
       {tiny, large},
       {0, -1}},
      {"triangulation.fill_supported_edges",
       [](auto& p, double v) { p.triangulation.fill_supported_edges = static_cast<int>(v); },
       {0, 64},
       {-1, 65},
       false},
      {"triangulation.support_reach",
       [](auto& p, double v) { p.triangulation.support_reach = v; },
       {0, large},
       {-tiny}},
      {"triangulation.fill_reach",
       [](auto& p, double v) { p.triangulation.fill_reach = v; },
       {0, large},
       {-tiny}},
      {"refinement.levels",
       [](auto& p, double v) { p.refinement.levels = static_cast<int>(v); },
       {0, 10},
       {-1, 11},
       false},
      {"refinement.threshold", [](auto& p, double v) { p.refinement.threshold = v; }, {0, large}, {-tiny}},
      {"refinement.min_edge_ratio",
       [](auto& p, double v) { p.refinement.min_edge_ratio = v; },
       {0, 1},
       {-tiny, 1.1}},
      {"refinement.max_displacement",
       [](auto& p, double v) { p.refinement.max_displacement = v; },
       {tiny, large},
       {0, -1}},
      {"refinement.border_displacement",
       [](auto& p, double v) { p.refinement.border_displacement = v; },
       {0, large},
       {-tiny}},
      {"refinement.fold_angle", [](auto& p, double v) { p.refinement.fold_angle = v; }, {0, 180}, {-1, 181}},
  };
}

TEST(ParameterCheck, AcceptsThePresets) {
  EXPECT_EQ(refusal(defaultPreset()), "");
  EXPECT_EQ(refusal(paperPreset()), "");
  EXPECT_EQ(refusal(printedPreset()), "");
}

TEST(ParameterCheck, AcceptsTheEndsOfEveryRange) {
  for (const Member& member : members()) {
    for (const double value : member.good) {
      Parameters parameters;
      member.set(parameters, value);
      EXPECT_EQ(refusal(parameters), "") << member.name;
    }
  }
}

TEST(ParameterCheck, NamesTheMemberThatIsOutOfItsRange) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const Member& member : members()) {
    std::vector<double> bad = member.bad;
    if (member.is_real)
      bad.insert(bad.end(), {infinity, -infinity, std::numeric_limits<double>::quiet_NaN()});
    for (const double value : bad) {
      Parameters parameters;
      member.set(parameters, value);
      EXPECT_EQ(refusal(parameters).rfind(member.name + " is ", 0), 0u) << member.name << " = " << value;
    }
  }
}

TEST(ParameterCheck, SaysWhatTheRangeIs) {
  Parameters parameters;
  parameters.triangulation.neighbors = 2;
  EXPECT_EQ(refusal(parameters), "triangulation.neighbors is 2; it must be 4 .. 512");
  parameters = {};
  parameters.refinement.threshold = -0.5;
  EXPECT_EQ(refusal(parameters), "refinement.threshold is -0.5; it must be at least 0 and finite");
}

TEST(Presets, ThePaperKeepsTheCriteriaThatThePrintDefines) {
  const Parameters paper = paperPreset(), printed = printedPreset();
  EXPECT_EQ(paper.clustering.split_rule, SplitRule::SizeAndVariation);
  EXPECT_EQ(paper.clustering.split_plane, SplitPlane::LargestSpread) << "one of the two repairs";
  EXPECT_EQ(printed.clustering.split_plane, SplitPlane::RegressionPlane);
  EXPECT_EQ(paper.triangulation.order, FrontOrder::Priority) << "the other repair";
  EXPECT_EQ(printed.triangulation.order, FrontOrder::FirstInFirstOut);
  EXPECT_EQ(paper.projection.method, ProjectionMethod::Levin);
  EXPECT_EQ(printed.projection.method, ProjectionMethod::Levin);
}

}  // namespace
}  // namespace mlsmesh::core
