// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace mlsmesh::apps {

/// What a process may use.
struct ChildLimits {
  double seconds = 0;              ///< wall clock; 0: no limit
  std::uint64_t memory_bytes = 0;  ///< writable memory of its own that it may ask for; 0: no limit
};

/// How a process ended, and what it used.
struct ChildOutcome {
  bool timed_out = false;  ///< killed at the limit
  int exit_code = -1;      ///< -1 if a signal ended it
  int signal = 0;
  double wall_seconds = 0;
  double user_seconds = 0;
  double system_seconds = 0;
  std::uint64_t peak_bytes = 0;  ///< resident at once, shared libraries included
  std::string last_words;        ///< last line that it printed, on one line
};

/// Runs this program anew with those arguments and waits for its end. What it prints goes to the file `log`.
/// It does not outlive this process, leaves no core, and is out of reach of the terminal's Ctrl-C, which it
/// is killed for here: `keep_on` is asked about ten times a second, is given the seconds so far, and throws
/// where there is no sense in waiting. Throws AppError if no process can be started.
///
/// The peak counts what this process holds when it starts the other (Linux inherits it): keep it small.
ChildOutcome runSelf(const std::vector<std::string>& arguments, const ChildLimits& limits,
                     const std::filesystem::path& log, const std::function<void(double)>& keep_on);

}  // namespace mlsmesh::apps
