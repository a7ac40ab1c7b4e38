// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkActor2D.h>
#include <vtkPoints.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTextActor.h>

#include <string>

namespace mlsmesh::apps {

/// What lies over all panes of a window: the list of keys, and the progress of what runs.
class Overlay {
 public:
  /// `font_size` in pixels; `window` outlives the overlay.
  Overlay(vtkRenderWindow& window, int font_size);

  void toggleHelp();
  /// `fraction` of the work, 0 .. 1.
  void showProgress(const std::string& text, double fraction);
  void hideProgress();

 private:
  vtkSmartPointer<vtkRenderer> renderer_;
  vtkSmartPointer<vtkTextActor> help_;
  vtkSmartPointer<vtkTextActor> text_;
  vtkSmartPointer<vtkPoints> bar_;  ///< corners of the filled part
  vtkSmartPointer<vtkActor2D> frame_actor_;
  vtkSmartPointer<vtkActor2D> bar_actor_;
};

}  // namespace mlsmesh::apps
