// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "drawing/layers.h"
#include "view/layer.h"
#include "view/subject.h"

#include <vtkCamera.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace mlsmesh::apps {

/// What all panes show alike.
struct PaneLook {
  SurfaceLook surface;
  bool borders = false;  ///< also where meshes are shown
  bool labels = true;
  double dots = 1.0;  ///< times the usual size
};

/// One subject in a part of the window.
class Pane {
 public:
  /// `extent` is that of the pane in pixels, when all are shown; `colors` is the scale of distances. Subject,
  /// window and colours outlive the pane.
  Pane(Subject& subject, vtkLookupTable& colors, double extent, vtkCamera& camera, vtkRenderWindow& window);

  Subject& subject() const { return *subject_; }
  /// Shows the subject; a level that it does not have becomes the nearest one. Reports what cannot be shown
  /// as a notice in the pane.
  void show(Mode mode, int level, const PaneLook& look);
  /// Left, bottom, right, top as shares of the window; not drawn if empty.
  void setPlace(const std::array<double, 4>& place);
  /// Forgets what was drawn of the subject, because there is more of it now.
  void forget();
  /// A text that is shown in place of the layer's own notice until forget(), but not over the cloud where
  /// that is what was asked for.
  void setNotice(const std::string& notice) { notice_ = notice; }
  vtkRenderer& renderer() const { return *renderer_; }

 private:
  const Layer& layer(Mode mode, int level);
  void addNotes(const Layer& layer, const std::string& notice_text, const PaneLook& look);
  void applyLook(const Layer& layer, const PaneLook& look);

  Subject* subject_;
  vtkLookupTable* colors_;
  double extent_;
  vtkSmartPointer<vtkRenderer> renderer_;
  std::map<std::pair<Mode, int>, Layer> layers_;
  std::string notice_;
};

}  // namespace mlsmesh::apps
