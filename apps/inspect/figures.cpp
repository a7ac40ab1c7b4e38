// SPDX-License-Identifier: BSD-3-Clause
#include "inspect/figures.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace mlsmesh::apps {

namespace {

/// Adds the figures of one group.
class Group {
 public:
  Group(std::string name, FigureTable& table) : name_(std::move(name)), table_(table) {}

  template <class Number>
  void count(const char* name, Number value) {
    table_.add({name_, name, Figure::Kind::Count, static_cast<double>(value)});
  }
  void count(const char* name, const std::optional<core::Index>& value) {
    table_.add({name_, name, Figure::Kind::Count, value ? static_cast<double>(*value) : kUnknown});
  }
  void real(const std::string& name, double value) { table_.add({name_, name, Figure::Kind::Real, value}); }
  void flag(const char* name, bool value) {
    table_.add({name_, name, Figure::Kind::Flag, value ? 1.0 : 0.0});
  }
  /// A length, and the same in another unit.
  void length(const std::string& name, double value, const char* suffix, double unit) {
    real(name, value);
    real(name + suffix, unit > 0 ? value / unit : kUnknown);
  }
  void distances(const Statistics& statistics, const char* suffix, double unit) {
    length("mean", statistics.mean, suffix, unit);
    length("rms", statistics.rms, suffix, unit);
    length("p95", statistics.p95, suffix, unit);
    length("p99", statistics.p99, suffix, unit);
    length("max", statistics.max, suffix, unit);
  }

 private:
  std::string name_;
  FigureTable& table_;
};

void addInput(const TriangleFile& mesh, FigureTable& table) {
  Group group("input", table);
  group.count("polygons", mesh.polygons);
  group.count("dropped_faces", mesh.dropped_faces);
  group.count("non_finite_vertices", mesh.non_finite_vertices);
  group.count("welded_vertices", mesh.welded_vertices);
}

double totalLength(const std::vector<Border>& borders) {
  double sum = 0;
  for (const Border& border : borders) sum += border.length;
  return sum;
}

void addTopology(const MeshTopology& topology, std::int64_t self_intersections, FigureTable& table) {
  Group group("topology", table);
  group.count("vertices", topology.vertices);
  group.count("edges", topology.edges);
  group.count("triangles", topology.triangles);
  group.count("components", topology.components.size());
  group.count("edge_components", topology.edge_components);
  group.count("closed_components", topology.closed_components);
  group.flag("closed", topology.isClosed());
  group.count("border_loops", topology.border_loops);
  group.count("border_chains", topology.border_chains);
  group.count("border_edges", topology.border_edges);
  group.real("border_length", totalLength(topology.borders));
  group.real("longest_border", topology.borders.empty() ? 0 : topology.borders.front().length);
  group.count("euler", topology.euler);
  group.count("genus", topology.genus);
  group.flag("manifold", topology.isManifold());
  group.count("nonmanifold_edges", topology.nonmanifold_edges);
  group.count("nonmanifold_vertices", topology.nonmanifold_vertices);
  group.count("bow_tie_vertices", topology.bow_tie_vertices);
  group.flag("orientable", topology.orientable);
  group.count("orientation_conflicts", topology.orientation_conflicts);
  group.count("inward_components", topology.inward_components);
  group.count("degenerate_faces", topology.degenerate_faces);
  group.count("duplicate_faces", topology.duplicate_faces);
  group.count("isolated_vertices", topology.isolated_vertices);
  group.count("coincident_vertices", topology.coincident_vertices);
  group.count("self_intersections", self_intersections);
}

void addShape(const MeshShape& shape, const MeshTopology& topology, FigureTable& table) {
  Group group("shape", table);
  double volume = 0;
  for (const ComponentTopology& component : topology.components) volume += component.volume;
  const bool has_volume =
      topology.isClosed() && topology.nonmanifold_edges == 0 && topology.orientation_conflicts == 0;
  group.real("diagonal", shape.diagonal);
  group.real("area", shape.area);
  group.real("volume", has_volume ? volume : kUnknown);
  group.real("quality_min", shape.quality.min);
  group.real("quality_p5", shape.quality.p5);
  group.real("quality_mean", shape.quality.mean);
  group.real("angle_min", shape.smallest_angle.min);
  group.real("angle_p5", shape.smallest_angle.p5);
  group.real("angle_mean_min", shape.smallest_angle.mean);
  group.real("angle_max", shape.largest_angle.max);
  group.real("edge_min", shape.edge_length.min);
  group.real("edge_mean", shape.edge_length.mean);
  group.real("edge_max", shape.edge_length.max);
  group.real("dihedral_min", shape.smallest_dihedral);
  group.count("folded_edges", shape.folded_edges);
  group.count("flipped_edges", shape.flipped_edges);
}

void addCloud(const CloudDistances& distances, FigureTable& table) {
  Group cloud("cloud", table);
  cloud.count("points", distances.points);
  cloud.count("non_finite", distances.non_finite);
  cloud.real("spacing", distances.spacing);
  cloud.real("diagonal", distances.diagonal);
  cloud.real("uncovered", distances.uncovered);
  cloud.real("unsupported", distances.unsupported);
  Group("cloud_to_mesh", table).distances(distances.cloud_to_mesh, "_spacings", distances.spacing);
  Group("mesh_to_cloud", table).distances(distances.mesh_to_cloud, "_spacings", distances.spacing);
}

/// "f_score_0_25" for a tolerance of 0.25 %.
std::string withPercent(const std::string& name, double tolerance) {
  char percent[16];
  std::snprintf(percent, sizeof percent, "%g", 100 * tolerance);
  std::string text = name + "_" + percent;
  std::replace(text.begin(), text.end(), '.', '_');
  return text;
}

void addTruth(const SurfaceDistances& distances, const MeshTopology& truth, FigureTable& table) {
  Group group("truth", table);
  group.count("triangles", truth.triangles);
  group.count("components", truth.components.size());
  group.count("border_loops", truth.border_loops);
  group.count("genus", truth.genus);
  group.real("diagonal", distances.diagonal);
  group.length("mean", distances.mean, "_diagonals", distances.diagonal);
  group.length("rms", distances.rms, "_diagonals", distances.diagonal);
  group.length("hausdorff", distances.hausdorff, "_diagonals", distances.diagonal);
  for (const FScore& score : distances.f_scores) {
    group.real(withPercent("precision", score.tolerance), score.precision);
    group.real(withPercent("recall", score.tolerance), score.recall);
    group.real(withPercent("f_score", score.tolerance), score.score);
  }
  group.real("normal_consistency", distances.normal_consistency);
  group.real("normal_error_mean", distances.normal_error.mean);
  group.real("normal_error_p95", distances.normal_error.p95);
  group.real("same_side", distances.same_side);
  Group("mesh_to_truth", table).distances(distances.mesh_to_truth, "_diagonals", distances.diagonal);
  Group("truth_to_mesh", table).distances(distances.truth_to_mesh, "_diagonals", distances.diagonal);
}

}  // namespace

std::string Figure::text() const {
  if (std::isnan(value)) return "-";
  if (kind == Kind::Flag) return value != 0 ? "yes" : "no";
  char digits[32];
  std::snprintf(digits, sizeof digits, kind == Kind::Count ? "%.0f" : "%.6g", value);
  return digits;
}

std::vector<const Figure*> FigureTable::find(const std::string& name) const {
  std::vector<const Figure*> same_name;
  for (const Figure& figure : figures_) {
    if (figure.path() == name) return {&figure};
    if (figure.name == name) same_name.push_back(&figure);
  }
  // What belongs to the mesh itself goes before what its cloud and the truth have, too.
  const bool is_of_mesh = !same_name.empty() && same_name.front()->group == "topology";
  if (is_of_mesh) same_name.resize(1);
  return same_name;
}

std::vector<std::string> FigureTable::names() const {
  std::vector<std::string> names;
  for (const Figure& figure : figures_) {
    names.push_back(figure.name);
    names.push_back(figure.path());
  }
  return names;
}

FigureTable figuresOf(const Inspection& inspection) {
  FigureTable table;
  addInput(inspection.mesh, table);
  addTopology(inspection.topology, inspection.self_intersections, table);
  addShape(inspection.shape, inspection.topology, table);
  if (inspection.cloud) addCloud(*inspection.cloud, table);
  if (inspection.truth) addTruth(*inspection.truth, inspection.truth_topology, table);
  return table;
}

}  // namespace mlsmesh::apps
