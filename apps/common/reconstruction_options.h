// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/config_file.h"
#include "mlsmesh/parameters.h"

#include <boost/program_options.hpp>

#include <set>
#include <string>
#include <vector>

namespace mlsmesh::apps {

/// How to reconstruct: the preset, then the config file, then the command line, each over what came before.
struct ReconstructionOptions {
  std::string preset = "default";
  MultiresolutionParameters parameters;
  int threads = 0;          ///< 0 = all
  bool all_levels = false;  ///< write every level, for programs that write meshes
};

/// Adds the options that every program has that reconstructs: levels, hole-size, watertight, no-reduction,
/// preset, config, threads.
void addReconstructionOptions(boost::program_options::options_description& options);

/// Adds one option for each parameter, by its full name, except for those that are there: not for the help,
/// which shows parameterHelp().
void addParameterOptions(boost::program_options::options_description& options);

/// What `values`, parsed with options of both functions (and all-levels, if the program has it), and the
/// config file that they name say; other options are passed over. Throws AppError (kExitUsage) that names the
/// option, or file and line, and what is allowed.
ReconstructionOptions reconstructionOptions(const boost::program_options::variables_map& values);
/// The same for programs whose config file says other things, too: `entries` are those of the file without
/// these, `others` their names, for suggestions.
ReconstructionOptions reconstructionOptions(const boost::program_options::variables_map& values,
                                            const std::vector<ConfigEntry>& entries,
                                            const std::set<std::string>& others);

}  // namespace mlsmesh::apps
