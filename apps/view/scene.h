// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "view/drawing.h"
#include "view/view_options.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <vector>

namespace mlsmesh::apps {

/// The drawings in one window, a viewport each, seen by one camera.
class Scene {
 public:
  /// Needs a usable display; `window` outlives the scene.
  Scene(const std::vector<Drawing>& drawings, const ViewOptions& options, vtkRenderWindow& window);

  /// Gives the whole window to one drawing; wraps around. showAll() shares it out again.
  void showOnly(int drawing);
  void showAll();
  /// The drawing that has the window to itself, or -1.
  int shown() const { return shown_; }
  void toggleBorders();
  void toggleEdges();

 private:
  struct Pane {
    vtkSmartPointer<vtkRenderer> renderer;
    vtkSmartPointer<vtkActor> surface;
    vtkSmartPointer<vtkActor> borders;  ///< null for a cloud
  };
  Pane makePane(const Drawing& drawing);
  void placeCamera(const std::vector<Drawing>& drawings);
  /// Pixels that a viewport is wide and high when all are shown.
  double paneExtent() const;

  ViewOptions options_;
  vtkRenderWindow& window_;
  std::vector<Pane> panes_;
  vtkSmartPointer<vtkCamera> camera_;
  int columns_ = 1;
  int rows_ = 1;
  int shown_ = -1;
};

}  // namespace mlsmesh::apps
