// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/poly_data.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPCANormalEstimation.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>

namespace mlsmesh::apps {
namespace {

constexpr int kShadingNeighbors = 16;
constexpr vtkIdType kMostShadedPoints = 3000000;

vtkIdType idOf(std::size_t index) {
  return static_cast<vtkIdType>(index);
}

vtkSmartPointer<vtkPoints> toPoints(const std::vector<core::Vec3>& positions) {
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(idOf(positions.size()));
  for (std::size_t i = 0; i < positions.size(); ++i) points->SetPoint(idOf(i), positions[i].data());
  return points;
}

template <typename Triangles>
vtkSmartPointer<vtkCellArray> toCells(const Triangles& triangles) {
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->AllocateExact(idOf(triangles.size()), 3 * idOf(triangles.size()));
  for (const core::Triangle& triangle : triangles) {
    const std::array<vtkIdType, 3> ids{triangle[0], triangle[1], triangle[2]};
    cells->InsertNextCell(3, ids.data());
  }
  return cells;
}

vtkSmartPointer<vtkCellArray> vertexCells(std::size_t count) {
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->AllocateExact(idOf(count), idOf(count));
  for (vtkIdType i = 0; i < idOf(count); ++i) cells->InsertNextCell(1, &i);
  return cells;
}

vtkSmartPointer<vtkFloatArray> toNormals(const std::vector<core::Vec3>& normals) {
  auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetName("Normals");
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(idOf(normals.size()));
  for (std::size_t i = 0; i < normals.size(); ++i) array->SetTuple(idOf(i), normals[i].data());
  return array;
}

vtkSmartPointer<vtkUnsignedCharArray> toColors(const std::vector<Rgb>& colors) {
  auto array = vtkSmartPointer<vtkUnsignedCharArray>::New();
  array->SetName("Colors");
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(idOf(colors.size()));
  for (std::size_t i = 0; i < colors.size(); ++i) array->SetTypedTuple(idOf(i), colors[i].data());
  return array;
}

}  // namespace

vtkSmartPointer<vtkPolyData> toPolyData(const Shape& shape) {
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(toPoints(shape.points));
  if (shape.isMesh())
    data->SetPolys(toCells(shape.triangles));
  else
    data->SetVerts(vertexCells(shape.points.size()));
  if (!shape.normals.empty()) data->GetPointData()->SetNormals(toNormals(shape.normals));
  if (!shape.colors.empty()) data->GetPointData()->SetScalars(toColors(shape.colors));
  return data;
}

vtkSmartPointer<vtkPolyData> trianglesOf(const Shape& shape, const std::vector<core::Index>& triangles) {
  std::vector<core::Triangle> chosen;
  chosen.reserve(triangles.size());
  for (const core::Index triangle : triangles) chosen.push_back(shape.triangles[triangle]);
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(toPoints(shape.points));
  data->SetPolys(toCells(chosen));
  return data;
}

vtkSmartPointer<vtkPolyData> edgesOf(const Shape& shape, const std::vector<MeshEdge>& edges,
                                     const std::vector<Rgb>& colors) {
  vtkNew<vtkCellArray> lines;
  std::vector<core::Vec3> ends;
  ends.reserve(2 * edges.size());
  for (const auto& [from, to] : edges) {
    const std::array<vtkIdType, 2> ids{idOf(ends.size()), idOf(ends.size()) + 1};
    lines->InsertNextCell(2, ids.data());
    ends.push_back(shape.points[from]);
    ends.push_back(shape.points[to]);
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(toPoints(ends));
  data->SetLines(lines);
  if (!colors.empty()) data->GetCellData()->SetScalars(toColors(colors));
  return data;
}

vtkSmartPointer<vtkPolyData> pointsOf(const std::vector<core::Vec3>& points) {
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(toPoints(points));
  data->SetVerts(vertexCells(points.size()));
  return data;
}

vtkSmartPointer<vtkPolyData> withShadingNormals(vtkPolyData* cloud) {
  if (cloud->GetPointData()->GetNormals() != nullptr || cloud->GetNumberOfPoints() < kShadingNeighbors ||
      cloud->GetNumberOfPoints() > kMostShadedPoints) {
    return cloud;
  }
  vtkNew<vtkPCANormalEstimation> normals;
  normals->SetInputData(cloud);
  normals->SetSampleSize(kShadingNeighbors);
  normals->SetNormalOrientationToPoint();
  normals->Update();
  vtkSmartPointer<vtkPolyData> shaded = normals->GetOutput();
  shaded->SetVerts(cloud->GetVerts());
  return shaded;
}

}  // namespace mlsmesh::apps
