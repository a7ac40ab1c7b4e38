// SPDX-License-Identifier: BSD-3-Clause
// bench_steps [--cloud FILE.pcd|--points N,N] [--threads N,N] [Google Benchmark's options]: each step of the
// pipeline, and all of it, through the core, on a cloud from a file or on synthetic ones (10,000, 100,000 and
// 1,000,000 points by default). docs/benchmarks.md says what each name is.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "clouds.h"
#include "options.h"
#include "steps.h"

namespace {

using namespace mlsmesh::bench;

// One cloud, read or made when a benchmark that passed the filter first asks for it.
class LazyData {
 public:
  LazyData(std::string file, std::size_t points) : file_(std::move(file)), points_(points) {}

  StepData& get() {
    if (!data_) {
      data_ =
          std::make_unique<StepData>(positionsOf(file_.empty() ? *bumpySphere(points_) : *readCloud(file_)));
    }
    return *data_;
  }

 private:
  std::string file_;
  std::size_t points_;
  std::unique_ptr<StepData> data_;
};

void addSteps(const std::shared_ptr<LazyData>& data, const std::string& cloud, int threads) {
  for (const Step& step : steps()) {
    registerBenchmark(step.name + "/" + cloud + "/threads:" + std::to_string(threads), step.things,
                      [data, prepare = step.prepare, threads] { return prepare(data->get(), threads); });
  }
}

void addAll(const Options& options) {
  const auto add = [&options](const std::shared_ptr<LazyData>& data, const std::string& cloud) {
    for (const int threads : options.threads) addSteps(data, cloud, threads);
  };
  if (!options.cloud.empty()) {
    add(std::make_shared<LazyData>(options.cloud, 0), "file");
    return;
  }
  for (const std::size_t points : options.points) {
    add(std::make_shared<LazyData>("", points), "points:" + std::to_string(points));
  }
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  try {
    const Options options = parseOptions(argc, argv, {10'000, 100'000, 1'000'000});
    if (!options.flags.empty()) {
      throw std::invalid_argument(
          "usage: bench_steps [--cloud FILE.pcd|--points N,N] [--threads N,N] [--benchmark_...]");
    }
    addAll(options);
    runRegistered();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_steps: %s\n", error.what());
    return 2;
  }
  return 0;
}
