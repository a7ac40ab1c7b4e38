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
#include <vtkPLYReader.h>
#include <vtkPointData.h>
#include <vtkPolyDataNormals.h>
#include <vtkPolyDataReader.h>
#include <vtkSTLReader.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLPolyDataReader.h>

#include <array>
#include <cmath>

namespace mlsmesh::apps {
namespace {

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

/// STL repeats every vertex for each triangle: one of each, for smooth shading and for borders.
vtkSmartPointer<vtkPolyData> merged(vtkPolyData* soup) {
  vtkNew<vtkCleanPolyData> cleaner;
  cleaner->SetInputData(soup);
  cleaner->PointMergingOn();
  cleaner->Update();
  return cleaner->GetOutput();
}

void addColors(const pcl::PCLPointCloud2& cloud, vtkPolyData& data) {
  const std::vector<FieldSlot> slots = fieldSlots(cloud);
  const std::array<const FieldSlot*, 3> components{findSlot(slots, "red"), findSlot(slots, "green"),
                                                   findSlot(slots, "blue")};
  if (components[0] == nullptr || components[1] == nullptr || components[2] == nullptr) return;
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("RGB");
  colors->SetNumberOfComponents(3);
  for (std::size_t i = 0; i < pointCount(cloud); ++i) {
    for (const FieldSlot* component : components) {
      colors->InsertNextValue(static_cast<unsigned char>(slotValue(cloud, *component, i)));
    }
  }
  data.GetPointData()->SetScalars(colors);
}

vtkSmartPointer<vtkPolyData> readPoints(const std::filesystem::path& file) {
  pcl::PCLPointCloud2 cloud;
  readCloud(file, cloud);
  const std::vector<FieldSlot> slots = fieldSlots(cloud);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (std::size_t i = 0; i < pointCount(cloud); ++i) {
    points->InsertNextPoint(slotValue(cloud, *findSlot(slots, "x"), i),
                            slotValue(cloud, *findSlot(slots, "y"), i),
                            slotValue(cloud, *findSlot(slots, "z"), i));
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  addColors(cloud, *data);
  return data;
}

/// One vertex cell for each point that can be drawn.
void setVertexCells(vtkPolyData& cloud) {
  vtkNew<vtkCellArray> cells;
  for (vtkIdType i = 0; i < cloud.GetNumberOfPoints(); ++i) {
    const double* place = cloud.GetPoint(i);
    if (std::isfinite(place[0]) && std::isfinite(place[1]) && std::isfinite(place[2]))
      cells->InsertNextCell(1, &i);
  }
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
    drawing.data = readPoints(file);
    setVertexCells(*drawing.data);
    if (drawing.data->GetNumberOfVerts() == 0)
      throw fileError(file.string(), "holds no finite point; nothing to draw");
  }
  drawing.title = file.filename().string() + "   " +
                  (drawing.is_mesh ? std::to_string(drawing.data->GetNumberOfPolys()) + " faces"
                                   : std::to_string(drawing.data->GetNumberOfVerts()) + " points");
  return drawing;
}

}  // namespace mlsmesh::apps
