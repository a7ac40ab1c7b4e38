// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "view/job.h"
#include "view/overlay.h"
#include "view/pane.h"
#include "view/subject.h"
#include "view/view_options.h"

#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkSmartPointer.h>

#include <optional>
#include <vector>

namespace mlsmesh::apps {

/// The subjects in one window, a pane each, seen by one camera.
class Scene {
 public:
  /// Needs a usable display; subjects and window outlive the scene.
  Scene(std::vector<Subject>& subjects, const ViewOptions& options, vtkRenderWindow& window);
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  Mode mode() const { return mode_; }
  void setMode(Mode mode);
  /// By so many levels finer, within those that there are.
  void stepLevel(int steps);
  /// Gives the whole window to one pane; wraps around. showAll() shares it out again.
  void showOnly(int pane);
  void showAll();
  /// The pane that has the window to itself, or -1.
  int shown() const { return shown_; }
  int paneCount() const { return static_cast<int>(panes_.size()); }

  /// What is to be drawn of surfaces, dots and labels; refresh() draws it.
  PaneLook& look() { return look_; }
  /// All panes anew, after the subjects or the look changed.
  void refresh();
  /// What has to be found out for what is shown.
  std::vector<Job::Task> openFindings() const;
  /// Forgets what was drawn of that subject, and shows `notice` in its pane unless it is empty.
  void renew(const Subject& subject, const std::string& notice);

  /// All in sight, from where the options say, or the last view that was chosen.
  void fit();
  void nextView();
  void toggleParallel();
  /// Brings the camera near to the next defect or border of the panes, where such are shown; false if there
  /// is none.
  bool visitNextPlace();

  Overlay& overlay() { return overlay_; }
  vtkRenderWindow& window() { return window_; }

 private:
  int levelCount() const;
  /// The one of the subject's levels that is shown, if it has any.
  int levelOf(const Subject& subject) const;
  void setScale();
  /// Moves the scene aside where a scale is shown; returns the share of a pane that is left for it.
  double makeRoomForScale();
  void placePanes();
  void resetClipping();
  std::vector<core::Vec3> placesToVisit() const;
  static void onRender(vtkObject* caller, unsigned long event, void* scene, void* data);

  ViewOptions options_;
  vtkRenderWindow& window_;
  std::vector<Subject>& subjects_;
  vtkSmartPointer<vtkCamera> camera_;
  vtkSmartPointer<vtkLookupTable> colors_;
  std::vector<Pane> panes_;
  Overlay overlay_;
  vtkNew<vtkCallbackCommand> on_render_;
  PaneLook look_;
  core::Vec3 fitted_position_{0, 0, 0};  ///< of the camera, since fit()
  Mode mode_;
  int level_;  ///< may be finer than any that there is
  int columns_ = 1;
  int rows_ = 1;
  int shown_ = -1;
  std::size_t visited_ = 0;
};

}  // namespace mlsmesh::apps
