// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/picture.h"

#include "common/app_error.h"
#include "common/atomic_output.h"
#include "common/command_line.h"
#include "common/file_bytes.h"

#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkWindowToImageFilter.h>

namespace mlsmesh::apps {

void checkPictureFormat(const char* culprit, const std::filesystem::path& file) {
  if (extensionOf(file) == "png") return;
  throw usageError(culprit, "'" + file.string() + "' is not a PNG file; give a name that ends in .png");
}

void writePicture(vtkRenderWindow& window, const std::filesystem::path& file) {
  AtomicOutput output(file);
  window.Render();
  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(&window);
  image->ReadFrontBufferOff();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(image->GetOutputPort());
  writer->SetFileName(output.temporary().c_str());
  writer->Write();
  if (writer->GetErrorCode() != 0) throw notWritten(output.temporary(), file);
  output.commit();
}

}  // namespace mlsmesh::apps
