// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "drawing/notes.h"
#include "view/modes.h"
#include "view/subject.h"

#include <vtkActor.h>
#include <vtkLookupTable.h>
#include <vtkSmartPointer.h>

#include <string>
#include <vector>

namespace mlsmesh::apps {

/// What is to be seen of a subject in one mode.
struct Layer {
  std::vector<vtkSmartPointer<vtkActor>> actors;
  vtkSmartPointer<vtkActor> surface;  ///< the one of `actors` whose look can be changed, or null
  vtkSmartPointer<vtkActor> dots;     ///< the one whose points can be made larger, or null
  std::vector<LegendEntry> legend;
  std::string label;   ///< name and counts
  std::string notice;  ///< why there is less to be seen than was asked for, or empty
  bool has_scale = false;
};

/// `level` is one that the subject has, if it has any; defects and distances that were not found yet are left
/// out, and those that were given up say why; `colors` is the scale of distances, in spacings, that
/// all panes share. Throws core::Failure.
Layer makeLayer(Subject& subject, Mode mode, int level, vtkLookupTable* colors);

/// Which mode it is for this subject: Auto is resolved; what cannot be shown falls back on what can.
Mode shownMode(const Subject& subject, Mode mode);

}  // namespace mlsmesh::apps
