// SPDX-License-Identifier: BSD-3-Clause
// Whatever a config file holds, it gives parameters in their ranges, or an error of usage.
#include "common/app_error.h"
#include "common/reconstruction_options.h"
#include "input_file.h"
#include "mlsmesh/core/parameter_check.h"

#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  boost::program_options::variables_map values;
  const std::string file = mlsmesh::fuzz::inputFile(data, size, "cfg").string();
  values.emplace("config", boost::program_options::variable_value(file, false));
  try {
    mlsmesh::core::check(mlsmesh::apps::reconstructionOptions(values).parameters);
  } catch (const mlsmesh::apps::AppError& error) {
    if (error.exitCode() != mlsmesh::apps::kExitUsage) std::abort();
  }
  return 0;
}
