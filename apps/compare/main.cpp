// SPDX-License-Identifier: BSD-3-Clause
#include "common/app_error.h"
#include "compare/compare_options.h"
#include "compare/comparison.h"
#include "compare/task.h"
#include "mlsmesh/version.h"

#include <iostream>
#include <string>

int main(int argc, char** argv) {
  using namespace mlsmesh;
  if (argc == 3 && std::string(argv[1]) == apps::kWorkerOption) return apps::runWorker(argv[2]);
  return apps::runProgram(apps::kCompareProgram, [&] {
    const apps::CompareOptions options = apps::readCompareOptions(argc, argv);
    if (options.help)
      std::cout << apps::compareHelp();
    else if (options.version)
      std::cout << apps::kCompareProgram << " " MLSMESH_VERSION "\n";
    else
      apps::compare(options);
    return apps::kExitOk;
  });
}
