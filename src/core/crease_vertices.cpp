// SPDX-License-Identifier: BSD-3-Clause
// This work is based on K. Demarsin, D. Vanderstraeten, T. Volodine, D. Roose, "Detection of closed sharp
// edges in point clouds using normal estimation and graph theory", CAD 2007: sharp edges are traced through
// the cloud as lines. Departure: vertices are spread along them by marching from foot to nearest foot.
#include "crease_vertices.h"

#include <algorithm>
#include <numeric>
#include <queue>

#include "mlsmesh/core/parallel.h"

namespace mlsmesh::core {
namespace {

constexpr double kCornerSpread = 0.7;  // local spacings around the mean of the feet of a corner
constexpr Index kCornerFeet = 3;       // feet that make a corner
constexpr double kLeaves = 1.0;  // local spacings between a point and its foot: it leaves the smooth clusters
constexpr int kRefitPoints = 40;
constexpr double kMayMove = 0.5;  // local spacings, when fitted again in its own neighbourhood

class Marcher {
 public:
  Marcher(const std::vector<CreaseFoot>& feet, double spacing)
      : feet_(feet), spacing_(spacing), position_(positionsOf(feet)), search_(makeKdTree(position_)) {
    live_.assign(feet.size(), 1);
  }

  /// The chosen vertices; `foot` of each is one of those that made it.
  void run(std::vector<CreaseVertex>& vertices, std::vector<Index>& foot) {
    chooseCorners(vertices, foot);
    std::vector<Index> order(feet_.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](Index a, Index b) {
      return feet_[a].quality < feet_[b].quality || (feet_[a].quality == feet_[b].quality && a < b);
    });
    march(vertices, foot);
    for (const Index start : order) {
      if (!live_[start]) continue;
      choose(feet_[start], start, feet_[start].position, vertices, foot);
      march(vertices, foot);
    }
  }

 private:
  struct Entry {
    double distance;
    Index foot;
    bool operator<(const Entry& other) const {
      return distance > other.distance || (distance == other.distance && foot > other.foot);
    }
  };

  static std::vector<Vec3> positionsOf(const std::vector<CreaseFoot>& feet) {
    std::vector<Vec3> positions;
    for (const CreaseFoot& foot : feet) positions.push_back(foot.position);
    return positions;
  }

  // Feet within a radius, nearest first.
  void findWithin(const Vec3& x, double radius, std::vector<Index>& found) {
    int k = 64, count = 0;
    do {
      k = std::min(2 * k, static_cast<int>(feet_.size()));
      found.resize(static_cast<std::size_t>(k));
      squared_.resize(static_cast<std::size_t>(k));
      count = search_->nearest(x, k, found.data(), squared_.data());
    } while (count == k && k < static_cast<int>(feet_.size()) && squared_[k - 1] <= radius * radius);
    while (count > 0 && squared_[count - 1] > radius * radius) --count;
    found.resize(static_cast<std::size_t>(count));
  }

  void chooseCorners(std::vector<CreaseVertex>& vertices, std::vector<Index>& foot) {
    std::vector<std::pair<Index, Index>> crowded;  // minus the number of corner feet around, foot
    std::vector<Index> around;
    for (Index i = 0; i < static_cast<Index>(feet_.size()); ++i) {
      if (feet_[i].sides < 3) continue;
      cornersAround(i, around);
      const Index count = static_cast<Index>(around.size());
      if (count >= kCornerFeet) crowded.emplace_back(-count, i);
    }
    std::sort(crowded.begin(), crowded.end());
    for (const auto& [count, i] : crowded) {
      if (!live_[i]) continue;
      cornersAround(i, around);
      Vec3 sum = Vec3::Zero();
      for (const Index j : around) sum += feet_[j].position - feet_[i].position;
      choose(feet_[i], i, feet_[i].position + sum / static_cast<double>(around.size()), vertices, foot);
    }
  }

  void cornersAround(Index foot, std::vector<Index>& around) {
    findWithin(feet_[foot].position, kCornerSpread * feet_[foot].spacing, around);
    around.erase(std::remove_if(around.begin(), around.end(), [&](Index j) { return feet_[j].sides < 3; }),
                 around.end());
  }

  void choose(const CreaseFoot& made_of, Index own, const Vec3& position, std::vector<CreaseVertex>& vertices,
              std::vector<Index>& foot) {
    const double reach = spacing_ * made_of.spacing;
    findWithin(position, 2 * reach, found_);
    for (const Index i : found_) {
      const double distance = (feet_[i].position - position).norm();
      if (distance < reach) live_[i] = 0;
      if (live_[i]) queue_.push({distance, i});
    }
    live_[own] = 0;
    vertices.push_back({position, made_of.bisector, made_of.sides, made_of.side_normal, made_of.spacing});
    foot.push_back(own);
  }

  void march(std::vector<CreaseVertex>& vertices, std::vector<Index>& foot) {
    while (!queue_.empty()) {
      const Index next = queue_.top().foot;
      queue_.pop();
      if (live_[next]) choose(feet_[next], next, feet_[next].position, vertices, foot);
    }
  }

  const std::vector<CreaseFoot>& feet_;
  const double spacing_;
  std::vector<Vec3> position_;
  std::unique_ptr<NeighborSearch> search_;
  std::vector<char> live_;
  std::priority_queue<Entry> queue_;
  std::vector<Index> found_;
  std::vector<double> squared_;
};

// The part of a step that is square to the edge, so that vertices keep their distance; all of it at a corner.
Vec3 acrossEdge(const CreaseFoot& foot, const Vec3& step) {
  if (foot.sides != 2) return step;
  const Vec3 along = foot.side_normal[0].cross(foot.side_normal[1]).normalized();
  return step - step.dot(along) * along;
}

// Feet are found from points up to two spacings away; the surfaces are fitted better around the foot itself.
void fitAgain(const std::vector<Vec3>& cloud, const NeighborSearch& search, const RobustNormals& normals,
              const Context& context, std::vector<CreaseVertex>& vertices) {
  parallelBlocks(context, vertices.size(), 64, [&](std::size_t first, std::size_t last) {
    std::array<Index, kRefitPoints> nearest;
    std::array<double, kRefitPoints> squared_distance;
    for (std::size_t i = first; i < last; ++i) {
      CreaseVertex& vertex = vertices[i];
      const int count =
          search.nearest(vertex.position, kRefitPoints, nearest.data(), squared_distance.data());
      const CreaseFoot foot = footBetween(vertex.position, vertex.side_normal, vertex.sides, vertex.spacing,
                                          nearest.data(), count, cloud, normals.all());
      if (foot.sides == 0) continue;
      const Vec3 step = acrossEdge(foot, foot.position - vertex.position);
      if (!(step.norm() <= kMayMove * vertex.spacing)) continue;
      vertex.position += step;
      vertex.normal = foot.bisector;
      vertex.side_normal = foot.side_normal;
    }
  });
}

void joinClusters(const std::vector<Index>& points, const std::vector<CreaseFoot>& feet,
                  const std::vector<Vec3>& cloud, const std::vector<Index>& made_by, Features& features) {
  std::vector<Vec3> position;
  for (const CreaseVertex& vertex : features.vertices) position.push_back(vertex.position);
  const auto search = makeKdTree(position);
  features.vertex_of.assign(cloud.size(), kNone);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double distance = (feet[i].position - cloud[points[i]]).norm();
    if (distance >= kLeaves * feet[i].spacing) continue;
    double squared_distance = 0;
    search->nearest(feet[i].position, 1, &features.vertex_of[points[i]], &squared_distance);
  }
  for (std::size_t v = 0; v < made_by.size(); ++v) {
    features.vertex_of[points[made_by[v]]] = static_cast<Index>(v);
  }
}

}  // namespace

void chooseCreaseVertices(const std::vector<Index>& points, const std::vector<CreaseFoot>& feet,
                          const std::vector<Vec3>& cloud, const NeighborSearch& search,
                          const RobustNormals& normals, double spacing, const Context& context,
                          Features& features) {
  std::vector<Index> made_by;
  Marcher(feet, spacing).run(features.vertices, made_by);
  fitAgain(cloud, search, normals, context, features.vertices);
  joinClusters(points, feet, cloud, made_by, features);
}

}  // namespace mlsmesh::core
