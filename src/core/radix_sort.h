// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "mlsmesh/core/context.h"

namespace mlsmesh::core {

/// Sorts the items by keyOf(item), an unsigned integer below 2^bits, one digit of eleven bits after the
/// other; items with equal keys keep their order. Asks the context between digits. O(n bits / 11), and as
/// many items of room again.
template <typename Item, typename KeyOf>
void radixSort(std::vector<Item>& items, int bits, const KeyOf& keyOf, const Context& context = {}) {
  constexpr int kDigit = 11;
  constexpr std::size_t kMask = (std::size_t{1} << kDigit) - 1;
  std::vector<Item> sorted(items.size());
  for (int shift = 0; shift < bits; shift += kDigit) {
    context.checkCancelled();
    const auto digitOf = [&](const Item& item) {
      return static_cast<std::size_t>(keyOf(item) >> shift) & kMask;
    };
    std::array<std::size_t, kMask + 2> begin{};
    for (const Item& item : items) ++begin[digitOf(item) + 1];
    for (std::size_t digit = 0; digit < kMask; ++digit) begin[digit + 1] += begin[digit];
    for (const Item& item : items) sorted[begin[digitOf(item)]++] = item;
    items.swap(sorted);
  }
}

}  // namespace mlsmesh::core
