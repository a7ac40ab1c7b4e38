// SPDX-License-Identifier: BSD-3-Clause
#include "view/overlay.h"

#include "drawing/notes.h"
#include "drawing/palette.h"
#include "view/keys.h"

#include <vtkCellArray.h>
#include <vtkCoordinate.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <array>

namespace mlsmesh::apps {
namespace {

// Of the bar, as shares of the window.
constexpr double kLeft = 0.25, kRight = 0.75, kBottom = 0.08, kTop = 0.10;
constexpr Rgb kBarColor{0, 90, 150};
constexpr Rgb kFrameColor{200, 205, 212};

/// A rectangle from the left end of the bar to `right`.
void setCorners(double right, vtkPoints& points) {
  const std::array<std::array<double, 2>, 4> corners{
      {{kLeft, kBottom}, {right, kBottom}, {right, kTop}, {kLeft, kTop}}};
  for (std::size_t i = 0; i < corners.size(); ++i)
    points.SetPoint(static_cast<vtkIdType>(i), corners[i][0], corners[i][1], 0.0);
  points.Modified();
}

vtkSmartPointer<vtkActor2D> rectangle(vtkPoints* corners, const Rgb& color) {
  vtkNew<vtkCellArray> cells;
  const std::array<vtkIdType, 4> ids{0, 1, 2, 3};
  cells->InsertNextCell(4, ids.data());
  vtkNew<vtkPolyData> data;
  data->SetPoints(corners);
  data->SetPolys(cells);
  vtkNew<vtkCoordinate> share_of_window;
  share_of_window->SetCoordinateSystemToNormalizedViewport();
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(data);
  mapper->SetTransformCoordinate(share_of_window);
  auto actor = vtkSmartPointer<vtkActor2D>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(unitRgb(color).data());
  actor->VisibilityOff();
  return actor;
}

vtkSmartPointer<vtkPoints> makeCorners(double right) {
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetNumberOfPoints(4);
  setCorners(right, *points);
  return points;
}

}  // namespace

Overlay::Overlay(vtkRenderWindow& window, int font_size)
    : renderer_(vtkSmartPointer<vtkRenderer>::New()), bar_(makeCorners(kLeft)) {
  renderer_->SetLayer(1);
  renderer_->InteractiveOff();
  window.SetNumberOfLayers(2);
  window.AddRenderer(renderer_);
  const vtkSmartPointer<vtkPoints> frame = makeCorners(kRight);
  frame_actor_ = rectangle(frame, kFrameColor);
  bar_actor_ = rectangle(bar_, kBarColor);
  text_ = notice("", font_size);
  text_->GetPositionCoordinate()->SetReferenceCoordinate(nullptr);
  text_->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  text_->SetPosition(0.5, 0.13);
  text_->VisibilityOff();
  help_ = table(keyHelp(), std::max(8, 3 * font_size / 4));
  help_->VisibilityOff();
  for (vtkActor2D* actor : {frame_actor_.Get(), bar_actor_.Get()}) renderer_->AddActor2D(actor);
  renderer_->AddActor2D(text_);
  renderer_->AddActor2D(help_);
}

void Overlay::toggleHelp() {
  help_->SetVisibility(help_->GetVisibility() == 0);
}

void Overlay::showProgress(const std::string& text, double fraction) {
  text_->SetInput(text.c_str());
  setCorners(kLeft + std::clamp(fraction, 0.0, 1.0) * (kRight - kLeft), *bar_);
  text_->VisibilityOn();
  frame_actor_->VisibilityOn();
  bar_actor_->VisibilityOn();
}

void Overlay::hideProgress() {
  text_->VisibilityOff();
  frame_actor_->VisibilityOff();
  bar_actor_->VisibilityOff();
}

}  // namespace mlsmesh::apps
