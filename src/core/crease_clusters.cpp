// SPDX-License-Identifier: BSD-3-Clause
// Clusters are cut by position alone (bsp_clustering.cpp); where a sharp edge passes, their points are sorted
// into sides by normal, after the idea of S. Fleishman, D. Cohen-Or, C. T. Silva, "Robust moving
// least-squares fitting with sharp features", SIGGRAPH 2005.
#include <algorithm>
#include <cmath>

#include "mlsmesh/core/features.h"

namespace mlsmesh::core {
namespace {

constexpr double kSameSide = 0.75;  // cosine of the normals of one group
constexpr Index kLeastGroup = 3;    // points of a group that gets a representative ...
constexpr Index kLargeCluster = 6;  // ... in a cluster of so many

struct Group {
  Vec3 sum = Vec3::Zero();
  std::vector<Index> members;

  Vec3 normal() const { return sum.normalized(); }
};

std::vector<Group> groupsOf(const std::vector<Index>& members, const std::vector<Vec3>& normals) {
  std::vector<Group> groups;
  for (const Index p : members) {
    const Vec3& normal = normals[p];
    const auto fits = [&](const Group& g) { return std::abs(g.normal().dot(normal)) > kSameSide; };
    auto group = std::find_if(groups.begin(), groups.end(), fits);
    if (group == groups.end()) group = groups.insert(group, Group());
    group->sum += group->sum.dot(normal) < 0 ? Vec3(-normal) : normal;
    group->members.push_back(p);
  }
  return groups;
}

class SideSorter {
 public:
  SideSorter(const PointSet& points, const Features& features)
      : points_(points), features_(features), of_vertex_(features.vertices.size()) {
    for (const CreaseVertex& vertex : features.vertices) vertex_position_.push_back(vertex.position);
    search_ = makeKdTree(vertex_position_);
  }

  void sort(const Index* members, Index size) {
    std::vector<Index> rest;
    bool in_zone = false;
    for (Index i = 0; i < size; ++i) {
      const Index p = members[i];
      in_zone = in_zone || features_.zone[p];
      if (features_.vertex_of[p] == kNone) {
        rest.push_back(p);
      } else {
        of_vertex_[features_.vertex_of[p]].push_back(p);
      }
    }
    if (rest.empty()) return;
    if (!in_zone) return append(rest, Vec3::Zero());
    for (const Group& group : groupsOf(rest, features_.normal)) {
      if (size >= kLargeCluster && static_cast<Index>(group.members.size()) < kLeastGroup) {
        for (const Index p : group.members) of_vertex_[nearestVertex(p)].push_back(p);
      } else {
        append(group.members, group.normal());
      }
    }
  }

  SidedClusters finish() {
    result_.first_crease = result_.clusters.count();
    for (std::vector<Index>& members : of_vertex_) {
      std::sort(members.begin(), members.end());
      append(members, Vec3::Zero());
    }
    return std::move(result_);
  }

 private:
  void append(const std::vector<Index>& members, const Vec3& normal) {
    result_.clusters.append(members.data(), static_cast<Index>(members.size()));
    result_.normal.push_back(normal);
  }

  Index nearestVertex(Index point) const {
    Index vertex = kNone;
    double squared_distance = 0;
    search_->nearest(points_.position[point], 1, &vertex, &squared_distance);
    return vertex;
  }

  const PointSet& points_;
  const Features& features_;
  std::vector<Vec3> vertex_position_;
  std::unique_ptr<NeighborSearch> search_;
  std::vector<std::vector<Index>> of_vertex_;
  SidedClusters result_;
};

}  // namespace

SidedClusters clustersBySide(const PointSet& points, const IndexLists& clusters, const Features& features) {
  SideSorter sorter(points, features);
  for (Index c = 0; c < clusters.count(); ++c) sorter.sort(clusters.data(c), clusters.size(c));
  return sorter.finish();
}

}  // namespace mlsmesh::core
