// SPDX-License-Identifier: BSD-3-Clause
#include "mlsmesh/statistics.h"

#include <algorithm>
#include <cmath>

namespace mlsmesh {

namespace {

double percentile(std::vector<double>& values, double share) {
  const double rank = std::floor(share * static_cast<double>(values.size()));
  const auto place = values.begin() + std::min(static_cast<std::ptrdiff_t>(rank),
                                               static_cast<std::ptrdiff_t>(values.size()) - 1);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

}  // namespace

Statistics statisticsOf(std::vector<double> values) {
  Statistics statistics;
  if (values.empty()) return statistics;
  const auto count = static_cast<double>(values.size());
  double sum = 0, squares = 0;
  for (const double value : values) {
    sum += value;
    squares += value * value;
  }
  const auto [min, max] = std::minmax_element(values.begin(), values.end());
  statistics.min = *min;
  statistics.max = *max;
  statistics.mean = sum / count;
  statistics.rms = std::sqrt(squares / count);
  statistics.p5 = percentile(values, 0.05);
  statistics.p95 = percentile(values, 0.95);
  statistics.p99 = percentile(values, 0.99);
  return statistics;
}

double shareAbove(const std::vector<double>& values, double limit) {
  if (values.empty()) return kUnknown;
  const auto above = std::count_if(values.begin(), values.end(), [&](double value) { return value > limit; });
  return static_cast<double>(above) / static_cast<double>(values.size());
}

}  // namespace mlsmesh
