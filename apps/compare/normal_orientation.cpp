// SPDX-License-Identifier: BSD-3-Clause
#include "compare/normal_orientation.h"

#include <pcl/kdtree/kdtree_flann.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

namespace mlsmesh::apps {
namespace {

struct Edge {
  float cost;
  int a, b;  ///< a < b
  bool operator<(const Edge& other) const {
    return std::tie(cost, a, b) < std::tie(other.cost, other.a, other.b);
  }
};

/// Sets of points, each with whether it is to be turned over against the first of its set.
class TurnedSets {
 public:
  explicit TurnedSets(std::size_t points) : parent_(points), turned_(points, false), size_(points, 1) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  /// First of the set, and whether `point` is turned against it.
  std::pair<int, bool> find(int point) {
    bool turned = false;
    while (parent_[point] != point) {
      // Halves the path: a grandparent becomes the parent.
      const int parent = parent_[point];
      turned_[point] = turned_[point] != turned_[parent];
      parent_[point] = parent_[parent];
      turned = turned != turned_[point];
      point = parent_[point];
    }
    return {point, turned};
  }

  /// Joins the sets of two points that are, or are not, turned against each other.
  void join(int a, int b, bool against) {
    auto [first, first_turned] = find(a);
    auto [second, second_turned] = find(b);
    if (first == second) return;
    if (size_[first] < size_[second]) std::swap(first, second);
    parent_[second] = first;
    turned_[second] = (first_turned != second_turned) != against;
    size_[first] += size_[second];
  }

 private:
  std::vector<int> parent_;
  std::vector<bool> turned_;  ///< against the parent; false for the first of a set
  std::vector<int> size_;
};

float cosine(const OrientedCloud& points, int a, int b) {
  return points[a].getNormalVector3fMap().dot(points[b].getNormalVector3fMap());
}

std::vector<Edge> neighborGraph(int neighbors, const OrientedCloud& points) {
  pcl::KdTreeFLANN<pcl::PointNormal> tree;
  tree.setInputCloud(points.makeShared());
  std::vector<Edge> edges;
  edges.reserve(points.size() * static_cast<std::size_t>(neighbors));
  pcl::Indices near;
  std::vector<float> squared;
  for (int i = 0; i < static_cast<int>(points.size()); ++i) {
    tree.nearestKSearch(points[i], neighbors + 1, near, squared);
    for (const int j : near)
      if (j != i) edges.push_back({1 - std::abs(cosine(points, i, j)), std::min(i, j), std::max(i, j)});
  }
  return edges;
}

void turnOver(pcl::PointNormal& point) {
  point.getNormalVector3fMap() *= -1;
}

}  // namespace

void orientNormals(int neighbors, OrientedCloud& points) {
  std::vector<Edge> edges = neighborGraph(neighbors, points);
  std::sort(edges.begin(), edges.end());
  TurnedSets sets(points.size());
  for (const Edge& edge : edges) sets.join(edge.a, edge.b, cosine(points, edge.a, edge.b) < 0);

  const int count = static_cast<int>(points.size());
  std::vector<int> highest(points.size(), -1);  // of the set of each first point
  for (int i = 0; i < count; ++i) {
    int& best = highest[sets.find(i).first];
    if (best < 0 || points[i].z > points[best].z) best = i;
  }
  std::vector<char> looks_down(points.size(), 0);  // as its set is turned now
  for (int i = 0; i < count; ++i) {
    if (highest[i] < 0) continue;
    const bool is_turned = sets.find(highest[i]).second;
    looks_down[i] = (points[highest[i]].normal_z < 0) != is_turned;
  }
  for (int i = 0; i < count; ++i) {
    const auto [first, turned] = sets.find(i);
    if (turned != (looks_down[first] != 0)) turnOver(points[i]);
  }
}

}  // namespace mlsmesh::apps
