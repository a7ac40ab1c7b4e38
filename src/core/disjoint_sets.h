// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include "mlsmesh/core/types.h"

namespace mlsmesh::core {

/// Disjoint sets of 0 .. n - 1; the leader of a set is its lowest member.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }

  Index leader(Index item) {
    while (parent_[item] != item) item = parent_[item] = parent_[parent_[item]];
    return item;
  }
  void join(Index a, Index b) {
    a = leader(a);
    b = leader(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }
  Index count() const {
    Index leaders = 0;
    for (std::size_t i = 0; i < parent_.size(); ++i) leaders += parent_[i] == static_cast<Index>(i);
    return leaders;
  }

 private:
  std::vector<Index> parent_;
};

/// Disjoint sets whose members are on one of two sides, known relative to one another.
class TwoSidedSets {
 public:
  explicit TwoSidedSets(std::size_t count) : parent_(count), across_(count, 0) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  /// Puts the sets of `a` and `b` together so that the two are on the same side, or on opposite ones. False,
  /// and nothing done, if they are in one set and known to be otherwise.
  bool join(Index a, Index b, bool opposite) {
    const Place at_a = find(a), at_b = find(b);
    const bool across = (at_a.across != at_b.across) != opposite;
    if (at_a.leader == at_b.leader) return !across;
    parent_[at_b.leader] = at_a.leader;
    across_[at_b.leader] = across ? 1 : 0;
    return true;
  }

 private:
  struct Place {
    Index leader;
    bool across;  ///< on the side opposite to the leader's
  };

  Place find(Index item) {
    bool across = false;
    Index leader = item;
    for (; parent_[leader] != leader; leader = parent_[leader]) across = across != (across_[leader] != 0);
    for (bool rest = across; parent_[item] != leader && item != leader;) {
      const Index next = parent_[item];
      const bool next_rest = rest != (across_[item] != 0);
      parent_[item] = leader;
      across_[item] = rest ? 1 : 0;
      item = next;
      rest = next_rest;
    }
    return {leader, across};
  }

  std::vector<Index> parent_;
  std::vector<char> across_;  ///< on the side opposite to the parent's
};

}  // namespace mlsmesh::core
