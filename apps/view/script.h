// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace mlsmesh::apps {

/// Keys to be pressed by themselves, one after the other.
struct ScriptStep {
  std::string key;       ///< of keyTable(), or kWaitStep
  std::string argument;  ///< of the key for pictures, the file; empty if none
};

/// Waits until nothing runs any more.
inline constexpr const char* kWaitStep = "wait";

/// Reads "KEY,KEY,p=FILE,wait,KEY". Throws AppError (kExitUsage) that names --script and the step.
std::vector<ScriptStep> parseScript(const std::string& text);

}  // namespace mlsmesh::apps
