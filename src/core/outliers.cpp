// SPDX-License-Identifier: BSD-3-Clause
// Related: S. Sotoodeh, "Outlier detection in laser scanner point clouds", 2006 (local density against that
// of the neighbours); M. Ester, H.-P. Kriegel, J. Sander, X. Xu 1996 (density-linked groups).
#include "mlsmesh/core/outliers.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "disjoint_sets.h"

namespace mlsmesh::core {
namespace {

constexpr double kScattered = 0.1;  // surface variation of points that lie on no surface

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// A point off the surface: its projection was refused, and the cloud is sparser at it than around it.
bool isOff(const Representatives& all, const NeighborTable& neighbors, Index i) {
  constexpr double kSparser = 1.5;
  if (all.kind[i] != VertexKind::InputPoint) return false;
  std::vector<double> around;
  for (int j = 0; j < std::min(kOutlierNeighbors, neighbors.k); ++j)
    around.push_back(all.spacing[neighbors.row(i)[j]]);
  return all.spacing[i] > kSparser * median(around);
}

// A place far sparser than the cloud usually is, whose points spread in all directions: it links nothing.
bool isAfloat(const Representatives& all, double usual_spacing, Index i) {
  constexpr double kFarSparser = 6.0;
  constexpr double kEverywhere = 0.15;  // surface variation; edges of sparse sheets have less
  return all.spacing[i] > kFarSparser * usual_spacing && all.variation[i] > kEverywhere;
}

// Groups of linked representatives; those off the surface stay alone.
DisjointSets linkedGroups(const OutlierParameters& parameters, const Representatives& all,
                          const NeighborTable& neighbors) {
  const int looked_at = std::min(kOutlierNeighbors, neighbors.k);
  std::vector<char> off(all.position.size());
  std::vector<double> spacings = all.spacing;
  const double usual = median(spacings);
  for (Index i = 0; i < all.size(); ++i) off[i] = isOff(all, neighbors, i) || isAfloat(all, usual, i);
  DisjointSets groups(static_cast<std::size_t>(all.size()));
  for (Index i = 0; i < all.size(); ++i) {
    for (int j = 0; j < looked_at && !off[i]; ++j) {
      const Index other = neighbors.row(i)[j];
      const double reach = parameters.link * std::min(all.spacing[i], all.spacing[other]);
      const bool near = (all.position[i] - all.position[other]).squaredNorm() <= reach * reach;
      if (near && !off[other]) groups.join(i, other);
    }
  }
  return groups;
}

bool reaches(const NeighborSearch& search, const Vec3& place, double distance) {
  Index nearest = kNone;
  double squared_distance = 0;
  search.nearest(place, 1, &nearest, &squared_distance);
  return squared_distance <= distance * distance;
}

struct Group {
  Index points = 0;
  std::vector<double> spacing;
  std::vector<double> variation;
};

}  // namespace

std::vector<Index> dropOutliers(const OutlierParameters& parameters, const NeighborTable& neighbors,
                                Representatives& representatives, IndexLists& clusters) {
  constexpr double kSparse = 3.0;  // local spacing over the main group's
  if (!parameters.remove || representatives.size() == 0) return {};
  const Index count = representatives.size();
  DisjointSets links = linkedGroups(parameters, representatives, neighbors);
  std::vector<Group> groups(static_cast<std::size_t>(count));
  for (Index i = 0; i < count; ++i) {
    Group& group = groups[links.leader(i)];
    group.points += clusters.size(i);
    group.spacing.push_back(representatives.spacing[i]);
    group.variation.push_back(representatives.variation[i]);
  }
  const auto main = std::max_element(groups.begin(), groups.end(),
                                     [](const Group& a, const Group& b) { return a.points < b.points; });
  const double main_spacing = median(main->spacing);
  std::vector<char> keep_group(groups.size(), 0);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (groups[g].points < parameters.smallest_group) continue;
    const bool sparse = median(groups[g].spacing) > kSparse * main_spacing;
    keep_group[g] = !(sparse && median(groups[g].variation) > kScattered);
  }
  keep_group[static_cast<std::size_t>(main - groups.begin())] = 1;
  std::vector<char> keep(static_cast<std::size_t>(count));
  std::vector<Index> dropped;
  for (Index i = 0; i < count; ++i) {
    keep[i] = keep_group[links.leader(i)];
    if (!keep[i]) dropped.insert(dropped.end(), clusters.data(i), clusters.data(i) + clusters.size(i));
  }
  if (dropped.empty()) return dropped;
  dropRepresentatives(keep, representatives, clusters);
  std::sort(dropped.begin(), dropped.end());
  return dropped;
}

std::vector<char> forgetMembers(const std::vector<Index>& removed, const std::vector<Vec3>& removed_position,
                                int neighbors, Representatives& representatives, IndexLists& clusters) {
  constexpr double kPi = 3.14159265358979323846;
  // A fit starts some way from where it lands, and sees as far as its last neighbour.
  const double kReach = 1.5 * std::sqrt(neighbors / kPi);
  const auto search = makeKdTree(removed_position);
  IndexLists left;
  std::vector<char> keep(static_cast<std::size_t>(clusters.count()));
  std::vector<char> touched;
  for (Index c = 0; c < clusters.count(); ++c) {
    const Index before = static_cast<Index>(left.items.size());
    for (const Index* p = clusters.data(c); p != clusters.data(c) + clusters.size(c); ++p) {
      const auto place = std::lower_bound(removed.begin(), removed.end(), *p);
      if (place == removed.end() || *place != *p) {
        left.items.push_back(*p - static_cast<Index>(place - removed.begin()));
      }
    }
    const Index now = static_cast<Index>(left.items.size());
    keep[c] = now > before;
    if (!keep[c]) continue;
    left.begin.push_back(now);
    const bool same = now - before == clusters.size(c);
    touched.push_back(!same ||
                      reaches(*search, representatives.position[c], kReach * representatives.spacing[c]));
  }
  dropRepresentatives(keep, representatives, clusters);
  for (Index& p : representatives.nearest) {
    p -= static_cast<Index>(std::lower_bound(removed.begin(), removed.end(), p) - removed.begin());
  }
  clusters = std::move(left);
  return touched;
}

}  // namespace mlsmesh::core
