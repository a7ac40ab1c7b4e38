// SPDX-License-Identifier: BSD-3-Clause
#include "common/app_error.h"
#include "common/atomic_output.h"
#include "mlsmesh/version.h"
#include "view/view_options.h"
#include "common/virtual_display.h"
#include "view/window.h"

#include <vtkObject.h>

#include <iostream>
#include <optional>

namespace {

using namespace mlsmesh;

void view(const apps::ViewOptions& options) {
  vtkObject::GlobalWarningDisplayOff();
  const bool is_picture = !options.screenshot.empty();
  if (is_picture) apps::checkWritable(options.screenshot);
  std::vector<apps::Drawing> drawings;
  for (const std::filesystem::path& file : options.files) drawings.push_back(apps::readDrawing(file));
  std::optional<apps::VirtualDisplay> display;
  if (!apps::isDisplayUsable()) {
    if (!is_picture) {
      throw apps::AppError(
          apps::kExitFailure,
          "DISPLAY: no X display to open a window on; set it, or make a picture with --screenshot FILE.png");
    }
    display.emplace();
  }
  if (is_picture)
    apps::writeScreenshot(drawings, options);
  else
    apps::showWindow(drawings, options);
}

}  // namespace

int main(int argc, char** argv) {
  return apps::runProgram("mlsmesh_view", [&] {
    const apps::ViewOptions options = apps::readViewOptions(argc, argv);
    if (options.help)
      std::cout << apps::viewHelp();
    else if (options.version)
      std::cout << "mlsmesh_view " MLSMESH_VERSION "\n";
    else
      view(options);
    return apps::kExitOk;
  });
}
