// SPDX-License-Identifier: BSD-3-Clause
// This work is based on:
// Guy Macdonald Morton. A computer oriented geodetic data base and a new technique in file sequencing. IBM,
// 1966.
#include "mlsmesh/core/point_set.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "mlsmesh/core/failure.h"
#include "mlsmesh/core/parallel.h"
#include "radix_sort.h"

namespace mlsmesh::core {

namespace {

constexpr std::size_t kBlock = 1 << 14;
constexpr int kMortonBits = 21;  // an axis; three of them fill a 64-bit key
constexpr double kLineTolerance = 1e-9;
constexpr double kMinExtent = 1e-50;  // products of six lengths stay finite and positive between these two
constexpr double kMaxExtent = 1e50;
constexpr double kNothing = 1e-70;  // a coordinate that no extent can tell from 0

/// An input point on its way to its place in the canonical order.
struct Entry {
  std::uint64_t key;
  Index input;
};

struct Box {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 high = Vec3::Constant(-std::numeric_limits<double>::infinity());

  void add(const Vec3& point) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  void add(const Box& other) {
    low = low.cwiseMin(other.low);
    high = high.cwiseMax(other.high);
  }
  Vec3 center() const { return 0.5 * low + 0.5 * high; }
  double halfExtent() const { return (0.5 * high - 0.5 * low).maxCoeff(); }
};

/// The nearest float. Through memory, because GCC 12 takes a pair of vectorised conversions there and back
/// for nothing.
double roundedToFloat(double value) {
  const volatile float rounded = static_cast<float>(value);
  return static_cast<double>(rounded);
}

double heldByFloat(double value) {
  constexpr double kMost = std::numeric_limits<float>::max();
  return value > kMost ? kMost : value < -kMost ? -kMost : value;
}

/// Without the smallest coordinates, or points would be told apart whose distances have no square.
double heldByDouble(double value) {
  return std::abs(value) < kNothing ? 0.0 : value;
}

Vec3 roundedTo(StoredAs type, const Vec3& world) {
  return type == StoredAs::Float ? Vec3(world.unaryExpr(&roundedToFloat))
                                 : Vec3(world.unaryExpr(&heldByDouble));
}

bool comesBefore(const Vec3& a, const Vec3& b) {
  if (a.x() != b.x()) return a.x() < b.x();
  if (a.y() != b.y()) return a.y() < b.y();
  return a.z() < b.z();
}

std::vector<Index> chosenInputs(const std::vector<Vec3>& world, const std::vector<Index>* indices) {
  if (world.empty()) throw Failure(StatusCode::EmptyInput, "the cloud holds no point");
  const std::size_t most = std::numeric_limits<Index>::max();
  if (world.size() > most || (indices && indices->size() > most))
    throw Failure(StatusCode::IndexOverflow,
                  "the cloud has more than 2147483647 points; thin it out or reconstruct it in parts");
  if (!indices) {
    std::vector<Index> all(world.size());
    std::iota(all.begin(), all.end(), 0);
    return all;
  }
  if (indices->empty())
    throw Failure(StatusCode::EmptyInput, "the index list is empty; leave it unset to use every point");
  for (std::size_t i = 0; i < indices->size(); ++i) {
    const Index index = (*indices)[i];
    if (index >= 0 && static_cast<std::size_t>(index) < world.size()) continue;
    throw Failure(StatusCode::InvalidIndices,
                  "indices[" + std::to_string(i) + "] is " + std::to_string(index) + " but the cloud has " +
                      std::to_string(world.size()) + " points; set the indices anew with each cloud");
  }
  return *indices;
}

/// Drops the inputs that are not finite as they will be stored; returns the box around the others.
Box dropNonFinite(const std::vector<Vec3>& world, const Context& context, std::vector<Index>& inputs,
                  PointSet& set) {
  std::vector<Box> boxes((inputs.size() + kBlock - 1) / kBlock);
  std::atomic<bool> all_finite{true};
  parallelBlocks(context, inputs.size(), kBlock, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const Vec3& point = world[inputs[i]];
      if (roundedTo(set.stored_as, point).allFinite())
        boxes[first / kBlock].add(point);
      else
        all_finite = false;
    }
  });
  if (!all_finite) {
    const auto kept = std::remove_if(inputs.begin(), inputs.end(), [&](Index i) {
      return !roundedTo(set.stored_as, world[i]).allFinite();
    });
    set.non_finite = static_cast<Index>(inputs.end() - kept);
    inputs.erase(kept, inputs.end());
  }
  Box box;
  for (const Box& part : boxes) box.add(part);
  return box;
}

/// The centre with few bits, so that taking it off and putting it back is exact wherever doubles allow it;
/// never -0, so that stored() gives none either.
Vec3 roundedOrigin(const Box& box) {
  const Vec3 center = box.center();
  return center.unaryExpr([](double c) {
    const bool fits = std::abs(c) <= static_cast<double>(std::numeric_limits<float>::max());
    return (fits ? roundedToFloat(c) : c) + 0.0;
  });
}

void checkExtent(const Box& box) {
  const double extent = 2 * box.halfExtent();
  if (extent == 0 || (extent >= kMinExtent && extent <= kMaxExtent)) return;
  throw Failure(StatusCode::DegenerateInput,
                "the cloud is " + std::string(extent > 1 ? "wider than 1e50" : "smaller than 1e-50") +
                    "; scale its coordinates, or remove the stray points that make it so");
}

/// Moves bit i of a 21-bit number to bit 3 i.
std::uint64_t spread(std::uint64_t bits) {
  bits = (bits | bits << 32) & 0x001f00000000ffff;
  bits = (bits | bits << 16) & 0x001f0000ff0000ff;
  bits = (bits | bits << 8) & 0x100f00f00f00f00f;
  bits = (bits | bits << 4) & 0x10c30c30c30c30c3;
  bits = (bits | bits << 2) & 0x1249249249249249;
  return bits;
}

/// Cells of a cube that holds the whole cloud, numbered along Morton's curve.
class MortonCells {
 public:
  MortonCells(const Box& box, const Vec3& origin) : low_(box.low - origin) {
    const double extent = 2 * box.halfExtent();
    cells_per_length_ = extent > 0 ? kCells / extent : 0;
  }

  std::uint64_t key(const Vec3& local) const {
    return cell(local, 0) << 2 | cell(local, 1) << 1 | cell(local, 2);
  }

 private:
  static constexpr double kCells = 1 << kMortonBits;

  std::uint64_t cell(const Vec3& local, int axis) const {
    const double position = (local[axis] - low_[axis]) * cells_per_length_;
    return spread(static_cast<std::uint64_t>(std::clamp(position, 0.0, kCells - 1)));
  }

  Vec3 low_;
  double cells_per_length_;
};

/// Input points in canonical order; those with equal positions follow one another, the lowest input first.
std::vector<Entry> sortedEntries(const std::vector<Vec3>& local, const std::vector<Index>& inputs,
                                 const MortonCells& cells, const Context& context) {
  std::vector<Entry> entries(inputs.size());
  parallelBlocks(context, inputs.size(), kBlock, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) entries[i] = {cells.key(local[inputs[i]]), inputs[i]};
  });
  radixSort(
      entries, 3 * kMortonBits, [](const Entry& entry) { return entry.key; }, context);
  CancelCheck check(context);
  for (auto first = entries.begin(); first != entries.end();) {
    check();
    const auto last = std::find_if(first, entries.end(), [&](const Entry& e) { return e.key != first->key; });
    if (last - first > 1) {
      std::sort(first, last, [&](const Entry& a, const Entry& b) {
        check();
        const Vec3 &p = local[a.input], &q = local[b.input];
        return p == q ? a.input < b.input : comesBefore(p, q);
      });
    }
    first = last;
  }
  return entries;
}

void keepDistinct(const std::vector<Vec3>& local, const std::vector<Entry>& entries, const Context& context,
                  PointSet& set) {
  CancelCheck check(context);
  set.position.reserve(entries.size());
  set.source.reserve(entries.size());
  set.duplicates_of.begin.reserve(entries.size() + 1);
  set.duplicates_of.items.reserve(entries.size());
  for (const Entry& entry : entries) {
    check();
    const Vec3& position = local[entry.input];
    if (set.position.empty() || set.position.back() != position) {
      set.position.push_back(position);
      set.source.push_back(entry.input);
      set.duplicates_of.begin.push_back(set.duplicates_of.begin.back());
    } else {
      ++set.duplicates;
      if (set.duplicates_of.items.back() == entry.input) continue;
    }
    set.duplicates_of.items.push_back(entry.input);
    ++set.duplicates_of.begin.back();
  }
}

/// Index of the point farthest from `from`, the first of equals.
Index farthest(const std::vector<Vec3>& points, const Vec3& from) {
  Index best = 0;
  for (Index i = 1; i < static_cast<Index>(points.size()); ++i)
    if ((points[i] - from).squaredNorm() > (points[best] - from).squaredNorm()) best = i;
  return best;
}

/// Width below which a cloud is a line: that of a line whose points were rounded to the stored type.
double lineWidth(const PointSet& set, const Box& box) {
  const double largest = std::max(box.low.cwiseAbs().maxCoeff(), box.high.cwiseAbs().maxCoeff());
  const double epsilon = set.stored_as == StoredAs::Float
                             ? static_cast<double>(std::numeric_limits<float>::epsilon())
                             : std::numeric_limits<double>::epsilon();
  return std::max(kLineTolerance * 2 * box.halfExtent(), 2 * epsilon * largest);
}

bool isLine(const PointSet& set, const Box& box) {
  const Vec3 a = set.position[farthest(set.position, set.position.front())];
  const Vec3 b = set.position[farthest(set.position, a)];
  const Vec3 along = (b - a) / (b - a).norm();
  const double width = lineWidth(set, box);
  return std::all_of(set.position.begin(), set.position.end(),
                     [&](const Vec3& p) { return (p - a).cross(along).norm() <= width; });
}

void checkShape(const PointSet& set, std::size_t given, const Box& box) {
  if (set.size() < 3)
    throw Failure(StatusCode::TooFewPoints,
                  "of " + std::to_string(given) + " points " + std::to_string(set.non_finite) +
                      " are not finite and " + std::to_string(set.duplicates) + " are duplicates; " +
                      std::to_string(set.size()) + " remain, but a surface needs 3");
  if (isLine(set, box))
    throw Failure(StatusCode::DegenerateInput,
                  "all " + std::to_string(set.size()) +
                      " distinct points lie on one line; a surface needs points beside it");
}

}  // namespace

Vec3 PointSet::stored(const Vec3& local) const {
  const Vec3 place = world(local);
  if (stored_as == StoredAs::Double) return roundedTo(stored_as, place) - origin;
  return roundedTo(stored_as, place.unaryExpr(&heldByFloat)) - origin;
}

PointSet makePointSet(std::vector<Vec3> world, StoredAs stored_as, const std::vector<Index>* indices,
                      Context& context) {
  PointSet set;
  set.stored_as = stored_as;
  std::vector<Index> inputs = chosenInputs(world, indices);
  const std::size_t given = inputs.size();
  const Box box = dropNonFinite(world, context, inputs, set);
  if (inputs.empty()) checkShape(set, given, {});
  checkExtent(box);
  set.origin = roundedOrigin(box);

  std::vector<Vec3>& local = world;
  parallelBlocks(context, world.size(), kBlock, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) local[i] = set.stored(world[i] - set.origin);
  });
  const std::vector<Entry> entries = sortedEntries(local, inputs, MortonCells(box, set.origin), context);
  std::vector<Index>().swap(inputs);
  keepDistinct(local, entries, context, set);
  context.checkCancelled();
  checkShape(set, given, box);
  context.checkCancelled();
  return set;
}

void removePoints(const std::vector<Index>& removed, PointSet& points) {
  IndexLists inputs;
  Index kept = 0;
  auto next = removed.begin();
  for (Index p = 0; p < points.size(); ++p) {
    if (next != removed.end() && *next == p) {
      ++next;
      continue;
    }
    points.position[kept] = points.position[p];
    points.source[kept] = points.source[p];
    inputs.append(points.duplicates_of.data(p), points.duplicates_of.size(p));
    ++kept;
  }
  points.position.resize(static_cast<std::size_t>(kept));
  points.source.resize(static_cast<std::size_t>(kept));
  points.duplicates_of = std::move(inputs);
}

}  // namespace mlsmesh::core
