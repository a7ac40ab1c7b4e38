// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/multiresolution.h"
#include "reconstruct/options.h"

#include <cstdint>
#include <string>
#include <vector>

namespace mlsmesh::apps {

/// What a run did.
struct RunReport {
  std::size_t input_points = 0;
  core::Reconstruction result;
  std::vector<core::StageTime> stages;   ///< read, those of the core, write
  std::vector<std::string> level_files;  ///< file of each level, empty if it was not written
  std::vector<std::string> warnings;
};

/// Most memory that the process had in use so far.
std::uint64_t peakMemoryBytes();

/// The JSON document, indented, with a line end.
std::string jsonText(const Options& options, const RunReport& report);

/// Input, stages with seconds, levels with counts.
std::string summaryText(const Options& options, const RunReport& report);

}  // namespace mlsmesh::apps
