// SPDX-License-Identifier: BSD-3-Clause
#include "view/window.h"

#include "common/app_error.h"
#include "common/interrupt.h"
#include "common/progress_bar.h"
#include "drawing/picture.h"
#include "view/viewer.h"

#include <vtkCallbackCommand.h>
#include <vtkInteractorStyleTrackballCamera.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkRenderWindowInteractor.h>

#include <chrono>
#include <exception>
#include <thread>

namespace mlsmesh::apps {
namespace {

constexpr int kPictureSamples = 8;
constexpr int kWindowSamples = 4;  // software draws slowly
constexpr int kTickMs = 40;

/// VTK's own keys do nothing: all are ours.
class MouseStyle : public vtkInteractorStyleTrackballCamera {
 public:
  static MouseStyle* New();
  void OnChar() override {}
  void OnKeyPress() override {}
};
vtkStandardNewMacro(MouseStyle);

void setUp(vtkRenderWindow& window, int samples, const ViewOptions& options) {
  window.SetMultiSamples(samples);
  window.SetSize(options.size[0], options.size[1]);
  window.SetWindowName(kViewProgram);
}

/// A viewer whose keys and time are those of an interactor.
class Session {
 public:
  Session(Viewer& viewer, vtkRenderWindowInteractor& interactor, bool ends_with_script)
      : viewer_(viewer), interactor_(interactor), ends_with_script_(ends_with_script) {
    on_event_->SetClientData(this);
    on_event_->SetCallback(onEvent);
    interactor_.AddObserver(vtkCommand::KeyPressEvent, on_event_);
    interactor_.AddObserver(vtkCommand::TimerEvent, on_event_);
  }

  /// Until the window is closed. Throws what a key or the script threw.
  void run() {
    interactor_.Initialize();
    interactor_.CreateRepeatingTimer(kTickMs);
    interactor_.Render();
    interactor_.Start();
    if (error_) std::rethrow_exception(error_);
  }

 private:
  /// Nothing may be thrown through VTK's loop.
  static void onEvent(vtkObject*, unsigned long event, void* data, void*) {
    Session& session = *static_cast<Session*>(data);
    if (session.error_) return;
    try {
      session.handle(event);
    } catch (...) {
      session.error_ = std::current_exception();
      session.interactor_.TerminateApp();
    }
  }

  void handle(unsigned long event) {
    if (event == vtkCommand::KeyPressEvent)
      viewer_.press(interactor_.GetKeySym() != nullptr ? interactor_.GetKeySym() : "");
    else
      viewer_.tick();
    if (viewer_.takeChange()) interactor_.Render();
    if (viewer_.isEnded() || (ends_with_script_ && viewer_.isScriptDone())) interactor_.TerminateApp();
  }

  Viewer& viewer_;
  vtkRenderWindowInteractor& interactor_;
  bool ends_with_script_;
  vtkNew<vtkCallbackCommand> on_event_;
  std::exception_ptr error_;
};

/// Until nothing runs any more, and the script is done or has ended the program.
void waitFor(Viewer& viewer) {
  ProgressBar bar(true);
  while (!viewer.isEnded() && (viewer.isBusy() || !viewer.isScriptDone())) {
    InterruptGuard::check();
    viewer.tick();
    if (viewer.isBusy()) {
      bar.draw(viewer.stage(), viewer.fraction());
      std::this_thread::sleep_for(std::chrono::milliseconds(kTickMs / 4));
    }
  }
}

}  // namespace

void writeScreenshot(std::vector<Subject>& subjects, const ViewOptions& options) {
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  setUp(*window, kPictureSamples, options);
  const InterruptGuard guard{Progress()};
  Viewer viewer(subjects, options, *window);
  waitFor(viewer);
  if (!viewer.failure().empty()) throw AppError(kExitFailure, viewer.failure());
  writePicture(*window, options.screenshot);
}

void showWindow(std::vector<Subject>& subjects, const ViewOptions& options, bool ends_with_script) {
  vtkNew<vtkRenderWindow> window;
  setUp(*window, kWindowSamples, options);
  Viewer viewer(subjects, options, *window);
  vtkNew<vtkRenderWindowInteractor> interactor;
  interactor->SetRenderWindow(window);
  vtkNew<MouseStyle> style;
  interactor->SetInteractorStyle(style);
  Session(viewer, *interactor, ends_with_script).run();
}

}  // namespace mlsmesh::apps
