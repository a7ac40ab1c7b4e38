// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/viewpoint.h"
#include "mlsmesh/core/types.h"

#include <vtkNew.h>
#include <vtkProp.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <filesystem>
#include <vector>

namespace mlsmesh::apps {

/// Takes square pictures of one scene after the other from the same place, without a window. Needs a usable
/// display.
class Studio {
 public:
  /// Pictures have `side` pixels a side.
  explicit Studio(int side);

  /// From now on the camera sees all of `extent`.
  void aim(const std::vector<core::Vec3>& extent, const Viewpoint& viewpoint);

  /// A JPEG file of those props. Throws AppError.
  void take(const std::vector<vtkSmartPointer<vtkProp>>& props, const std::filesystem::path& file);
  int side() const { return side_; }

 private:
  int side_;
  vtkNew<vtkRenderWindow> window_;
  vtkNew<vtkRenderer> renderer_;
};

}  // namespace mlsmesh::apps
