// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>

namespace mlsmesh::apps {

/// Counts VTK's errors and warnings (data that are cut off are one) instead of printing them.
class VtkErrorCounter : public vtkOutputWindow {
 public:
  static VtkErrorCounter* New();
  void DisplayText(const char*) override {}
  void DisplayErrorText(const char*) override { ++errors_; }
  void DisplayWarningText(const char*) override { ++errors_; }
  void DisplayGenericWarningText(const char*) override { ++errors_; }
  void DisplayDebugText(const char*) override {}
  int errors() const { return errors_; }

 private:
  int errors_ = 0;
};

/// Puts a counter in place of VTK's window, and silences VTK's log.
vtkSmartPointer<VtkErrorCounter> countVtkErrors();

}  // namespace mlsmesh::apps
