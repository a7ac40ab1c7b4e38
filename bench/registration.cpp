// SPDX-License-Identifier: BSD-3-Clause
#include "registration.h"

#include <benchmark/benchmark.h>

#include <exception>

#include "mlsmesh/version.h"

namespace mlsmesh::bench {
namespace {

std::string compiler() {
#ifdef __clang__
  return __VERSION__;
#else
  return std::string("GCC ") + __VERSION__;
#endif
}

void measure(benchmark::State& state, const std::string& things, const std::function<Work()>& prepare) {
  try {
    const Work work = prepare();
    std::size_t count = 0;
    for (auto _ : state) count = work();
    state.counters[things] = static_cast<double>(count);
  } catch (const std::exception& error) {
    state.SkipWithError(error.what());
  }
}

}  // namespace

void registerBenchmark(const std::string& name, const std::string& things,
                       const std::function<Work()>& prepare) {
  const auto body = [things, prepare](benchmark::State& state) { measure(state, things, prepare); };
  benchmark::RegisterBenchmark(name.c_str(), body)->MeasureProcessCPUTime()->Unit(benchmark::kMillisecond);
}

void runRegistered() {
  benchmark::AddCustomContext("mlsmesh", MLSMESH_VERSION);
  benchmark::AddCustomContext("compiler", compiler());
#ifdef NDEBUG
  benchmark::AddCustomContext("assertions", "off");
#else
  benchmark::AddCustomContext("assertions", "on");
#endif
  benchmark::RunSpecifiedBenchmarks();
}

}  // namespace mlsmesh::bench
