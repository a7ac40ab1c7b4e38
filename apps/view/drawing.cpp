// SPDX-License-Identifier: BSD-3-Clause
#include "view/drawing.h"

#include "common/app_error.h"
#include "common/cloud_columns.h"
#include "common/cloud_io.h"
#include "common/file_bytes.h"
#include "common/header_check.h"
#include "common/vtk_legacy.h"

#include <pcl/PCLPointCloud2.h>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCleanPolyData.h>
#include <vtkIdList.h>
#include <vtkOBJReader.h>
#include <vtkPCANormalEstimation.h>
#include <vtkPLYReader.h>
#include <vtkPointData.h>
#include <vtkPolyDataNormals.h>
#include <vtkPolyDataReader.h>
#include <vtkSTLReader.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLPolyDataReader.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace mlsmesh::apps {
namespace {

constexpr int kShadingNeighbors = 16;
constexpr vtkIdType kMaxShadedPoints = 3000000;

template <typename Reader>
vtkSmartPointer<vtkPolyData> readWith(const std::filesystem::path& file) {
  vtkNew<Reader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
}

/// What VTK makes of the file; null where its extension is none of a mesh.
vtkSmartPointer<vtkPolyData> readPolygons(const std::filesystem::path& file) {
  const std::string extension = extensionOf(file);
  if (extension == "ply") {
    checkPlyHeader(file);
    return readWith<vtkPLYReader>(file);
  }
  if (extension == "vtk") {
    pointsOfLegacyVtk(readBytes(file), file.string());
    return readWith<vtkPolyDataReader>(file);
  }
  if (extension == "vtp") {
    checkVtpHeader(file);
    return readWith<vtkXMLPolyDataReader>(file);
  }
  checkReadable(file);
  if (extension == "obj") return readWith<vtkOBJReader>(file);
  if (extension == "stl") return readWith<vtkSTLReader>(file);
  return nullptr;
}

/// Throws AppError if a cell names a point that is not there.
void checkCells(vtkPolyData& data, const std::filesystem::path& file) {
  const auto check = [&](vtkCellArray* cells) {
    vtkNew<vtkIdList> ids;
    for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell) {
      cells->GetCellAtId(cell, ids);
      for (const vtkIdType id : *ids) {
        if (id >= 0 && id < data.GetNumberOfPoints()) continue;
        throw fileError(file.string(), "a face names a vertex that is not there; the file is damaged");
      }
    }
  };
  for (vtkCellArray* cells : {data.GetPolys(), data.GetStrips(), data.GetLines(), data.GetVerts()})
    check(cells);
}

/// Keeps the point data that are colours as scalars, and normals; drops the rest, which VTK would draw in
/// false colours.
void keepColorsAndNormals(vtkPolyData& data) {
  vtkPointData& fields = *data.GetPointData();
  for (int i = fields.GetNumberOfArrays() - 1; i >= 0; --i) {
    vtkDataArray* field = fields.GetArray(i);
    if (field != nullptr && field == fields.GetNormals()) continue;
    const bool is_color =
        vtkUnsignedCharArray::SafeDownCast(field) != nullptr && field->GetNumberOfComponents() >= 3;
    if (is_color)
      fields.SetActiveScalars(field->GetName());
    else
      fields.RemoveArray(i);
  }
  data.GetCellData()->Initialize();
}

vtkSmartPointer<vtkPolyData> withNormals(vtkPolyData* mesh) {
  if (mesh->GetPointData()->GetNormals() != nullptr) return mesh;
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(mesh);
  normals->SplittingOff();
  normals->ConsistencyOff();
  normals->Update();
  return normals->GetOutput();
}

/// Normals for the shading of a cloud; their signs mean nothing.
vtkSmartPointer<vtkPolyData> withEstimatedNormals(vtkPolyData* cloud) {
  if (cloud->GetNumberOfPoints() < kShadingNeighbors || cloud->GetNumberOfPoints() > kMaxShadedPoints)
    return cloud;
  vtkNew<vtkPCANormalEstimation> normals;
  normals->SetInputData(cloud);
  normals->SetSampleSize(kShadingNeighbors);
  normals->SetNormalOrientationToPoint();
  normals->Update();
  return normals->GetOutput();
}

/// STL repeats every vertex for each triangle: one of each, for smooth shading and for borders.
vtkSmartPointer<vtkPolyData> merged(vtkPolyData* soup) {
  vtkNew<vtkCleanPolyData> cleaner;
  cleaner->SetInputData(soup);
  cleaner->PointMergingOn();
  cleaner->Update();
  return cleaner->GetOutput();
}

/// The slots of those names, in order; empty if one is missing.
std::vector<const FieldSlot*> findSlots(const std::vector<FieldSlot>& slots,
                                        const std::vector<std::string>& names) {
  std::vector<const FieldSlot*> found;
  found.reserve(names.size());
  for (const std::string& name : names) found.push_back(findSlot(slots, name));
  const bool complete = std::find(found.begin(), found.end(), nullptr) == found.end();
  return complete ? found : std::vector<const FieldSlot*>();
}

/// The finite points, with their colours if they have any.
vtkSmartPointer<vtkPolyData> readPoints(const std::filesystem::path& file) {
  pcl::PCLPointCloud2 cloud;
  readCloud(file, cloud);
  const std::vector<FieldSlot> slots = fieldSlots(cloud);
  const std::vector<const FieldSlot*> position = findSlots(slots, {"x", "y", "z"});
  const std::vector<const FieldSlot*> color = findSlots(slots, {"red", "green", "blue"});
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("RGB");
  colors->SetNumberOfComponents(3);
  for (std::size_t i = 0; i < pointCount(cloud); ++i) {
    std::array<double, 3> place{};
    std::transform(position.begin(), position.end(), place.begin(),
                   [&](const FieldSlot* slot) { return slotValue(cloud, *slot, i); });
    if (!std::isfinite(place[0] + place[1] + place[2])) continue;
    points->InsertNextPoint(place.data());
    for (const FieldSlot* slot : color)
      colors->InsertNextValue(static_cast<unsigned char>(slotValue(cloud, *slot, i)));
  }
  if (points->GetNumberOfPoints() == 0)
    throw fileError(file.string(), "holds no finite point; nothing to draw");
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  if (!color.empty()) data->GetPointData()->SetScalars(colors);
  return data;
}

/// One vertex cell for each point.
void setVertexCells(vtkPolyData& cloud) {
  vtkNew<vtkCellArray> cells;
  for (vtkIdType i = 0; i < cloud.GetNumberOfPoints(); ++i) cells->InsertNextCell(1, &i);
  cloud.SetVerts(cells);
}

}  // namespace

Drawing readDrawing(const std::filesystem::path& file) {
  Drawing drawing;
  drawing.data = readPolygons(file);
  drawing.is_mesh = drawing.data != nullptr && drawing.data->GetNumberOfPolys() > 0;
  if (drawing.is_mesh) {
    checkCells(*drawing.data, file);
    keepColorsAndNormals(*drawing.data);
    if (extensionOf(file) == "stl") drawing.data = merged(drawing.data);
    drawing.data = withNormals(drawing.data);
  } else {
    drawing.data = withEstimatedNormals(readPoints(file));
    setVertexCells(*drawing.data);
  }
  drawing.title = file.filename().string() + "   " +
                  (drawing.is_mesh ? std::to_string(drawing.data->GetNumberOfPolys()) + " faces"
                                   : std::to_string(drawing.data->GetNumberOfVerts()) + " points");
  return drawing;
}

}  // namespace mlsmesh::apps
