// SPDX-License-Identifier: BSD-3-Clause
#include "compare/mesh_props.h"

#include "compare/mark_colors.h"
#include "drawing/layers.h"
#include "drawing/poly_data.h"
#include "mlsmesh/mesh_defects.h"

#include <vtkActor.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkMapper.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>

#include <algorithm>

namespace mlsmesh::apps {
namespace {

constexpr std::size_t kMostDots = 200000;
constexpr double kLineUnit = 600.0;  // pixels of a side for which widths of lines are meant

using Actor = vtkSmartPointer<vtkActor>;

Actor flatSurface(vtkPolyData* triangles, const Rgb& front, const Rgb& back) {
  Actor actor = surfaceActor(triangles, front);
  SurfaceLook look;
  look.flat = true;
  setLook(look, *actor);
  vtkNew<vtkProperty> behind;
  behind->DeepCopy(actor->GetProperty());
  behind->SetColor(unitRgb(back).data());
  actor->SetBackfaceProperty(behind);
  return actor;
}

Actor lines(const Shape& mesh, const std::vector<MeshEdge>& edges, const Rgb& color, double width, int side) {
  Actor actor = surfaceActor(edgesOf(mesh, edges), color);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetLineWidth(static_cast<float>(std::max(1.0, width * side / kLineUnit)));
  return actor;
}

std::vector<MeshEdge> borderEdges(const Shape& mesh) {
  std::vector<MeshEdge> edges;
  for (const BorderEdges& border : findBorders(mesh.points, mesh.triangles))
    edges.insert(edges.end(), border.edges.begin(), border.edges.end());
  return edges;
}

/// All triangles but those, which are ascending.
std::vector<core::Index> othersThan(const std::vector<core::Index>& triangles, const Shape& mesh) {
  std::vector<core::Index> others;
  auto next = triangles.begin();
  for (core::Index i = 0; i < static_cast<core::Index>(mesh.triangles.size()); ++i) {
    if (next != triangles.end() && *next == i)
      ++next;
    else
      others.push_back(i);
  }
  return others;
}

vtkSmartPointer<vtkDoubleArray> arrayOf(const std::vector<double>& values) {
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  for (const double value : values) array->InsertNextValue(value);
  return array;
}

/// Every so many-th item, so that few enough are left.
template <class Item>
std::vector<Item> thinned(const std::vector<Item>& items) {
  const std::size_t step = items.size() / kMostDots + 1;
  std::vector<Item> kept;
  for (std::size_t i = 0; i < items.size(); i += step) kept.push_back(items[i]);
  return kept;
}

}  // namespace

Props markedSurface(const Shape& mesh, int side) {
  const MeshDefects defects = findDefects(mesh.points, mesh.triangles, core::Context());
  const Actor clear = flatSurface(trianglesOf(mesh, othersThan(defects.crossing_faces, mesh)),
                                  MarkColors::kFront, MarkColors::kBack);
  const Actor crossing = flatSurface(trianglesOf(mesh, defects.crossing_faces), MarkColors::kIntersecting,
                                     MarkColors::kIntersecting);
  return {clear, crossing, lines(mesh, defects.orientation_conflicts, MarkColors::kMisoriented, 1.2, side),
          lines(mesh, borderEdges(mesh), MarkColors::kBorder, 3.0, side),
          lines(mesh, defects.nonmanifold_edges, MarkColors::kNonManifold, 6.0, side)};
}

Props coloredSurface(const Shape& mesh, const std::vector<double>& values, double end) {
  const vtkSmartPointer<vtkPolyData> data = toPolyData(mesh);
  data->GetCellData()->SetScalars(arrayOf(values));
  const Actor actor = valueActor(data, valueColors(end));
  SurfaceLook look;
  look.flat = true;
  setLook(look, *actor);
  return {actor};
}

Props coloredDots(const Shape& cloud, const std::vector<double>& values, double end, int side) {
  const std::vector<core::Vec3> kept = thinned(cloud.points);
  const vtkSmartPointer<vtkPolyData> data = withShadingNormals(pointsOf(kept));
  const Actor actor = cloudActor(data, MarkColors::kFront);
  actor->GetProperty()->SetPointSize(dotSize(static_cast<double>(kept.size()), side));
  if (values.empty()) return {actor};
  data->GetPointData()->SetScalars(arrayOf(thinned(values)));
  vtkMapper& mapper = *actor->GetMapper();
  mapper.SetLookupTable(valueColors(end));
  mapper.UseLookupTableScalarRangeOn();
  actor->GetProperty()->SetSpecular(0.0);
  actor->GetProperty()->SetAmbient(0.35);
  actor->GetProperty()->SetDiffuse(0.65);
  return {actor};
}

}  // namespace mlsmesh::apps
