// SPDX-License-Identifier: BSD-3-Clause
#include "view/window.h"

#include "common/app_error.h"
#include "common/atomic_output.h"
#include "view/scene.h"

#include <vtkCallbackCommand.h>
#include <vtkInteractorStyleTrackballCamera.h>
#include <vtkPNGWriter.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkWindowToImageFilter.h>

namespace mlsmesh::apps {
namespace {

constexpr int kMultiSamples = 8;

void setUp(vtkRenderWindow& window, const ViewOptions& options) {
  window.SetMultiSamples(kMultiSamples);
  window.SetSize(options.size[0], options.size[1]);
  window.SetWindowName("mlsmesh_view");
}

void onKey(vtkObject* caller, unsigned long /*event*/, void* client_data, void* /*call_data*/) {
  auto& interactor = *static_cast<vtkRenderWindowInteractor*>(caller);
  Scene& scene = *static_cast<Scene*>(client_data);
  const std::string key = interactor.GetKeySym() != nullptr ? interactor.GetKeySym() : "";
  if (key == "Right")
    scene.showOnly(scene.shown() + 1);
  else if (key == "Left")
    scene.showOnly(scene.shown() < 0 ? -1 : scene.shown() - 1);
  else if (key == "a")
    scene.showAll();
  else if (key == "b")
    scene.toggleBorders();
  else if (key == "g")
    scene.toggleEdges();
  else
    return;
  interactor.Render();
}

}  // namespace

void writeScreenshot(const std::vector<Drawing>& drawings, const ViewOptions& options) {
  AtomicOutput file(options.screenshot);
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  setUp(*window, options);
  const Scene scene(drawings, options, *window);
  window->Render();
  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(window);
  image->ReadFrontBufferOff();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(image->GetOutputPort());
  writer->SetFileName(file.temporary().c_str());
  writer->Write();
  if (writer->GetErrorCode() != 0)
    throw fileError(options.screenshot.string(), "could not be written; is the disk full?");
  file.commit();
}

void showWindow(const std::vector<Drawing>& drawings, const ViewOptions& options) {
  vtkNew<vtkRenderWindow> window;
  setUp(*window, options);
  Scene scene(drawings, options, *window);
  vtkNew<vtkRenderWindowInteractor> interactor;
  interactor->SetRenderWindow(window);
  vtkNew<vtkInteractorStyleTrackballCamera> style;
  interactor->SetInteractorStyle(style);
  vtkNew<vtkCallbackCommand> keys;
  keys->SetCallback(onKey);
  keys->SetClientData(&scene);
  interactor->AddObserver(vtkCommand::KeyPressEvent, keys);
  interactor->Initialize();
  window->Render();
  interactor->Start();
}

}  // namespace mlsmesh::apps
