// SPDX-License-Identifier: BSD-3-Clause
#include "compare/studio.h"

#include "common/app_error.h"
#include "common/camera_fit.h"
#include "drawing/layers.h"

#include <vtkCamera.h>
#include <vtkJPEGWriter.h>
#include <vtkMapper.h>
#include <vtkPoints.h>
#include <vtkWindowToImageFilter.h>

namespace mlsmesh::apps {
namespace {

constexpr int kMultiSamples = 8;
constexpr int kQuality = 85;  // of JPEG, 0 .. 100

}  // namespace

Studio::Studio(int side) : side_(side) {
  window_->SetOffScreenRendering(1);
  window_->SetMultiSamples(kMultiSamples);
  window_->SetSize(side, side);
  setUpRenderer(*renderer_);
  renderer_->GradientBackgroundOff();
  window_->AddRenderer(renderer_);
  vtkMapper::SetResolveCoincidentTopologyToPolygonOffset();
}

void Studio::aim(const std::vector<core::Vec3>& extent, const Viewpoint& viewpoint) {
  vtkNew<vtkPoints> points;
  for (const core::Vec3& point : extent) points->InsertNextPoint(point.data());
  fitCamera({points}, viewpoint, 1.0, 1.0, *renderer_->GetActiveCamera());
}

void Studio::take(const std::vector<vtkSmartPointer<vtkProp>>& props, const std::filesystem::path& file) {
  renderer_->RemoveAllViewProps();
  for (const vtkSmartPointer<vtkProp>& prop : props) renderer_->AddViewProp(prop);
  renderer_->ResetCameraClippingRange();
  window_->Render();
  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(window_);
  image->ReadFrontBufferOff();
  vtkNew<vtkJPEGWriter> writer;
  writer->SetQuality(kQuality);
  writer->SetInputConnection(image->GetOutputPort());
  writer->SetFileName(file.c_str());
  writer->Write();
  if (writer->GetErrorCode() != 0) throw fileError(file.string(), "could not be written; is the disk full?");
}

}  // namespace mlsmesh::apps
