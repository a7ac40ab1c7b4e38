// SPDX-License-Identifier: BSD-3-Clause
#include "compare/color_scale.h"

#include <algorithm>
#include <cmath>

namespace mlsmesh::apps {
namespace {

constexpr std::array<Rgb, 9> kViridis{{{68, 1, 84},
                                       {71, 44, 122},
                                       {59, 81, 139},
                                       {44, 113, 142},
                                       {33, 144, 141},
                                       {39, 173, 129},
                                       {92, 200, 99},
                                       {170, 220, 50},
                                       {253, 231, 37}}};

}  // namespace

Rgb scaleColor(double share) {
  const double place = std::clamp(share, 0.0, 1.0) * (kViridis.size() - 1);
  const std::size_t low = std::min(static_cast<std::size_t>(place), kViridis.size() - 2);
  const double part = place - static_cast<double>(low);
  Rgb color{};
  for (std::size_t i = 0; i < 3; ++i)
    color[i] =
        static_cast<int>(std::lround(kViridis[low][i] + part * (kViridis[low + 1][i] - kViridis[low][i])));
  return color;
}

}  // namespace mlsmesh::apps
