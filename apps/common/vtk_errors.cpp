// SPDX-License-Identifier: BSD-3-Clause
#include "common/vtk_errors.h"

#include <vtkLogger.h>
#include <vtkObjectFactory.h>

namespace mlsmesh::apps {

vtkStandardNewMacro(VtkErrorCounter);

vtkSmartPointer<VtkErrorCounter> countVtkErrors() {
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  auto counter = vtkSmartPointer<VtkErrorCounter>::New();
  vtkOutputWindow::SetInstance(counter);
  return counter;
}

}  // namespace mlsmesh::apps
