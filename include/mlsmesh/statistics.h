// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <vector>

namespace mlsmesh {

/// What a figure is that cannot be measured: not a number.
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// Of a set of values, all kUnknown if there are none.
struct Statistics {
  double mean = kUnknown;
  double rms = kUnknown;  ///< root of the mean square
  double p5 = kUnknown;   ///< 5 % of the values are below it
  double p95 = kUnknown;
  double p99 = kUnknown;
  double min = kUnknown;
  double max = kUnknown;
};

/// A percentile is the value of rank floor(share * n) from 0. Values must be numbers. O(n).
Statistics statisticsOf(std::vector<double> values);

/// Of the values, the share above `limit`; kUnknown if there are none.
double shareAbove(const std::vector<double>& values, double limit);

}  // namespace mlsmesh
