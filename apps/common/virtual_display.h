// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

namespace mlsmesh::apps {

/// Whether the X display that DISPLAY names can be opened and draws OpenGL. VTK aborts the process where this
/// is false.
bool isDisplayUsable();

/// A display of our own where there is none: an Xvfb process that ends with this object, or with this
/// process.
class VirtualDisplay {
 public:
  /// Starts Xvfb on a free display and names it in DISPLAY. Throws AppError that says what to install.
  VirtualDisplay();
  ~VirtualDisplay();
  VirtualDisplay(const VirtualDisplay&) = delete;
  VirtualDisplay& operator=(const VirtualDisplay&) = delete;

 private:
  void stop();

  pid_t server_ = -1;
};

}  // namespace mlsmesh::apps
