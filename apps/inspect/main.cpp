// SPDX-License-Identifier: BSD-3-Clause
#include "common/app_error.h"
#include "common/atomic_output.h"
#include "common/command_line.h"
#include "inspect/inspect_options.h"
#include "inspect/report.h"
#include "mlsmesh/version.h"

#include <iostream>

namespace {

using namespace mlsmesh;

constexpr int kExitUnmet = 1;    // a requirement does not hold
constexpr int kExitTrouble = 2;  // whatever kept the program from telling

/// Before any work: the JSON file can be written and is none of the inputs.
void checkOutput(const apps::InspectOptions& options) {
  if (options.json.empty()) return;
  apps::checkWritable(options.json);
  for (const std::filesystem::path& input : {options.mesh, options.cloud, options.truth}) {
    if (input.empty() || !apps::isSameFile(options.json, input)) continue;
    throw apps::usageError(options.json.string(), "would overwrite the input '" + input.string() +
                                                      "'; give another name for the report");
  }
}

/// Measures and reports; the requirements that do not hold.
std::vector<std::string> report(const apps::InspectOptions& options) {
  checkOutput(options);
  const apps::Inspection inspection = apps::inspect(options);
  const apps::FigureTable table = apps::figuresOf(inspection);
  if (!options.json.empty()) {
    apps::AtomicOutput file(options.json);
    apps::writeFile(file.temporary(), apps::reportJson(options, inspection, table), options.json);
    file.commit();
  }
  if (!options.quiet && !(std::cout << apps::reportText(options, table) << std::flush))
    throw apps::AppError(kExitTrouble, "standard output: cannot be written; is the disk full?");
  return apps::failures(options.requirements, table);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> unmet;
  const int exit_code = apps::runProgram(apps::kInspectProgram, [&] {
    const apps::InspectOptions options = apps::readInspectOptions(argc, argv);
    if (options.help)
      std::cout << apps::inspectHelp();
    else if (options.version)
      std::cout << apps::kInspectProgram << " " MLSMESH_VERSION "\n";
    else
      unmet = report(options);
    return apps::kExitOk;
  });
  if (exit_code != apps::kExitOk) return kExitTrouble;
  for (const std::string& sentence : unmet)
    std::cerr << apps::kInspectProgram << ": requirement " << sentence << "\n";
  return unmet.empty() ? apps::kExitOk : kExitUnmet;
}
