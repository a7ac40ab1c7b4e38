// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/marks.h"

#include "drawing/poly_data.h"

#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

#include <cstdio>

namespace mlsmesh::apps {
namespace {

using core::Index;

constexpr Rgb kCrossingColor{213, 94, 0};
constexpr Rgb kDegenerateColor{20, 20, 20};
constexpr Rgb kDuplicateColor{240, 228, 66};
constexpr Rgb kNonmanifoldColor{0, 90, 150};
constexpr Rgb kConflictColor{204, 121, 167};
constexpr Rgb kBadVertexColor{0, 158, 115};
constexpr Rgb kNormalColor{213, 94, 0};
constexpr Rgb kRepresentativeColor{0, 90, 150};

/// Not shaded, drawn over the surface that it lies on.
vtkSmartPointer<vtkActor> markActor(vtkPolyData* data, const Rgb& color) {
  constexpr double kTowardsViewer = -4.0;
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  mapper->SetResolveCoincidentTopologyToPolygonOffset();
  mapper->SetRelativeCoincidentTopologyPolygonOffsetParameters(-1.0, kTowardsViewer);
  mapper->SetRelativeCoincidentTopologyLineOffsetParameters(-1.0, kTowardsViewer);
  mapper->SetRelativeCoincidentTopologyPointOffsetParameter(kTowardsViewer);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(unitRgb(color).data());
  actor->GetProperty()->LightingOff();
  return actor;
}

vtkSmartPointer<vtkActor> lineActor(vtkPolyData* lines, const Rgb& color, float width) {
  vtkSmartPointer<vtkActor> actor = markActor(lines, color);
  actor->GetProperty()->SetLineWidth(width);
  return actor;
}

/// Round dots; those that shine through are in front of everything.
vtkSmartPointer<vtkActor> dotActor(vtkPolyData* points, const Rgb& color, float size, bool shine_through) {
  constexpr double kBeforeAll = -60000.0;
  vtkSmartPointer<vtkActor> actor = markActor(points, color);
  if (shine_through) actor->GetMapper()->SetRelativeCoincidentTopologyPointOffsetParameter(kBeforeAll);
  actor->GetProperty()->SetPointSize(size);
  actor->GetProperty()->RenderPointsAsSpheresOn();
  return actor;
}

std::vector<core::Vec3> centersOf(const Shape& mesh, const std::vector<Index>& triangles) {
  std::vector<core::Vec3> centers;
  centers.reserve(triangles.size());
  for (const Index triangle : triangles) {
    const auto [a, b, c] = mesh.triangles[triangle];
    centers.emplace_back((mesh.points[a] + mesh.points[b] + mesh.points[c]) / 3.0);
  }
  return centers;
}

std::vector<core::Vec3> middlesOf(const Shape& mesh, const std::vector<MeshEdge>& edges) {
  std::vector<core::Vec3> middles;
  middles.reserve(edges.size());
  for (const auto& [a, b] : edges) middles.emplace_back((mesh.points[a] + mesh.points[b]) / 2.0);
  return middles;
}

/// Adds the marks of the kinds of defects that a mesh has, one kind after the other.
class DefectMarker {
 public:
  DefectMarker(const Shape& mesh, Marks& marks) : mesh_(mesh), marks_(marks) {}

  void triangles(const std::string& name, const std::vector<Index>& triangles, const Rgb& color) {
    if (!enter(name, triangles.size(), color)) return;
    vtkSmartPointer<vtkActor> actor = markActor(trianglesOf(mesh_, triangles), color);
    actor->GetProperty()->EdgeVisibilityOn();
    actor->GetProperty()->SetEdgeColor(unitRgb(kEdgeColor).data());
    marks_.actors.push_back(actor);
    dots(centersOf(mesh_, triangles), color);
  }
  void edges(const std::string& name, const std::vector<MeshEdge>& edges, const Rgb& color) {
    constexpr float kWidth = 5.0F;
    if (!enter(name, edges.size(), color)) return;
    marks_.actors.push_back(lineActor(edgesOf(mesh_, edges), color, kWidth));
    dots(middlesOf(mesh_, edges), color);
  }
  void vertices(const std::string& name, const std::vector<Index>& vertices, const Rgb& color) {
    if (!enter(name, vertices.size(), color)) return;
    std::vector<core::Vec3> places;
    places.reserve(vertices.size());
    for (const Index vertex : vertices) places.push_back(mesh_.points[vertex]);
    dots(places, color);
  }

 private:
  bool enter(const std::string& name, std::size_t count, const Rgb& color) {
    if (count > 0) marks_.legend.push_back({std::to_string(count) + " " + name, color});
    return count > 0;
  }
  void dots(const std::vector<core::Vec3>& places, const Rgb& color) {
    constexpr float kSize = 9.0F;
    marks_.actors.push_back(dotActor(pointsOf(places), color, kSize, true));
  }

  const Shape& mesh_;
  Marks& marks_;
};

std::string borderText(const BorderEdges& border) {
  std::array<char, 96> text{};
  std::snprintf(text.data(), text.size(), "%s of %zu edges, length %.4g", border.is_loop ? "loop" : "chain",
                border.edges.size(), border.length);
  return text.data();
}

}  // namespace

Marks borderMarks(const Shape& mesh, const std::vector<BorderEdges>& borders) {
  constexpr std::size_t kNamed = 7;  // of the longest, in the legend
  constexpr float kWidth = 6.0F;
  // Those of the categories that are dark enough on a pale surface.
  static constexpr std::array<int, 5> kColors{0, 2, 4, 6, 5};
  Marks marks;
  std::vector<MeshEdge> edges;
  std::vector<Rgb> colors;
  for (std::size_t i = 0; i < borders.size(); ++i) {
    const Rgb color = categoryColor(kColors[i % kColors.size()]);
    edges.insert(edges.end(), borders[i].edges.begin(), borders[i].edges.end());
    colors.insert(colors.end(), borders[i].edges.size(), color);
    if (i < kNamed) marks.legend.push_back({borderText(borders[i]), color});
  }
  if (borders.size() > kNamed)
    marks.legend.push_back({std::to_string(borders.size() - kNamed) + " shorter ones", kPaleSurfaceColor});
  if (borders.empty()) {
    marks.legend.push_back({"no border", kPaleSurfaceColor});
    return marks;
  }
  vtkSmartPointer<vtkActor> lines = lineActor(edgesOf(mesh, edges, colors), kCrossingColor, kWidth);
  lines->GetProperty()->RenderLinesAsTubesOn();
  marks.actors.push_back(lines);
  return marks;
}

Marks defectMarks(const Shape& mesh, const MeshDefects& defects) {
  Marks marks;
  DefectMarker marker(mesh, marks);
  marker.triangles("crossing triangles (" + std::to_string(defects.self_intersections) + " pairs)",
                   defects.crossing_faces, kCrossingColor);
  marker.triangles("duplicate faces", defects.duplicate_faces, kDuplicateColor);
  marker.triangles("degenerate faces", defects.degenerate_faces, kDegenerateColor);
  marker.edges("edges of three faces or more", defects.nonmanifold_edges, kNonmanifoldColor);
  marker.edges("orientation conflicts", defects.orientation_conflicts, kConflictColor);
  marker.vertices("non-manifold vertices", defects.nonmanifold_vertices, kBadVertexColor);
  if (defects.empty()) marks.legend.push_back({"no defects", kPaleSurfaceColor});
  return marks;
}

std::vector<core::Vec3> placesOf(const Shape& mesh, const std::vector<BorderEdges>& borders) {
  std::vector<core::Vec3> places;
  for (const BorderEdges& border : borders) {
    core::Vec3 sum(0, 0, 0);
    for (const MeshEdge& edge : border.edges) sum += mesh.points[edge[0]];
    places.emplace_back(sum / static_cast<double>(border.edges.size()));
  }
  return places;
}

std::vector<core::Vec3> placesOf(const Shape& mesh, const MeshDefects& defects) {
  std::vector<core::Vec3> places;
  const auto add = [&](const std::vector<core::Vec3>& more) {
    places.insert(places.end(), more.begin(), more.end());
  };
  add(centersOf(mesh, defects.crossing_faces));
  add(centersOf(mesh, defects.duplicate_faces));
  add(centersOf(mesh, defects.degenerate_faces));
  add(middlesOf(mesh, defects.nonmanifold_edges));
  add(middlesOf(mesh, defects.orientation_conflicts));
  for (const Index vertex : defects.nonmanifold_vertices) places.push_back(mesh.points[vertex]);
  return places;
}

Marks normalMarks(const Shape& points, double length) {
  Shape ends = points;
  std::vector<MeshEdge> lines;
  const auto count = static_cast<Index>(points.points.size());
  for (Index i = 0; i < count; ++i) {
    ends.points.emplace_back(points.points[i] + length * points.normals[i]);
    lines.push_back({i, count + i});
  }
  Marks marks;
  marks.actors.push_back(lineActor(edgesOf(ends, lines), kNormalColor, 1.5F));
  marks.actors.push_back(dotActor(pointsOf(points.points), kRepresentativeColor, 5.0F, false));
  return marks;
}

}  // namespace mlsmesh::apps
