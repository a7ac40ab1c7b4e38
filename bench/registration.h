// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace mlsmesh::bench {

/// What is timed; returns how many things it made.
using Work = std::function<std::size_t()>;

/// Adds a benchmark in milliseconds that measures wall time and the CPU time of all threads, and tells the
/// number of `things` in a counter of that name. `prepare` makes the work from what is to be ready before the
/// clock starts; it is called once a repetition. What either throws becomes the benchmark's error.
void registerBenchmark(const std::string& name, const std::string& things,
                       const std::function<Work()>& prepare);

/// Runs what is registered and fits the filter; the JSON's context tells compiler, version and whether
/// assertions are on.
void runRegistered();

}  // namespace mlsmesh::bench
