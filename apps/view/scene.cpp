// SPDX-License-Identifier: BSD-3-Clause
#include "view/scene.h"

#include "common/camera_fit.h"

#include <vtkBoundingBox.h>
#include <vtkCoordinate.h>
#include <vtkFeatureEdges.h>
#include <vtkLightKit.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkShaderProperty.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>

namespace mlsmesh::apps {
namespace {

constexpr double kDotShare = 1.5;

vtkSmartPointer<vtkActor> makeSurface(const Drawing& drawing, const ViewOptions& options, double pixels) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(drawing.data);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  vtkProperty& look = *actor->GetProperty();
  look.SetColor(0.62, 0.70, 0.80);
  look.SetSpecular(0.2);
  look.SetSpecularPower(25.0);
  look.SetEdgeColor(0.2, 0.23, 0.27);
  look.SetInterpolationToPhong();
  if (drawing.is_mesh) {
    if (options.flat) look.SetInterpolationToFlat();
    look.SetEdgeVisibility(options.edges);
    if (options.wireframe) look.SetRepresentationToWireframe();
    return actor;
  }
  // Dots as wide as the points are apart on the screen, so that a cloud looks like its surface.
  const auto count = static_cast<double>(drawing.data->GetNumberOfVerts());
  look.SetPointSize(static_cast<float>(std::clamp(kDotShare * pixels / std::sqrt(count), 2.0, 12.0)));
  if (drawing.data->GetPointData()->GetNormals() == nullptr) return actor;
  // Their normals have no side, so they are turned towards the viewer.
  actor->GetShaderProperty()->AddFragmentShaderReplacement(
      "//VTK::Normal::Impl", true,
      "//VTK::Normal::Impl\n  if (normalVCVSOutput.z < 0.0) normalVCVSOutput = -normalVCVSOutput;\n", false);
  return actor;
}

vtkSmartPointer<vtkActor> makeBorders(const Drawing& drawing) {
  vtkNew<vtkFeatureEdges> edges;
  edges->SetInputData(drawing.data);
  edges->BoundaryEdgesOn();
  edges->FeatureEdgesOff();
  edges->ManifoldEdgesOff();
  edges->NonManifoldEdgesOn();
  edges->ColoringOff();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(edges->GetOutputPort());
  mapper->ScalarVisibilityOff();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.95, 0.35, 0.05);
  actor->GetProperty()->SetLineWidth(4.0F);
  actor->GetProperty()->LightingOff();
  return actor;
}

vtkSmartPointer<vtkTextActor> makeLabel(const std::string& title, double pixels) {
  auto label = vtkSmartPointer<vtkTextActor>::New();
  label->SetInput(title.c_str());
  label->GetTextProperty()->SetColor(0.2, 0.2, 0.25);
  label->GetTextProperty()->SetFontSize(std::clamp(static_cast<int>(pixels / 34.0), 9, 28));
  label->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  label->SetPosition(0.02, 0.02);
  return label;
}

}  // namespace

Scene::Scene(const std::vector<Drawing>& drawings, const ViewOptions& options, vtkRenderWindow& window)
    : options_(options), window_(window), camera_(vtkSmartPointer<vtkCamera>::New()) {
  const auto [columns, rows] = paneGrid(drawings.size());
  columns_ = columns;
  rows_ = rows;
  // Behind all panes, for the places that none of them takes.
  const auto backdrop = vtkSmartPointer<vtkRenderer>::New();
  backdrop->SetBackground(1.0, 1.0, 1.0);
  backdrop->InteractiveOff();
  window_.AddRenderer(backdrop);
  for (const Drawing& drawing : drawings) panes_.push_back(makePane(drawing));
  placeCamera(drawings);
  showAll();
}

double Scene::paneExtent() const {
  return std::min(static_cast<double>(options_.size[0]) / columns_,
                  static_cast<double>(options_.size[1]) / rows_);
}

Scene::Pane Scene::makePane(const Drawing& drawing) {
  Pane pane;
  pane.renderer = vtkSmartPointer<vtkRenderer>::New();
  pane.renderer->SetActiveCamera(camera_);
  pane.renderer->SetBackground(1.0, 1.0, 1.0);
  pane.renderer->SetBackground2(0.88, 0.91, 0.95);
  pane.renderer->GradientBackgroundOn();
  vtkNew<vtkLightKit> lights;
  lights->SetKeyLightIntensity(1.0);
  lights->SetKeyLightWarmth(0.52);
  lights->AddLightsToRenderer(pane.renderer);
  pane.surface = makeSurface(drawing, options_, paneExtent());
  pane.renderer->AddActor(pane.surface);
  if (drawing.is_mesh) {
    pane.borders = makeBorders(drawing);
    pane.borders->SetVisibility(options_.borders);
    pane.renderer->AddActor(pane.borders);
  }
  if (options_.labels) pane.renderer->AddActor2D(makeLabel(drawing.title, paneExtent()));
  window_.AddRenderer(pane.renderer);
  return pane;
}

void Scene::placeCamera(const std::vector<Drawing>& drawings) {
  vtkBoundingBox box;
  std::vector<vtkPoints*> scene;
  for (const Drawing& drawing : drawings) {
    box.AddBounds(drawing.data->GetBounds());
    scene.push_back(drawing.data->GetPoints());
  }
  const double aspect =
      (static_cast<double>(options_.size[0]) / columns_) / (static_cast<double>(options_.size[1]) / rows_);
  fitCamera(scene, options_.viewpoint, aspect, options_.zoom, *camera_);
  std::array<double, 6> bounds{};
  box.GetBounds(bounds.data());
  for (const Pane& pane : panes_) pane.renderer->ResetCameraClippingRange(bounds.data());
}

void Scene::showAll() {
  shown_ = -1;
  for (std::size_t i = 0; i < panes_.size(); ++i) {
    const int index = static_cast<int>(i);
    const int row_from_top = index / columns_;
    const double column = index % columns_;
    const double row = rows_ - 1 - row_from_top;
    panes_[i].renderer->SetViewport(column / columns_, row / rows_, (column + 1) / columns_,
                                    (row + 1) / rows_);
    panes_[i].renderer->SetDraw(true);
  }
}

void Scene::showOnly(int drawing) {
  const int count = static_cast<int>(panes_.size());
  shown_ = (drawing % count + count) % count;
  for (int i = 0; i < count; ++i) {
    panes_[i].renderer->SetDraw(i == shown_);
    if (i == shown_)
      panes_[i].renderer->SetViewport(0.0, 0.0, 1.0, 1.0);
    else
      panes_[i].renderer->SetViewport(0.0, 0.0, 0.001, 0.001);
  }
}

void Scene::toggleBorders() {
  for (const Pane& pane : panes_) {
    if (pane.borders != nullptr) pane.borders->SetVisibility(pane.borders->GetVisibility() == 0);
  }
}

void Scene::toggleEdges() {
  for (const Pane& pane : panes_)
    pane.surface->GetProperty()->SetEdgeVisibility(pane.surface->GetProperty()->GetEdgeVisibility() == 0);
}

}  // namespace mlsmesh::apps
