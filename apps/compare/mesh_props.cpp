// SPDX-License-Identifier: BSD-3-Clause
#include "compare/mesh_props.h"

#include "compare/color_scale.h"
#include "compare/edge_marks.h"
#include "mlsmesh/core/self_intersections.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkLookupTable.h>
#include <vtkPCANormalEstimation.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkShaderProperty.h>

#include <algorithm>
#include <cmath>

namespace mlsmesh::apps {
namespace {

constexpr double kMostCrossings = 1e6;
constexpr std::size_t kMostDots = 200000;
constexpr int kShadingNeighbors = 16;
constexpr double kDotShare = 1.5;    // of the distance of dots on the screen
constexpr double kLineUnit = 600.0;  // pixels of a side for which widths of lines are meant
constexpr int kShades = 256;

using Data = vtkSmartPointer<vtkPolyData>;
using Actor = vtkSmartPointer<vtkActor>;

void setColor(vtkProperty& look, const Rgb& color) {
  look.SetColor(color[0] / 255.0, color[1] / 255.0, color[2] / 255.0);
}

vtkSmartPointer<vtkPoints> pointsOf(const std::vector<core::Vec3>& positions, const core::Vec3& middle) {
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetNumberOfPoints(static_cast<vtkIdType>(positions.size()));
  for (std::size_t i = 0; i < positions.size(); ++i)
    points->SetPoint(static_cast<vtkIdType>(i), core::Vec3(positions[i] - middle).data());
  return points;
}

/// Cells of so many corners each.
template <class Cell>
vtkSmartPointer<vtkCellArray> cellsOf(const std::vector<Cell>& cells) {
  auto array = vtkSmartPointer<vtkCellArray>::New();
  for (const Cell& cell : cells) {
    array->InsertNextCell(static_cast<int>(cell.size()));
    for (const core::Index corner : cell) array->InsertCellPoint(corner);
  }
  return array;
}

Data trianglesOf(vtkPoints* points, const std::vector<core::Triangle>& triangles) {
  auto data = Data::New();
  data->SetPoints(points);
  data->SetPolys(cellsOf(triangles));
  return data;
}

Actor actorOf(vtkPolyData* data) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  auto actor = Actor::New();
  actor->SetMapper(mapper);
  return actor;
}

Actor surfaceOf(vtkPoints* points, const std::vector<core::Triangle>& triangles, const Rgb& front,
                const Rgb& back) {
  Actor actor = actorOf(trianglesOf(points, triangles));
  vtkProperty& look = *actor->GetProperty();
  setColor(look, front);
  look.SetInterpolationToFlat();
  look.SetAmbient(0.1);
  vtkNew<vtkProperty> behind;
  behind->DeepCopy(actor->GetProperty());
  setColor(*behind, back);
  actor->SetBackfaceProperty(behind);
  return actor;
}

Actor linesOf(vtkPoints* points, const std::vector<EdgeMarks::Edge>& edges, const Rgb& color, double width,
              int side) {
  auto data = Data::New();
  data->SetPoints(points);
  data->SetLines(cellsOf(edges));
  Actor actor = actorOf(data);
  setColor(*actor->GetProperty(), color);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetLineWidth(static_cast<float>(std::max(1.0, width * side / kLineUnit)));
  return actor;
}

/// Triangles that meet no other, and those that do.
std::array<std::vector<core::Triangle>, 2> splitByCrossing(const TriangleFile& mesh, double crossings) {
  std::vector<char> meets(mesh.triangles.size(), 0);
  if (crossings > 0 && crossings <= kMostCrossings) {
    const core::Context context;
    const core::SelfIntersections search(mesh.vertices, mesh.triangles, context);
    for (const core::TrianglePair& pair : search.all())
      for (const core::Index triangle : pair) meets[triangle] = 1;
  }
  std::array<std::vector<core::Triangle>, 2> parts;
  for (std::size_t i = 0; i < meets.size(); ++i) parts.at(meets[i]).push_back(mesh.triangles[i]);
  return parts;
}

vtkSmartPointer<vtkLookupTable> scaleTable(double end) {
  auto table = vtkSmartPointer<vtkLookupTable>::New();
  table->SetNumberOfTableValues(kShades);
  table->SetTableRange(0, end);
  for (int i = 0; i < kShades; ++i) {
    const Rgb color = scaleColor(i / (kShades - 1.0));
    table->SetTableValue(i, color[0] / 255.0, color[1] / 255.0, color[2] / 255.0);
  }
  return table;
}

vtkSmartPointer<vtkDoubleArray> arrayOf(const std::vector<double>& values) {
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  for (const double value : values) array->InsertNextValue(value);
  return array;
}

void useScale(vtkActor& actor, double end) {
  actor.GetMapper()->SetLookupTable(scaleTable(end));
  actor.GetMapper()->UseLookupTableScalarRangeOn();
  actor.GetMapper()->ScalarVisibilityOn();
}

/// Every so many-th item, so that few enough are left.
template <class Item>
std::vector<Item> thinned(const std::vector<Item>& items) {
  const std::size_t step = items.size() / kMostDots + 1;
  std::vector<Item> kept;
  for (std::size_t i = 0; i < items.size(); i += step) kept.push_back(items[i]);
  return kept;
}

/// Lights dots by normals that are estimated for that alone; these have no side and are turned to the viewer.
Actor litDots(vtkPolyData* dots) {
  vtkNew<vtkPCANormalEstimation> normals;
  normals->SetInputData(dots);
  normals->SetSampleSize(kShadingNeighbors);
  normals->SetNormalOrientationToPoint();
  normals->Update();
  const Data lit = normals->GetOutput();
  lit->SetVerts(dots->GetVerts());
  Actor actor = actorOf(lit);
  setColor(*actor->GetProperty(), MarkColors::kFront);
  actor->GetShaderProperty()->AddFragmentShaderReplacement(
      "//VTK::Normal::Impl", true,
      "//VTK::Normal::Impl\n  if (normalVCVSOutput.z < 0.0) normalVCVSOutput = -normalVCVSOutput;\n", false);
  return actor;
}

}  // namespace

Props markedSurface(const TriangleFile& mesh, double crossings, const core::Vec3& middle, int side) {
  const auto points = pointsOf(mesh.vertices, middle);
  const auto [clear, crossing] = splitByCrossing(mesh, crossings);
  const EdgeMarks marks = markEdges(mesh.triangles);
  Props props{surfaceOf(points, clear, MarkColors::kFront, MarkColors::kBack),
              surfaceOf(points, crossing, MarkColors::kIntersecting, MarkColors::kIntersecting),
              linesOf(points, marks.misoriented, MarkColors::kMisoriented, 1.2, side),
              linesOf(points, marks.border, MarkColors::kBorder, 3.0, side),
              linesOf(points, marks.nonmanifold, MarkColors::kNonManifold, 6.0, side)};
  return props;
}

Props coloredSurface(const TriangleFile& mesh, const std::vector<double>& values, double end,
                     const core::Vec3& middle) {
  const Data data = trianglesOf(pointsOf(mesh.vertices, middle), mesh.triangles);
  data->GetCellData()->SetScalars(arrayOf(values));
  Actor actor = actorOf(data);
  actor->GetProperty()->SetInterpolationToFlat();
  actor->GetProperty()->SetAmbient(0.45);
  actor->GetProperty()->SetDiffuse(0.6);
  useScale(*actor, end);
  return {actor};
}

Props coloredDots(const std::vector<core::Vec3>& points, const std::vector<double>& values, double end,
                  const core::Vec3& middle, int side) {
  const std::vector<core::Vec3> kept = thinned(points);
  auto data = Data::New();
  data->SetPoints(pointsOf(kept, middle));
  std::vector<std::array<core::Index, 1>> dots(kept.size());
  for (std::size_t i = 0; i < dots.size(); ++i) dots[i] = {static_cast<core::Index>(i)};
  data->SetVerts(cellsOf(dots));
  const bool is_lit = values.empty() && kept.size() >= kShadingNeighbors;
  Actor actor = is_lit ? litDots(data) : actorOf(data);
  const double size =
      kDotShare * side / std::sqrt(static_cast<double>(std::max<std::size_t>(1, kept.size())));
  actor->GetProperty()->SetPointSize(static_cast<float>(std::clamp(size, 2.0, 12.0)));
  if (!is_lit) actor->GetProperty()->LightingOff();
  if (!values.empty()) {
    data->GetPointData()->SetScalars(arrayOf(thinned(values)));
    useScale(*actor, end);
  }
  return {actor};
}

}  // namespace mlsmesh::apps
