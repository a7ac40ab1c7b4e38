// SPDX-License-Identifier: BSD-3-Clause
#include "common/app_error.h"
#include "common/atomic_output.h"
#include "common/virtual_display.h"
#include "drawing/shape_file.h"
#include "mlsmesh/version.h"
#include "view/view_options.h"
#include "view/window.h"

#include <vtkObject.h>

#include <iostream>
#include <memory>
#include <optional>

namespace {

using namespace mlsmesh;

void checkPicture(const std::filesystem::path& picture, const apps::ViewOptions& options) {
  if (picture.empty()) return;
  apps::checkWritable(picture);
  for (const std::filesystem::path& input : options.files) {
    if (!apps::isSameFile(picture, input)) continue;
    throw apps::AppError(apps::kExitUsage, picture.string() + ": would overwrite the input '" +
                                               input.string() + "'; give another name for the picture");
  }
}

/// Before any work: every picture that is asked for can be written, and is no input.
void checkPictures(const apps::ViewOptions& options) {
  checkPicture(options.screenshot, options);
  for (const apps::ScriptStep& step : options.script) checkPicture(step.argument, options);
}

/// The cloud that --cloud names, or else the only one among the files.
std::shared_ptr<const apps::Shape> cloudToCompareWith(const std::vector<apps::Subject>& subjects,
                                                      const apps::ViewOptions& options) {
  if (!options.cloud.empty()) return std::make_shared<apps::Shape>(apps::readShape(options.cloud).shape);
  std::shared_ptr<const apps::Shape> cloud;
  int clouds = 0;
  for (const apps::Subject& subject : subjects) {
    if (!subject.isCloud()) continue;
    ++clouds;
    cloud = subject.sharedCloud();
  }
  return clouds == 1 ? cloud : nullptr;
}

std::vector<apps::Subject> readSubjects(const apps::ViewOptions& options) {
  std::vector<apps::Subject> subjects;
  for (const std::filesystem::path& file : options.files) subjects.emplace_back(file);
  const std::shared_ptr<const apps::Shape> cloud = cloudToCompareWith(subjects, options);
  for (apps::Subject& subject : subjects)
    if (!subject.isCloud() && cloud) subject.useCloud(cloud);
  return subjects;
}

void view(const apps::ViewOptions& options) {
  vtkObject::GlobalWarningDisplayOff();
  checkPictures(options);
  std::vector<apps::Subject> subjects = readSubjects(options);
  std::optional<apps::VirtualDisplay> display;
  const bool has_display = apps::isDisplayUsable();
  if (!has_display) {
    if (options.screenshot.empty() && options.script.empty()) {
      throw apps::AppError(
          apps::kExitFailure,
          "DISPLAY: no X display to open a window on; set it, or make a picture with --screenshot FILE.png");
    }
    display.emplace();
  }
  if (options.screenshot.empty())
    apps::showWindow(subjects, options, !has_display);
  else
    apps::writeScreenshot(subjects, options);
}

}  // namespace

int main(int argc, char** argv) {
  return apps::runProgram(apps::kViewProgram, [&] {
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
