// SPDX-License-Identifier: BSD-3-Clause
#include "radix_sort.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>

namespace mlsmesh::core {
namespace {

struct Item {
  std::uint64_t key;
  int number;

  bool operator==(const Item& other) const { return key == other.key && number == other.number; }
};

void expectStableOrder(int bits, std::uint64_t mask) {
  std::mt19937_64 random(static_cast<std::uint64_t>(bits) + mask);
  for (const int count : {0, 1, 2, 1000}) {
    std::vector<Item> items;
    for (int i = 0; i < count; ++i) items.push_back({random() & mask, i});
    std::vector<Item> expected = items;
    std::stable_sort(expected.begin(), expected.end(),
                     [](const Item& a, const Item& b) { return a.key < b.key; });
    radixSort(items, bits, [](const Item& item) { return item.key; });
    EXPECT_EQ(items, expected) << bits << " bits, " << count << " items";
  }
}

TEST(RadixSort, IsAStableSort) {
  for (const int bits : {1, 10, 11, 12, 30, 63, 64})
    expectStableOrder(bits, ~std::uint64_t{0} >> (64 - bits));
}

TEST(RadixSort, KeepsTheOrderOfEqualKeys) {
  expectStableOrder(63, 0x7000000000000001);
  expectStableOrder(63, 0);
}

}  // namespace
}  // namespace mlsmesh::core
