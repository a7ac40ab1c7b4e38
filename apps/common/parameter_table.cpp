// SPDX-License-Identifier: BSD-3-Clause
#include "common/parameter_table.h"

#include <limits>
#include <type_traits>

namespace mlsmesh::apps {

namespace {

using All = MultiresolutionParameters;

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

struct Limits {
  double low = 0;
  double high = kNoLimit;
  bool above_low = false;
};

constexpr Limits kPositive{0, kNoLimit, true};
constexpr Limits kNotNegative{0, kNoLimit, false};

template <class T>
constexpr ParameterKind kindOf() {
  if (std::is_same_v<T, bool>) return ParameterKind::Boolean;
  if (std::is_enum_v<T>) return ParameterKind::Choice;
  return std::is_integral_v<T> ? ParameterKind::Whole : ParameterKind::Real;
}

/// Adds the rows of one step; `step` finds its struct among all parameters.
template <class Step>
class StepRows {
 public:
  StepRows(std::vector<Parameter>& table, std::string prefix, Step All::*step)
      : table_(table), prefix_(std::move(prefix)), step_(step) {}

  template <class T>
  Parameter& add(const char* name, T Step::*member, const Limits& limits, const char* help) {
    Step All::*step = step_;
    Parameter row;
    row.name = prefix_ + name;
    row.help = help;
    row.kind = kindOf<T>();
    row.low = limits.low;
    row.high = limits.high;
    row.above_low = limits.above_low;
    row.get = [step, member](const All& all) { return static_cast<double>(all.*step.*member); };
    row.set = [step, member](All& all, double value) { all.*step.*member = static_cast<T>(value); };
    table_.push_back(row);
    return table_.back();
  }

  template <class T>
  Parameter& add(const char* name, T Step::*member, std::vector<std::string> choices, const char* help) {
    Parameter& row = add(name, member, Limits{0, static_cast<double>(choices.size()) - 1, false}, help);
    row.choices = std::move(choices);
    return row;
  }

  Parameter& add(const char* name, bool Step::*member, const char* help) {
    return add(name, member, Limits{0, 1, false}, help);
  }

 private:
  std::vector<Parameter>& table_;
  std::string prefix_;
  Step All::*step_;
};

void addHoles(std::vector<Parameter>& table) {
  Parameter size;
  size.name = "hole_size";
  size.alias = "hole-size";
  size.help =
      "holes of at most so many spacings around are closed by patches; 0 = only the gaps that "
      "triangulation.fill_small_loops closes";
  size.high = kNoLimit;
  size.get = [](const All& all) { return all.hole_size; };
  size.set = [](All& all, double value) { all.hole_size = value; };
  table.push_back(size);
  Parameter watertight;
  watertight.name = "watertight";
  watertight.help = "all holes are closed by patches, whatever their size";
  watertight.kind = ParameterKind::Boolean;
  watertight.high = 1;
  watertight.get = [](const All& all) { return all.watertight ? 1.0 : 0.0; };
  watertight.set = [](All& all, double value) { all.watertight = value != 0; };
  table.push_back(watertight);
}

void addGeneral(std::vector<Parameter>& table) {
  Parameter reduce;
  reduce.name = "reduce";
  reduce.help =
      "replace each cluster by one point on the surface; false triangulates the input points themselves";
  reduce.kind = ParameterKind::Boolean;
  reduce.high = 1;
  reduce.get = [](const All& all) { return all.reduce ? 1.0 : 0.0; };
  reduce.set = [](All& all, double value) { all.reduce = value != 0; };
  table.push_back(reduce);
  Parameter least;
  least.name = "min_representatives";
  least.help = "clusters shrink until there are so many representatives, down to single points";
  least.kind = ParameterKind::Whole;
  least.low = 3;
  least.high = kNoLimit;
  least.get = [](const All& all) { return static_cast<double>(all.min_representatives); };
  least.set = [](All& all, double value) { all.min_representatives = static_cast<int>(value); };
  table.push_back(least);
  addHoles(table);
}

void addClustering(std::vector<Parameter>& table) {
  using Step = ClusteringParameters;
  StepRows<Step> rows(table, "clustering.", &All::clustering);
  rows.add("split_plane", &Step::split_plane, {"largest_spread", "regression_plane"},
           "what the plane that splits a cluster is normal to: the direction of largest variance (v3), or "
           "the normal of "
           "the regression plane (v1)");
  rows.add("split_rule", &Step::split_rule, {"size_or_variation", "size_and_variation"},
           "split a cluster that is too large or not flat, or only one that is both");
  rows.add("max_variation", &Step::max_variation, Limits{0, 1.0 / 3, false},
           "surface variation above which a cluster is split")
      .symbol = "sigma_max";
  rows.add("max_size", &Step::max_size, Limits{1, kNoLimit, false}, "points above which a cluster is split")
      .symbol = "n_max, n_min";
  rows.add("min_leaf", &Step::min_leaf, Limits{1, kNoLimit, false},
           "a split leaves no side with fewer points");
  rows.add("max_gap", &Step::max_gap, Limits{1, kNoLimit, true},
           "cut a cluster at the longest edge of its minimum spanning tree where that is longer than this "
           "many median "
           "edges; 0 = never")
      .zero_is_off = true;
}

void addFeatures(std::vector<Parameter>& table) {
  using Step = FeatureParameters;
  StepRows<Step> rows(table, "features.", &All::features);
  rows.add("detect", &Step::detect, "look for the sharp edges of the surface and keep them");
  rows.add("angle", &Step::angle, Limits{10, 80, false},
           "degrees between the sides of an edge that counts as sharp");
  rows.add("spacing", &Step::spacing, Limits{1, 4, false},
           "local spacings between the vertices that the first mesh has on sharp edges");
  rows.add("max_noise", &Step::max_noise, kPositive,
           "noise, in local spacings, of the worst cloud that is searched for sharp edges");
  rows.add("threshold_share", &Step::threshold_share, kPositive,
           "in a cloud with sharp edges, edges are split from this share of refinement.threshold on");
}

void addProjection(std::vector<Parameter>& table) {
  using Step = ProjectionParameters;
  StepRows<Step> rows(table, "projection.", &All::projection);
  rows.add("neighbors", &Step::neighbors, Limits{4, 512, false}, "points in the fit").symbol = "k";
  rows.add("degree", &Step::degree, Limits{0, 3, false}, "degree of the bivariate polynomial");
  rows.add("method", &Step::method, {"one_step", "levin"},
           "reference plane from one weighted principal component analysis, or Levin's plane and foot point "
           "iterated to "
           "a fixed point");
  rows.add("support_rule", &Step::support_rule, {"local_spacing", "nearest_distance"},
           "unit of the support radius h: local spacing, or the distance of the nearest point (d1)");
  rows.add("support_factor", &Step::support_factor, kPositive,
           "support radius h of the weights, in the unit of the rule")
      .symbol = "h";
  rows.add("tolerance", &Step::tolerance, kPositive,
           "Levin's iteration stops when the foot point moves less than this times local spacing");
  rows.add("max_iterations", &Step::max_iterations, Limits{1, 1000, false},
           "Levin's iteration gives up after so many rounds");
}

void addReduction(std::vector<Parameter>& table) {
  using Step = ReductionParameters;
  StepRows<Step> rows(table, "reduction.", &All::reduction);
  rows.add(
      "clamp", &Step::clamp, {"guarded", "finite_only"},
      "refuse a projection that goes farther than half the cluster radius, or only one that is not finite");
}

void addFront(StepRows<TriangulationParameters>& rows) {
  using Step = TriangulationParameters;
  rows.add("neighbors", &Step::neighbors, Limits{4, 512, false},
           "candidates around each end of a border edge")
      .symbol = "k";
  rows.add("order", &Step::order, {"priority", "first_in_first_out"},
           "border edges with the best triangle first, or in order of arrival");
  rows.add("seeds", &Step::seeds, {"agreed_stars", "single_triangle"},
           "start from all triangles on which the local Delaunay stars of the corners agree, or from one "
           "triangle");
  rows.add("restart", &Step::restart, "start again on unused points, so that every component gets its mesh");
  rows.add("candidates", &Step::candidates, {"both_endpoints", "first_endpoint"},
           "look for the next vertex around both ends of the edge, or around the first");
  rows.add(
      "apex_choice", &Step::apex_choice, {"radius_and_bend", "largest_angle"},
      "take the candidate of least radius and bend, or the one that sees the edge under the largest angle");
}

void addTriangulation(std::vector<Parameter>& table) {
  using Step = TriangulationParameters;
  StepRows<Step> rows(table, "triangulation.", &All::triangulation);
  addFront(rows);
  rows.add("bend_first", &Step::bend_first, Limits{0, 180, false},
           "degrees off flat of the first angle window")
      .symbol = "theta_0";
  rows.add("bend_step", &Step::bend_step, kPositive, "degrees by which the angle window widens").symbol =
      "epsilon_2";
  rows.add("bend_max", &Step::bend_max, Limits{0, 180, false}, "degrees off flat of the last angle window");
  rows.add("length_rule", &Step::length_rule, {"local_spacing", "nearest_distance"},
           "unit of the edge limit: local spacing, or the distance to the nearest neighbour");
  rows.add("length_factor", &Step::length_factor, kPositive,
           "longest edge of a triangle, in the unit of the rule")
      .symbol = "epsilon_1";
  rows.add("overlap_test", &Step::overlap_test, {"all_corners", "apex_star"},
           "test a new triangle against the mesh at all its corners, or at its apex only");
  rows.add("fill_small_loops", &Step::fill_small_loops, "close border loops within the next limits");
  rows.add("fill_max_edges", &Step::fill_max_edges, Limits{3, 64, false},
           "edges of the largest loop that is filled");
  rows.add("fill_max_perimeter", &Step::fill_max_perimeter, kPositive,
           "perimeter of the largest loop that is filled, in spacings of the cloud (where it is sparser, in "
           "those there)");
  rows.add("fill_supported_edges", &Step::fill_supported_edges, Limits{0, 64, false},
           "edges of the largest loop that is filled where the cloud supports every triangle of the fill");
  rows.add("support_reach", &Step::support_reach, kNotNegative,
           "over representatives, a triangle needs points of the cloud within so many local spacings; 0 = no "
           "test");
  rows.add("fill_reach", &Step::fill_reach, kNotNegative,
           "the same for the triangles that fill a loop, if they lie along the surface");
  rows.add("heal", &Step::heal,
           "mend triangles that meet, cut false handles, fill loops where the cloud supports it, take flaps "
           "off borders");
}

void addRefinement(std::vector<Parameter>& table) {
  using Step = RefinementParameters;
  StepRows<Step> rows(table, "refinement.", &All::refinement);
  rows.add("levels", &Step::levels, Limits{0, 10, false},
           "refinement steps; there is one mesh more than steps")
      .alias = "levels";
  rows.add("test", &Step::test, {"displacement", "mean_offset"},
           "split an edge by how far its midpoint is from the surface, or from the mean of its neighbours "
           "(alpha)");
  rows.add("threshold", &Step::threshold, kNotNegative,
           "distance from which an edge is split, in local spacings (displacement) or spacings (mean_offset)")
      .symbol = "epsilon";
  rows.add("split_mode", &Step::split_mode, {"templates", "sequential"},
           "split all marked edges of a triangle at once (1-2, 1-3, 1-4), or one edge after the other");
  rows.add("min_edge_ratio", &Step::min_edge_ratio, Limits{0, 1, false},
           "shortest over longest edge below which a triangle is not divided");
  rows.add("max_displacement", &Step::max_displacement, kPositive,
           "farthest that a new vertex may be from the midpoint, in edge lengths");
  rows.add("border_displacement", &Step::border_displacement, kNotNegative, "the same on border edges");
  rows.add("smooth_borders", &Step::smooth_borders,
           "move borders to the rim of the cloud (but those that watertight closes) and refine them as "
           "smooth curves");
  rows.add("fold_guard", &Step::fold_guard,
           "pull a new vertex back where a triangle turns against its parent or meets another");
  rows.add("fold_angle", &Step::fold_angle, Limits{0, 180, false}, "degrees that a triangle may turn");
  rows.add("flips", &Step::flips, {"min_angle", "length", "no_flips"},
           "flip a diagonal when the smallest angle grows, when the other diagonal is shorter, or never");
  rows.add("flip_guard", &Step::flip_guard,
           "flips keep convexity, normals and bend; false: only the topology");
}

void addNoise(std::vector<Parameter>& table) {
  using Step = NoiseParameters;
  StepRows<Step> rows(table, "noise.", &All::noise);
  rows.add("adapt", &Step::adapt,
           "let the noise of the cloud choose support, projection passes and threshold");
  rows.add("sigma", &Step::sigma, Limits{-1, 1000, false},
           "standard deviation of the points about the surface, in spacings; negative = estimated");
  rows.add("residual_limit", &Step::residual_limit, kNotNegative,
           "a fit that misses its points by more than this * sigma shrinks its support; 0 = never");
}

void addOutliers(std::vector<Parameter>& table) {
  using Step = OutlierParameters;
  StepRows<Step> rows(table, "outliers.", &All::outliers);
  rows.add("remove", &Step::remove, "leave out points that belong to no surface");
  rows.add("link", &Step::link, kPositive,
           "representatives nearer than this many local spacings (at both) belong together");
  rows.add("smallest_group", &Step::smallest_group, Limits{1, kNoLimit, false},
           "points in the smallest floating group that is kept");
}

std::vector<Parameter> makeTable() {
  std::vector<Parameter> table;
  addGeneral(table);
  addClustering(table);
  addFeatures(table);
  addProjection(table);
  addNoise(table);
  addOutliers(table);
  addReduction(table);
  addTriangulation(table);
  addRefinement(table);
  return table;
}

}  // namespace

const std::vector<Parameter>& parameterTable() {
  static const std::vector<Parameter> table = makeTable();
  return table;
}

const Parameter* findParameter(const std::string& name) {
  for (const Parameter& parameter : parameterTable()) {
    if (parameter.name == name || (!parameter.alias.empty() && parameter.alias == name)) return &parameter;
  }
  return nullptr;
}

const std::vector<Preset>& presetTable() {
  static const std::vector<Preset> table = {
      {"default", "robust on scans; what is used unless another is named", &defaultPreset},
      {"paper", "the paper's method with the repairs that it needs on real clouds", &paperPreset},
      {"printed", "the paper's criteria to the letter, as far as they are defined", &printedPreset}};
  return table;
}

const Preset* findPreset(const std::string& name) {
  for (const Preset& preset : presetTable()) {
    if (preset.name == name) return &preset;
  }
  return nullptr;
}

}  // namespace mlsmesh::apps
