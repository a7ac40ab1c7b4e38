// SPDX-License-Identifier: BSD-3-Clause
#include "compare/studio.h"

#include "common/app_error.h"
#include "common/camera_fit.h"

#include <vtkJPEGWriter.h>
#include <vtkLightKit.h>
#include <vtkMapper.h>
#include <vtkWindowToImageFilter.h>

namespace mlsmesh::apps {
namespace {

constexpr int kMultiSamples = 8;
constexpr int kQuality = 85;  // of JPEG, 0 .. 100

}  // namespace

Studio::Studio(int side, vtkPoints& extent, const Viewpoint& viewpoint) : side_(side) {
  window_->SetOffScreenRendering(1);
  window_->SetMultiSamples(kMultiSamples);
  window_->SetSize(side, side);
  renderer_->SetBackground(1.0, 1.0, 1.0);
  vtkNew<vtkCamera> camera;
  fitCamera({&extent}, viewpoint, 1.0, 1.0, *camera);
  renderer_->SetActiveCamera(camera);
  vtkNew<vtkLightKit> lights;
  lights->SetKeyLightIntensity(1.0);
  lights->SetKeyLightWarmth(0.52);
  lights->AddLightsToRenderer(renderer_);
  window_->AddRenderer(renderer_);
  vtkMapper::SetResolveCoincidentTopologyToPolygonOffset();
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
