// SPDX-License-Identifier: BSD-3-Clause
#include "compare/columns.h"

#include "common/number_text.h"
#include "mlsmesh/statistics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace mlsmesh::apps {
namespace {

using Kind = Column::Kind;
using Value = std::function<double(const Row&)>;

constexpr double kLongSeconds = 1000;  // hundredths of them tell nothing

Value figure(const std::string& group, const std::string& name, double factor = 1) {
  return [=](const Row& row) { return factor * row.figure(group, name); };
}

/// Not a number unless the method came to its end.
Value ifEnded(const Value& value) {
  return [value](const Row& row) { return row.stages.empty() ? kUnknown : value(row); };
}

ColumnGroup cost() {
  ColumnGroup group{"Cost", true, {}};
  auto add = [&](auto&&... parts) { group.columns.push_back({parts...}); };
  add("normals s", "seconds to estimate and orient normals", Kind::Seconds, false,
      ifEnded([](const Row& row) { return row.normalSeconds(); }));
  add("method s", "seconds of everything else, reading and writing left out", Kind::Seconds, false,
      ifEnded([](const Row& row) { return row.methodSeconds(); }));
  add("total s", "seconds of both, by the clock on the wall", Kind::Seconds, false,
      ifEnded([](const Row& row) { return row.totalSeconds(); }));
  add("CPU s", "seconds of processor time of all threads, of both", Kind::Seconds, false,
      ifEnded([](const Row& row) { return row.cpu_seconds; }));
  add("memory MB", "most memory held at once, the program itself included", Kind::Count, false,
      Value([](const Row& row) {
        // One that refused did nothing: what it held is the program.
        const bool has_run = row.status != RowStatus::Refused && row.peak_bytes > 0;
        return has_run ? toMegabytes(row.peak_bytes) : kUnknown;
      }));
  add("vertices", "vertices of the mesh", Kind::Count, false, figure("topology", "vertices"));
  add("triangles", "triangles of the mesh", Kind::Count, false, figure("topology", "triangles"));
  return group;
}

ColumnGroup soundness() {
  ColumnGroup group{"Soundness", false, {}};
  auto add = [&](auto&&... parts) { group.columns.push_back({parts...}); };
  const auto count = [&](const char* heading, const char* meaning, bool is_defect, const char* name) {
    add(heading, meaning, Kind::Count, is_defect, figure("topology", name));
  };
  count("parts", "connected parts", false, "components");
  count("border loops", "closed borders: holes and outlines", false, "border_loops");
  count("genus", "handles; none unless manifold and orientable", false, "genus");
  count("non-manifold edges", "edges of three or more triangles", true, "nonmanifold_edges");
  count("non-manifold vertices", "vertices whose triangles are not one fan", true, "nonmanifold_vertices");
  count("misoriented edges", "edges whose two triangles face opposite sides", true, "orientation_conflicts");
  count("self-intersections", "pairs of triangles that meet where they should not", true,
        "self_intersections");
  count("degenerate faces", "triangles without an area", true, "degenerate_faces");
  add("folded edges", "edges with less than 30 degrees between their triangles", Kind::Count, false,
      figure("shape", "folded_edges"));
  add("quality 5 %", "2 x inradius / circumradius that 5 % of the triangles are below; 1 is equilateral",
      Kind::Real, false, figure("shape", "quality_p5"));
  add("angle 5 %", "degrees that 5 % of the triangles' smallest angles are below", Kind::Real, false,
      figure("shape", "angle_p5"));
  return group;
}

void addTruth(std::vector<Column>& columns) {
  auto add = [&](auto&&... parts) { columns.push_back({parts...}); };
  add("truth mean %", "mean distance from the true surface, both ways, in % of its diagonal", Kind::Real,
      false, figure("truth", "mean_diagonals", 100));
  add("truth max %", "greatest distance from the true surface, both ways, in % of its diagonal", Kind::Real,
      false, figure("truth", "hausdorff_diagonals", 100));
  add("F 0.1 %", "share of both surfaces within 0.1 % of the diagonal (harmonic mean)", Kind::Real, false,
      figure("truth", "f_score_0_1"));
  add("normal error", "mean angle from the true surface's normals, degrees", Kind::Real, false,
      figure("truth", "normal_error_mean"));
}

ColumnGroup faithfulness(bool with_truth) {
  ColumnGroup group{"Faithfulness", false, {}};
  auto add = [&](auto&&... parts) { group.columns.push_back({parts...}); };
  add("triangles", "triangles of the mesh", Kind::Count, false, figure("topology", "triangles"));
  add("cloud mean", "mean distance of the points from the mesh, in spacings", Kind::Real, false,
      figure("cloud_to_mesh", "mean_spacings"));
  add("cloud 95 %", "distance that 95 % of the points are within, in spacings", Kind::Real, false,
      figure("cloud_to_mesh", "p95_spacings"));
  add("cloud max", "greatest distance of a point from the mesh, in spacings", Kind::Real, false,
      figure("cloud_to_mesh", "max_spacings"));
  add("uncovered %", "points farther than 0.5 % of the diagonal from the mesh", Kind::Real, false,
      figure("cloud", "uncovered", 100));
  add("invented %", "area farther than five spacings from every point", Kind::Real, false,
      figure("cloud", "unsupported", 100));
  if (with_truth) addTruth(group.columns);
  return group;
}

}  // namespace

std::string numberText(double value, int digits) {
  if (!std::isfinite(value)) return "–";
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*g", digits, value);
  return text.data();
}

double toMegabytes(std::uint64_t bytes) {
  return static_cast<double>(bytes) / (1 << 20);
}

std::string Column::text(const Row& row) const {
  const double number = value(row);
  if (kind == Kind::Real) return readableText(number);
  if (kind == Kind::Count || !(number < kLongSeconds)) return wholeText(number);
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "%.2f", number);
  return text.data();
}

std::vector<ColumnGroup> columnGroups(bool with_truth) {
  return {cost(), soundness(), faithfulness(with_truth)};
}

std::vector<std::size_t> rowsOf(const ColumnGroup& group, const CloudResult& cloud) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < cloud.rows.size(); ++i)
    if (group.has_all_rows || cloud.rows[i].report.is_object()) rows.push_back(i);
  return rows;
}

std::string resultText(const Row& row) {
  if (row.reason.empty()) return wordsOf(row.status);
  return (row.status == RowStatus::Done ? "" : wordsOf(row.status) + ": ") + row.reason;
}

std::string rowLine(const CloudResult& cloud, const Row& row) {
  std::string line = cloud.name + "  " + row.method->name;
  line.resize(std::max<std::size_t>(line.size(), cloud.name.size() + 19), ' ');
  if (row.status != RowStatus::Done) return line + resultText(row);
  line += readableText(row.totalSeconds()) + " s, " + wholeText(toMegabytes(row.peak_bytes)) + " MB";
  if (!row.reason.empty()) return line + ", " + row.reason;
  return line + ", " + wholeText(row.figure("topology", "triangles")) + " triangles";
}

}  // namespace mlsmesh::apps
