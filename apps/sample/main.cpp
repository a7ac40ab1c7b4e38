// SPDX-License-Identifier: BSD-3-Clause
#include "common/app_error.h"
#include "mlsmesh/version.h"
#include "sample/sample_options.h"
#include "sample/scan_file.h"

#include <iostream>

namespace {

using namespace mlsmesh;

void makeScan(const apps::SampleOptions& options) {
  const shapes::Scan scan = shapes::scan(*options.shape, options.scan);
  std::vector<core::Vec3> colors;
  if (options.colors) {
    for (const core::Vec3& place : scan.surface_points) colors.push_back(options.shape->color(place));
  }
  apps::writeScan(scan.points, colors, options.output);
  if (!options.quiet) std::cout << options.output.string() << ": " << scan.points.size() << " points\n";
}

}  // namespace

int main(int argc, char** argv) {
  return apps::runProgram("mlsmesh_sample", [&] {
    const apps::SampleOptions options = apps::readSampleOptions(argc, argv);
    if (options.help)
      std::cout << apps::sampleHelp();
    else if (options.version)
      std::cout << "mlsmesh_sample " MLSMESH_VERSION "\n";
    else
      makeScan(options);
    return apps::kExitOk;
  });
}
