// SPDX-License-Identifier: BSD-3-Clause
// This work is based on:
// - S. Fleishman, D. Cohen-Or, C. T. Silva, "Robust moving least-squares fitting with sharp features",
//   SIGGRAPH 2005: points near a sharp edge go to the intersection of the surfaces of its sides.
// - J. Canny, "A computational approach to edge detection", PAMI 1986: hysteresis, so that weak evidence
// counts
//   only beside strong evidence.
#include "crease_feet.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "surface_patch.h"

namespace mlsmesh::core {
namespace {

constexpr int kGrouped = 25;           // points that are sorted into sides, the point itself included
constexpr int kLooked = 17;            // points of which one must be turned, the point itself included
constexpr int kRounds = 2;             // of sorting into sides
constexpr int kLeastSide = 3;          // points of a side
constexpr int kSteps = 3;              // onto the tangent planes of the sides
constexpr double kSupport = 2.0;       // of a side's fit, local spacings
constexpr double kReach = 2.0;         // from the point to its foot, local spacings
constexpr double kNearEdge = 1.75;     // local spacings from a foot to the nearest point of each of its sides
constexpr double kNearCorner = 2.5;    // the same where three sides meet, each in a quarter of the plane
constexpr double kRoughest = 0.2;      // residual of a side from its plane, local spacings
constexpr double kWorst = 0.5;         // quality of a foot
constexpr double kSharp = 0.2;         // quality of a foot that is clearly on a sharp edge
constexpr double kLeastSine = 0.05;    // squared sine between two sides that meet
constexpr double kLeastVolume = 0.15;  // determinant of the normals of three sides that meet
constexpr int kSharpFeet = 10;
constexpr double kLink = 2.0;      // local spacings between linked feet
constexpr double kSameSide = 0.8;  // cosine of a point's normal with that of the side it belongs to
constexpr int kLargestSide = 14;
constexpr int kSettlings = 2;
constexpr double kOffSide = 0.25;  // local spacings from the side of a point that belongs to none

struct Side {
  std::array<Index, 40> members;
  int count = 0;
  Vec3 normal = Vec3::Zero();

  void add(Index point) {
    if (count < static_cast<int>(members.size())) members[static_cast<std::size_t>(count++)] = point;
  }
};

using Sides = std::vector<Side>;

// The member of the row least like the seeds, if it differs from all of them.
Index leastLike(const Index* row, int count, const std::vector<Vec3>& seeds, double cosine,
                const RobustNormals& normals) {
  Index found = kNone;
  double least = cosine;
  for (int i = 0; i < count; ++i) {
    double like = 0;
    for (const Vec3& seed : seeds) like = std::max(like, std::abs(seed.dot(normals[row[i]])));
    if (like < least) {
      least = like;
      found = row[i];
    }
  }
  return found;
}

std::size_t mostLike(const std::vector<Vec3>& seeds, const Vec3& normal) {
  std::size_t best = 0;
  for (std::size_t s = 1; s < seeds.size(); ++s) {
    if (std::abs(seeds[s].dot(normal)) > std::abs(seeds[best].dot(normal))) best = s;
  }
  return best;
}

// Two or three groups of the row by the directions of their normals (k-means over lines); fewer if it holds
// no more. Groups of too few points are left out.
Sides sidesOf(const Index* row, int count, double cosine, const RobustNormals& normals) {
  std::vector<Vec3> seeds{normals[row[0]]};
  while (seeds.size() < 3) {
    const Index other = leastLike(row, count, seeds, cosine, normals);
    if (other == kNone) break;
    seeds.push_back(normals[other]);
  }
  Sides sides;
  if (seeds.size() < 2) return sides;
  for (int round = 0; round < kRounds; ++round) {
    sides.assign(seeds.size(), Side());
    for (int i = 0; i < count; ++i) {
      const Vec3& normal = normals[row[i]];
      const std::size_t s = mostLike(seeds, normal);
      sides[s].add(row[i]);
      sides[s].normal += normal.dot(seeds[s]) < 0 ? Vec3(-normal) : normal;
    }
    for (std::size_t s = 0; s < seeds.size(); ++s) {
      if (sides[s].count > 0) seeds[s] = sides[s].normal = sides[s].normal.normalized();
    }
  }
  sides.erase(std::remove_if(sides.begin(), sides.end(), [](const Side& s) { return s.count < kLeastSide; }),
              sides.end());
  return sides;
}

double distanceTo(const SurfacePatch& patch, const Vec3& x) {
  const TangentPlane plane = patch.tangentAt(x);
  return std::abs((x - plane.point).dot(plane.normal));
}

// Fits the sides again from the points nearest to each: a few normals are those of the wrong side.
void settle(const std::vector<Vec3>& points, const Vec3& start, double spacing, Sides& sides,
            std::vector<SurfacePatch>& patches) {
  for (int round = 0; round < kSettlings; ++round) {
    Sides settled(sides.size());
    for (const Side& side : sides) {
      for (int i = 0; i < side.count; ++i) {
        const Index p = side.members[static_cast<std::size_t>(i)];
        std::size_t best = 0;
        double least = std::numeric_limits<double>::max();
        for (std::size_t s = 0; s < patches.size(); ++s) {
          const double distance = distanceTo(patches[s], points[p]);
          if (distance >= least) continue;
          least = distance;
          best = s;
        }
        if (least <= kOffSide * spacing) settled[best].add(p);
      }
    }
    if (std::any_of(settled.begin(), settled.end(), [](const Side& s) { return s.count < kLeastSide; }))
      return;
    sides = settled;
    for (std::size_t s = 0; s < sides.size(); ++s) {
      patches[s] = SurfacePatch(points, sides[s].members.data(), sides[s].count, start, kSupport * spacing);
    }
  }
}

bool meetTwo(const SurfacePatch& a, const SurfacePatch& b, Vec3& x) {
  for (int step = 0; step < kSteps; ++step) {
    const TangentPlane p = a.tangentAt(x), q = b.tangentAt(x);
    const double g = p.normal.dot(q.normal);
    const double sine = 1 - g * g;
    if (!(sine >= kLeastSine)) return false;
    const double to_p = (p.point - x).dot(p.normal), to_q = (q.point - x).dot(q.normal);
    x += (to_p - g * to_q) / sine * p.normal + (to_q - g * to_p) / sine * q.normal;
  }
  return x.allFinite();
}

bool meetThree(const std::vector<SurfacePatch>& patches, Vec3& x) {
  for (int step = 0; step < kSteps; ++step) {
    Eigen::Matrix3d normals;
    Vec3 off;
    for (int i = 0; i < 3; ++i) {
      const TangentPlane plane = patches[static_cast<std::size_t>(i)].tangentAt(x);
      normals.row(i) = plane.normal.transpose();
      off[i] = (plane.point - x).dot(plane.normal);
    }
    if (!(std::abs(normals.determinant()) >= kLeastVolume)) return false;
    x += normals.inverse() * off;
  }
  return x.allFinite();
}

// Unit direction from x into the side, in its plane and square to the edge (if there is one).
Vec3 directionInto(const SurfacePatch& side, const Vec3& x, const Vec3& along) {
  const Vec3 normal = side.tangentAt(x).normal;
  Vec3 d = side.centroid() - x;
  d -= d.dot(normal) * normal;
  d -= d.dot(along) * along;
  return d.normalized();
}

void describe(const std::vector<const SurfacePatch*>& sides, CreaseFoot& foot) {
  foot.sides = static_cast<int>(sides.size());
  for (std::size_t i = 0; i < sides.size(); ++i) {
    foot.side_normal[i] = sides[i]->tangentAt(foot.position).normal;
  }
  const Vec3 along = foot.sides == 2 ? Vec3(foot.side_normal[0].cross(foot.side_normal[1]).normalized())
                                     : Vec3(Vec3::Zero());
  Vec3 sum = Vec3::Zero();
  for (const SurfacePatch* side : sides) sum += directionInto(*side, foot.position, along);
  foot.bisector = sum.norm() > 1e-6 ? Vec3(sum.normalized()) : foot.side_normal[0];
}

// Whether each side that meets at the foot has points near it: planes also meet where there is no surface.
bool isSupported(const CreaseFoot& foot, const Sides& sides, const std::vector<Vec3>& points) {
  const double reach = (foot.sides == 3 ? kNearCorner : kNearEdge) * foot.spacing;
  int near = 0;
  for (const Side& side : sides) {
    near += std::any_of(side.members.begin(), side.members.begin() + side.count,
                        [&](Index p) { return (points[p] - foot.position).norm() <= reach; });
  }
  return near >= foot.sides;
}

double qualityOf(const Sides& sides, const std::vector<SurfacePatch>& patches, double residual) {
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    sum += sides[i].count * patches[i].planeResidual();
    count += sides[i].count;
  }
  return std::sqrt(sum / count) / residual;
}

// Nearest of the feet on the pairs of sides.
void nearestPair(const std::vector<SurfacePatch>& patches, const Vec3& start, CreaseFoot& foot) {
  double least = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < patches.size(); ++i) {
    for (std::size_t j = i + 1; j < patches.size(); ++j) {
      Vec3 x = start;
      if (!meetTwo(patches[i], patches[j], x) || (x - start).norm() >= least) continue;
      least = (x - start).norm();
      foot.position = x;
      describe({&patches[i], &patches[j]}, foot);
    }
  }
}

bool hasTurnedNeighbor(const Index* row, double cosine, const RobustNormals& normals) {
  const Vec3& own = normals[row[0]];
  return std::any_of(row + 1, row + kLooked, [&](Index q) { return std::abs(normals[q].dot(own)) < cosine; });
}

Index rootOf(std::vector<Index>& parent, Index i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

}  // namespace

CreaseFoot creaseFootOf(Index point, double residual, double cosine, const SparseNeighbors& neighbors,
                        const RobustNormals& normals) {
  CreaseFoot foot;
  const Index* row = neighbors.row(point);
  if (!hasTurnedNeighbor(row, cosine, normals)) return foot;
  Sides sides = sidesOf(row, kGrouped, cosine, normals);
  if (sides.size() < 2) return foot;
  const std::vector<Vec3>& points = neighbors.positions();
  const Vec3& start = points[point];
  foot.spacing = neighbors.spacing(point);
  std::vector<SurfacePatch> patches;
  for (const Side& side : sides) {
    patches.emplace_back(points, side.members.data(), side.count, start, kSupport * foot.spacing);
    if (patches.back().planeResidual() > kRoughest * kRoughest * foot.spacing * foot.spacing) return foot;
  }
  foot.quality = qualityOf(sides, patches, residual);
  if (!(foot.quality <= kWorst)) return foot;
  settle(points, start, foot.spacing, sides, patches);
  Vec3 corner = start;
  const double reach = kReach * foot.spacing;
  if (patches.size() == 3 && meetThree(patches, corner) && (corner - start).norm() <= reach) {
    foot.position = corner;
    describe({&patches[0], &patches[1], &patches[2]}, foot);
    if (isSupported(foot, sides, points)) return foot;
    foot.sides = 0;
  }
  nearestPair(patches, start, foot);
  if (foot.sides > 0 && ((foot.position - start).norm() > reach || !isSupported(foot, sides, points))) {
    foot.sides = 0;
  }
  return foot;
}

CreaseFoot footBetween(const Vec3& start, const std::array<Vec3, 3>& side_normals, int count, double spacing,
                       const Index* nearest, int found, const std::vector<Vec3>& points,
                       const std::vector<Vec3>& normals) {
  const std::vector<Vec3> wanted(side_normals.begin(), side_normals.begin() + count);
  Sides sides(wanted.size());
  for (int i = 0; i < found; ++i) {
    const Vec3& normal = normals[nearest[i]];
    const std::size_t s = mostLike(wanted, normal);
    if (std::abs(normal.dot(wanted[s])) > kSameSide && sides[s].count < kLargestSide)
      sides[s].add(nearest[i]);
  }
  CreaseFoot foot;
  foot.spacing = spacing;
  if (std::any_of(sides.begin(), sides.end(), [](const Side& s) { return s.count < kLeastSide; }))
    return foot;
  std::vector<SurfacePatch> patches;
  for (const Side& side : sides) {
    patches.emplace_back(points, side.members.data(), side.count, start, kSupport * spacing);
  }
  settle(points, start, spacing, sides, patches);
  foot.position = start;
  const bool meet =
      count == 3 ? meetThree(patches, foot.position) : meetTwo(patches[0], patches[1], foot.position);
  if (!meet) return foot;
  std::vector<const SurfacePatch*> meeting;
  for (const SurfacePatch& patch : patches) meeting.push_back(&patch);
  describe(meeting, foot);
  return foot;
}

bool isClearlySharp(const CreaseFoot& foot) {
  return foot.sides > 0 && foot.quality < kSharp;
}

std::vector<char> keptFeet(const std::vector<Index>& points, const std::vector<CreaseFoot>& feet,
                           const SparseNeighbors& neighbors) {
  std::vector<Index> of_slot(static_cast<std::size_t>(neighbors.count()), kNone);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (feet[i].sides > 0) of_slot[neighbors.slot(points[i])] = static_cast<Index>(i);
  }
  std::vector<Index> parent(points.size());
  std::iota(parent.begin(), parent.end(), 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (feet[i].sides == 0) continue;
    const Index* row = neighbors.row(points[i]);
    for (int n = 1; n < neighbors.k(); ++n) {
      const Index slot = neighbors.slot(row[n]);
      const Index j = slot == kNone ? kNone : of_slot[slot];
      if (j == kNone || (feet[j].position - feet[i].position).norm() > kLink * feet[i].spacing) continue;
      parent[rootOf(parent, static_cast<Index>(i))] = rootOf(parent, j);
    }
  }
  std::vector<int> all(points.size(), 0), sharp(points.size(), 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Index root = rootOf(parent, static_cast<Index>(i));
    all[root] += feet[i].sides > 0;
    sharp[root] += isClearlySharp(feet[i]);
  }
  std::vector<char> kept(points.size(), 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Index root = rootOf(parent, static_cast<Index>(i));
    kept[i] = feet[i].sides > 0 && sharp[root] >= kSharpFeet && sharp[root] >= kSharpShare * all[root];
  }
  return kept;
}

}  // namespace mlsmesh::core
