// SPDX-License-Identifier: BSD-3-Clause
#include "mlsmesh/core/point_set.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <utility>

#include "mlsmesh/core/failure.h"
#include "test_shapes.h"

namespace mlsmesh::core {
namespace {

using test::asFloats;
using test::lattice;
using test::randomCloud;
using Points = std::vector<Vec3>;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

PointSet makeSet(const Points& world, StoredAs stored_as = StoredAs::Float,
                 const std::vector<Index>* indices = nullptr) {
  Context context;
  return makePointSet(world, stored_as, indices, context);
}

/// What makeSet refuses, and why.
std::pair<StatusCode, std::string> refusal(const Points& world, StoredAs stored_as = StoredAs::Float,
                                           const std::vector<Index>* indices = nullptr) {
  try {
    makeSet(world, stored_as, indices);
  } catch (const Failure& failure) {
    return {failure.code(), failure.what()};
  }
  return {StatusCode::Ok, ""};
}

void expectSameBits(const PointSet& a, const PointSet& b) {
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.origin, b.origin);
  EXPECT_EQ(a.non_finite, b.non_finite);
  EXPECT_EQ(a.duplicates, b.duplicates);
}

/// A cloud with everything that gets dropped, and negative zeros.
Points awkwardCloud() {
  Points points = randomCloud(3000, 2);
  const Points again(points.begin() + 100, points.begin() + 400);
  points.insert(points.end(), again.begin(), again.end());
  points.insert(points.end(), again.begin(), again.begin() + 50);
  points.emplace_back(kNan, 0, 0);
  points.emplace_back(0, kInfinity, 0);
  points.emplace_back(0.0, 0.5, -0.0);
  points.emplace_back(-0.0, 0.5, 0.0);
  const Points grid = lattice(9);
  points.insert(points.end(), grid.begin(), grid.end());
  return points;
}

TEST(PointSet, DoesNotDependOnTheOrderOfTheInput) {
  const Points world = awkwardCloud();
  const PointSet expected = makeSet(world);
  std::mt19937 random(5);
  for (int round = 0; round < 5; ++round) {
    std::vector<Index> order(world.size());
    std::iota(order.begin(), order.end(), 0);
    std::shuffle(order.begin(), order.end(), random);
    Points shuffled;
    for (const Index i : order) shuffled.push_back(world[i]);
    const PointSet set = makeSet(shuffled);
    expectSameBits(set, expected);
    for (Index i = 0; i < set.size(); ++i) {
      std::vector<Index> inputs;
      for (Index j = 0; j < set.duplicates_of.size(i); ++j)
        inputs.push_back(order[set.duplicates_of.data(i)[j]]);
      std::sort(inputs.begin(), inputs.end());
      const Index* const wanted = expected.duplicates_of.data(i);
      ASSERT_EQ(inputs, std::vector<Index>(wanted, wanted + expected.duplicates_of.size(i)));
    }
  }
}

TEST(PointSet, DoesNotDependOnTheNumberOfThreads) {
  const Points world = randomCloud(100000, 6);
  Context one, many;
  one.threads = 1;
  many.threads = 5;
  const PointSet a = makePointSet(world, StoredAs::Float, nullptr, one);
  const PointSet b = makePointSet(world, StoredAs::Float, nullptr, many);
  expectSameBits(a, b);
  EXPECT_EQ(a.source, b.source);
}

TEST(PointSet, AccountsForEveryInputPoint) {
  const Points world = awkwardCloud();
  const PointSet set = makeSet(world);
  EXPECT_EQ(set.non_finite, 2);
  EXPECT_EQ(set.duplicates, 300 + 50 + 1);
  EXPECT_EQ(set.size() + set.duplicates + set.non_finite, static_cast<Index>(world.size()));
  ASSERT_EQ(set.duplicates_of.count(), set.size());
  for (Index i = 0; i < set.size(); ++i) {
    const Index* const inputs = set.duplicates_of.data(i);
    EXPECT_EQ(set.source[i], inputs[0]);
    EXPECT_TRUE(std::is_sorted(inputs, inputs + set.duplicates_of.size(i)));
    for (Index j = 0; j < set.duplicates_of.size(i); ++j)
      ASSERT_EQ(set.world(set.position[i]), world[inputs[j]]);
  }
}

TEST(PointSet, HoldsEachPositionOnce) {
  const PointSet set = makeSet(awkwardCloud());
  std::set<std::array<double, 3>> distinct;
  for (const Vec3& p : set.position) distinct.insert({p.x(), p.y(), p.z()});
  EXPECT_EQ(distinct.size(), set.position.size());
}

TEST(PointSet, WritesZeroWithoutASign) {
  const Points around_zero = {{-0.0, -0.0, 1}, {-0.0, 0.0, -1}, {-1, -1, -0.0}, {1, 1, -0.0}};
  const Points at_minus_zero = {{1, 0, -0.0}, {0, 1, -0.0}, {-1, -1, -0.0}};
  const auto has_minus_zero = [](const Vec3& p) {
    return (p.array() == 0 && p.array().unaryExpr([](double x) { return std::signbit(x); })).any();
  };
  for (const Points& world : {around_zero, at_minus_zero}) {
    const PointSet set = makeSet(world);
    EXPECT_TRUE(std::none_of(set.position.begin(), set.position.end(), has_minus_zero));
    EXPECT_FALSE(has_minus_zero(set.origin));
  }
}

TEST(PointSet, FollowsMortonsCurve) {
  const PointSet set = makeSet(lattice(4));
  for (Index cell = 0; cell < set.size(); cell += 8) {
    const auto first = set.position.begin() + cell;
    const Vec3 low = *first;
    for (auto p = first; p != first + 8; ++p) {
      EXPECT_LE((*p - low).maxCoeff(), 1) << "eight points in a row fill a cell of 2 x 2 x 2";
      EXPECT_GE((*p - low).minCoeff(), 0);
    }
  }
}

TEST(PointSet, StoredPositionsAreFixedPointsOfStoring) {
  const std::vector<Vec3> offsets = {{0, 0, 0}, {0.1, 0.2, 0.3}, {5e5, 4e6, 100}};
  for (const Vec3& offset : offsets) {
    for (const StoredAs type : {StoredAs::Float, StoredAs::Double}) {
      Points world = randomCloud(500, 9);
      for (Vec3& p : world) p = asFloats(p + offset);
      const PointSet set = makeSet(world, type);
      for (const Vec3& p : set.position) ASSERT_EQ(set.stored(p), p);
    }
  }
}

TEST(PointSet, StoringRoundsWorldCoordinatesToFloats) {
  const PointSet set = makeSet({{1000, 0, 0}, {1001, 0, 0}, {1000, 1, 0}});
  const Vec3 local(0.123456789123, 0.2, 0.3);
  EXPECT_EQ(set.world(set.stored(local)), asFloats(set.world(local)));
  EXPECT_NE(set.stored(local), local);
}

TEST(PointSet, KeepsDoublesApartThatFloatsCannotTell) {
  const Points utm = {
      {500000.001, 4000000.001, 0}, {500000.002, 4000000.001, 0}, {500000.001, 4000000.002, 0}};
  const PointSet set = makeSet(utm, StoredAs::Double);
  EXPECT_EQ(set.size(), 3);
  EXPECT_LT(set.position[0].norm(), 1) << "the origin is near the cloud";
  for (Index i = 0; i < 3; ++i) EXPECT_EQ(set.world(set.position[i]), utm[set.source[i]]);
}

TEST(PointSet, OriginIsAFloat) {
  const Vec3 low = asFloats({1e-5, 0.3, 7.1}), high = asFloats({0.9, 1.7, 123.4});
  ASSERT_NE(0.5 * (low + high), asFloats(0.5 * (low + high)));
  const PointSet set = makeSet({low, high, {low.x(), high.y(), low.z()}});
  EXPECT_EQ(set.origin, asFloats(set.origin));
  EXPECT_LT((set.origin - 0.5 * (low + high)).norm(), 1e-5) << "and near the centre of the bounding box";
}

TEST(PointSet, TakesTheWholeRangeOfFloats) {
  const PointSet set = makeSet({{3e38, 0, 0}, {-3e38, 0, 0}, {0, 3e38, 0}, {0, 0, -3e38}, {1, 1, 1}});
  EXPECT_EQ(set.size(), 5);
  for (const Vec3& p : set.position) EXPECT_TRUE(p.allFinite());
}

TEST(PointSet, CountsWhatDoesNotFitTheStoredTypeAsNonFinite) {
  const Points world = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1e39, 0, 0}, {0, 0, -1e39}};
  EXPECT_EQ(makeSet(world, StoredAs::Float).non_finite, 2);
  EXPECT_EQ(makeSet(world, StoredAs::Double).non_finite, 0);
}

TEST(PointSetIndices, ChooseThePointsThatTakePart) {
  const Points world = randomCloud(50, 4);
  const std::vector<Index> indices = {7, 3, 41, 3, 12, 7};
  const PointSet set = makeSet(world, StoredAs::Float, &indices);
  std::vector<Index> source = set.source;
  std::sort(source.begin(), source.end());
  EXPECT_EQ(source, (std::vector<Index>{3, 7, 12, 41}));
  EXPECT_EQ(set.duplicates, 2);
  EXPECT_EQ(set.duplicates_of.items.size(), 4u) << "an index that is repeated is one input point";
}

TEST(PointSetIndices, AreRefusedWhenTheCloudDoesNotHaveThem) {
  const Points world = randomCloud(10, 4);
  for (const Index wrong : {-1, 10, 1000000}) {
    const std::vector<Index> indices = {0, 1, wrong};
    const auto [code, text] = refusal(world, StoredAs::Float, &indices);
    EXPECT_EQ(code, StatusCode::InvalidIndices);
    EXPECT_NE(text.find("indices[2] is " + std::to_string(wrong)), std::string::npos) << text;
  }
  const std::vector<Index> none;
  EXPECT_EQ(refusal(world, StoredAs::Float, &none).first, StatusCode::EmptyInput);
}

TEST(PointSetRefuses, EmptyAndTinyClouds) {
  EXPECT_EQ(refusal({}).first, StatusCode::EmptyInput);
  EXPECT_EQ(refusal({{0, 0, 0}}).first, StatusCode::TooFewPoints);
  EXPECT_EQ(refusal({{0, 0, 0}, {1, 0, 0}}).first, StatusCode::TooFewPoints);
  EXPECT_EQ(refusal(Points(100, Vec3(1, 2, 3))).first, StatusCode::TooFewPoints);
  EXPECT_EQ(refusal(Points(5, Vec3(kNan, 2, 3))).first, StatusCode::TooFewPoints);
  const auto text = refusal({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {kNan, 0, 0}}).second;
  EXPECT_EQ(text, "of 4 points 1 are not finite and 1 are duplicates; 2 remain, but a surface needs 3");
}

/// Points of `cloud`, scaled and rounded to the type they are stored in.
Points scaled(Points cloud, double scale, StoredAs type) {
  for (Vec3& p : cloud) {
    p *= scale;
    if (type == StoredAs::Float) p = asFloats(p);
  }
  return cloud;
}

TEST(PointSetRefuses, LinesAtAnyScaleInAnyDirection) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> parameter(-1, 1);
  for (const Vec3& direction : {Vec3(1, 0, 0), Vec3(0, 0, 1), Vec3(0.3, -0.5, 0.7), Vec3(1, 1e-4, -1e-3)}) {
    Points line;
    for (int i = 0; i < 300; ++i) line.push_back(Vec3(0.1, 0.2, -0.1) + parameter(random) * direction);
    for (const double scale : {1e-30, 1e-10, 1.0, 1e10, 1e30})
      for (const StoredAs type : {StoredAs::Float, StoredAs::Double})
        EXPECT_EQ(refusal(scaled(line, scale, type), type).first, StatusCode::DegenerateInput) << scale;
  }
}

TEST(PointSetRefuses, NoSurfaceAtAnyScale) {
  Points strip;
  for (int i = 0; i < 100; ++i) strip.emplace_back(i, i % 2 == 0 ? 1e-3 : 0, 0.5 * i);
  Points one_beside = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {2, 1e-5, 0}};
  for (const Points& cloud : {strip, one_beside, randomCloud(50, 1)})
    for (const double scale : {1e-30, 1.0, 1e30})
      for (const StoredAs type : {StoredAs::Float, StoredAs::Double})
        EXPECT_EQ(refusal(scaled(cloud, scale, type), type).second, "");
}

TEST(PointSetRefuses, ExtentsThatDoublesCannotWorkWith) {
  for (const double scale : {1e-60, 1e60, 1e300})
    EXPECT_EQ(refusal(scaled(randomCloud(50, 1), scale, StoredAs::Double), StoredAs::Double).first,
              StatusCode::DegenerateInput);
}

TEST(PointSetRefuses, ToGoOnWhenCancelled) {
  Context context;
  context.progress.cancel();
  EXPECT_THROW(makePointSet(randomCloud(100, 1), StoredAs::Float, nullptr, context), Failure);
}

}  // namespace
}  // namespace mlsmesh::core
