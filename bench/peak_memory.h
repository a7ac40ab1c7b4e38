// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace mlsmesh::bench {

/// What this process takes of the machine's memory (Linux). Throws std::runtime_error if the kernel does not
/// tell.

/// Bytes resident now, once freed memory is given back to the system.
std::size_t residentNow();

/// Makes residentPeak() start from what is resident now. False if the
/// kernel refuses: the peak is then that since the process began.
bool restartResidentPeak();

/// Most bytes that were resident at once.
std::size_t residentPeak();

/// Seconds of CPU time of all threads so far.
double cpuSeconds();

}  // namespace mlsmesh::bench
