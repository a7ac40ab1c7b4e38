// SPDX-License-Identifier: BSD-3-Clause
#include "common/app_error.h"
#include "reconstruct/options.h"
#include "reconstruct/run.h"

#include <iostream>

int main(int argc, char** argv) {
  using namespace mlsmesh::apps;
  return runProgram(kProgram, [&] {
    const Options options = parseOptions(argc, argv);
    if (options.action == Action::Print)
      std::cout << options.text << std::flush;
    else
      reconstructFile(options);
    return kExitOk;
  });
}
