// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "registration.h"
#include "step_data.h"

namespace mlsmesh::bench {

/// A step of the pipeline, or all of it, through the core's public headers.
struct Step {
  std::string name;
  std::string things;  ///< that the work counts
  /// Makes what the step needs and returns the work, which refers to `data` and may be repeated. Where a step
  /// changes its input in place, the work copies that first.
  Work (*prepare)(StepData& data, int threads);
};

/// In the order of the pipeline. docs/benchmarks.md says what each is.
const std::vector<Step>& steps();

}  // namespace mlsmesh::bench
