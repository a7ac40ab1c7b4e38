// SPDX-License-Identifier: BSD-3-Clause
#include "common/app_error.h"
#include "reconstruct/options.h"
#include "reconstruct/run.h"

#include <iostream>

int main(int argc, char** argv) {
  using namespace mlsmesh::apps;
  return runProgram(kProgram, [&] {
    const Options options = parseOptions(argc, argv);
    if (options.action == Action::Reconstruct) {
      reconstructFile(options);
    } else if (!(std::cout << options.text << std::flush)) {
      throw AppError(kExitFailure, "standard output: cannot be written; is the disk full?");
    }
    return kExitOk;
  });
}
