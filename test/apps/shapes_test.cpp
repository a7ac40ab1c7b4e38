// SPDX-License-Identifier: BSD-3-Clause
#include "shapes/figure.h"
#include "shapes/line_sampling.h"
#include "shapes/scan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <queue>
#include <string>
#include <vector>

namespace mlsmesh::shapes {
namespace {

constexpr double kPi = 3.141592653589793;

class EveryShape : public testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<Shape> shape_ = makeShape(GetParam());
  Random random_{7};
};

TEST_P(EveryShape, SamplesLieOnTheSurfaceWithinItsBox) {
  const std::vector<Vec3> points = shape_->sample(3000, random_);
  ASSERT_EQ(points.size(), 3000U);
  Eigen::AlignedBox3d seen;
  for (const Vec3& point : points) {
    EXPECT_LT(shape_->distance(point), 1e-9);
    EXPECT_TRUE(shape_->box().contains(point));
    seen.extend(point);
  }
  // 3000 points reach within a few spacings of every side.
  EXPECT_GT(seen.diagonal().norm(), 0.95 * shape_->diagonal());
}

TEST_P(EveryShape, PointsOffTheSurfaceComeBackAlongTheNormal) {
  const double offset = 0.002 * shape_->diagonal();
  int inside = 0;
  for (const Vec3& point : shape_->sample(500, random_)) {
    if (shape_->borderDistanceBound(point) < 2.0 * offset) continue;
    const Vec3 normal = shape_->normal(point);
    EXPECT_NEAR(normal.norm(), 1.0, 1e-12);
    EXPECT_LT((shape_->closestPoint(point + offset * normal) - point).norm(), 1e-6);
    EXPECT_LT((shape_->closestPoint(point - offset * normal) - point).norm(), 1e-6);
    EXPECT_LE(shape_->distanceBound(point + offset * normal), offset * (1.0 + 1e-9));
    ++inside;
  }
  EXPECT_GT(inside, 400);
}

TEST_P(EveryShape, OneSeedOneScan) {
  ScanOptions options;
  options.count = 300;
  options.noise = 0.001;
  options.outliers = 0.05;
  options.density_ratio = 3.0;
  options.views = 3;
  const Scan first = scan(*shape_, options);
  EXPECT_EQ(first.points, scan(*shape_, options).points);
  EXPECT_EQ(first.points.size(), 315U);
  EXPECT_EQ(std::count(first.is_outlier.begin(), first.is_outlier.end(), true), 15);
  options.seed = 2;
  EXPECT_NE(first.points, scan(*shape_, options).points);
}

INSTANTIATE_TEST_SUITE_P(Shapes, EveryShape, testing::ValuesIn(shapeNames()));

TEST(Shapes, UnknownNameGivesNone) {
  EXPECT_EQ(makeShape("teapot"), nullptr);
}

/// Share of the points for which `condition` holds.
template <typename Condition>
double share(const std::vector<Vec3>& points, Condition condition) {
  return static_cast<double>(std::count_if(points.begin(), points.end(), condition)) /
         static_cast<double>(points.size());
}

TEST(Sampling, IsUniformByArea) {
  // Shares of area follow from integrals; 40000 points leave a standard deviation of 0.0025 at most.
  Random random(3);
  const auto sphere = makeShape("sphere")->sample(40000, random);
  EXPECT_NEAR(share(sphere, [](const Vec3& p) { return p.z() > 0.5; }), 0.25, 0.01);
  const auto torus = makeShape("torus")->sample(40000, random);
  EXPECT_NEAR(share(torus, [](const Vec3& p) { return std::hypot(p.x(), p.y()) > 1.0; }), 0.5 + 0.4 / kPi,
              0.01);
  const auto cylinder = makeShape("cylinder")->sample(40000, random);
  EXPECT_NEAR(share(cylinder, [](const Vec3& p) { return p.y() > 0.5 && p.x() > 0.0; }), 0.125, 0.01);
}

TEST(Sampling, OfLinesIsUniformByArea) {
  // On a sphere every coordinate is uniform (Archimedes), so its mean square is 1/3 and each slab has its
  // share.
  const LineSampler sampler(
      [](const Vec3& x) {
        return ValueAndGradient{x.norm() - 0.8, x.normalized()};
      },
      Eigen::AlignedBox3d(Vec3::Constant(-1.0), Vec3::Constant(1.0)), 4);
  Random random(5);
  std::vector<Vec3> points;
  while (points.size() < 40000) sampler.appendCrossings(random, points);
  for (const Vec3& point : points) ASSERT_NEAR(point.norm(), 0.8, 1e-12);
  for (int axis = 0; axis < 3; ++axis) {
    for (double low = -0.8; low < 0.79; low += 0.4) {
      EXPECT_NEAR(share(points, [&](const Vec3& p) { return p[axis] >= low && p[axis] < low + 0.4; }), 0.25,
                  0.012);
    }
  }
}

TEST(Scan, NoiseHasTheSpreadAskedFor) {
  const auto sphere = makeShape("sphere");
  ScanOptions options;
  options.count = 20000;
  options.noise = 0.01;
  const Scan result = scan(*sphere, options);
  const double sigma = options.noise * sphere->diagonal();
  for (int axis = 0; axis < 3; ++axis) {
    double sum = 0.0;
    double squares = 0.0;
    for (std::size_t i = 0; i < result.points.size(); ++i) {
      const double error = result.points[i][axis] - result.surface_points[i][axis];
      sum += error;
      squares += error * error;
    }
    EXPECT_NEAR(sum / 20000, 0.0, 0.03 * sigma);
    EXPECT_NEAR(std::sqrt(squares / 20000), sigma, 0.02 * sigma);
  }
}

TEST(Scan, OutliersLeaveTheSurface) {
  const auto torus = makeShape("torus");
  ScanOptions options;
  options.count = 1000;
  options.outliers = 0.2;
  const Scan result = scan(*torus, options);
  ASSERT_EQ(result.points.size(), 1200U);
  double farthest = 0.0;
  for (std::size_t i = 0; i < result.points.size(); ++i) {
    if (result.is_outlier[i])
      farthest = std::max(farthest, torus->distance(result.points[i]));
    else
      EXPECT_LT(torus->distance(result.points[i]), 1e-12);
  }
  EXPECT_GT(farthest, 0.3);
  // At random places of the list, not all at its end.
  EXPECT_GT(std::count(result.is_outlier.begin(), result.is_outlier.begin() + 600, true), 60);
}

TEST(Scan, DensityFallsByTheRatio) {
  ScanOptions options;
  options.count = 40000;
  options.density_ratio = 10.0;
  const Scan result = scan(*makeShape("cylinder"), options);
  // Exponential over the height: the share of the lower half is 1 / (1 + 10^-1/2).
  EXPECT_NEAR(share(result.points, [](const Vec3& p) { return p.y() < 0.0; }), 1.0 / (1.0 + std::sqrt(0.1)),
              0.01);
}

TEST(Scan, OneViewDropsTheBackOfASphere) {
  const auto sphere = makeShape("sphere");
  ScanOptions options;
  options.count = 2000;
  options.views = 1;
  const Vec3 scanner = scannerPositions(*sphere, 1).front();
  for (const Vec3& point : scan(*sphere, options).points) EXPECT_GT((scanner - point).dot(point), 0.0);
}

TEST(Scan, AllAroundSeesMostOfASphere) {
  const auto sphere = makeShape("sphere");
  const std::vector<Vec3> scanners = scannerPositions(*sphere, 12);
  Random random(1);
  const double seen = share(sphere->sample(2000, random), [&](const Vec3& point) {
    return std::any_of(scanners.begin(), scanners.end(),
                       [&](const Vec3& from) { return isSeen(*sphere, point, from); });
  });
  EXPECT_EQ(seen, 1.0);
}

TEST(Scan, ASurfaceHidesWhatIsBehindIt) {
  const auto torus = makeShape("torus");
  const Vec3 from(10.0, 0.0, 0.0);
  EXPECT_TRUE(isSeen(*torus, {1.4, 0.0, 0.0}, from));
  EXPECT_FALSE(isSeen(*torus, {0.6, 0.0, 0.0}, from)) << "on the back of the near side";
  EXPECT_FALSE(isSeen(*torus, {-0.6, 0.0, 0.0}, from)) << "faces the scanner, but behind the near side";
  EXPECT_TRUE(isSeen(*torus, {-0.6, 0.0, 0.0}, {6.0, 0.0, 6.0})) << "over the near side";
  const auto cylinder = makeShape("cylinder");
  EXPECT_FALSE(isSeen(*cylinder, {-0.6, 0.0, 0.0}, {10.0, 0.0, 0.0})) << "inside, through the wall";
  EXPECT_TRUE(isSeen(*cylinder, {-0.6, 0.5, 0.0}, {2.0, 3.0, 0.0})) << "inside, through the open end";
}

/// The cells of a grid in which a solid is, as a complex of cubes.
class CubeComplex {
 public:
  CubeComplex(const Figure& figure, double step) {
    const Vec3 low = figure.box().min() - Vec3(2.0 * step, -0.5 * step, 2.0 * step);
    const Vec3 sizes = figure.box().max() - low;
    for (int axis = 0; axis < 3; ++axis) size_[axis] = static_cast<int>(sizes[axis] / step) + 4;
    inside_.resize(static_cast<std::size_t>(size_[0]) * size_[1] * size_[2]);
    for (int z = 0; z < size_[2]; ++z) {
      for (int y = 0; y < size_[1]; ++y) {
        for (int x = 0; x < size_[0]; ++x) {
          inside_[index(x, y, z)] = figure.implicitValue(low + step * Vec3(x, y, z)) < 0.0;
        }
      }
    }
  }

  /// V - E + F - C over the cubes of the layers y < `layers`.
  int euler(int layers) const {
    int sum = 0;
    for (int z = 0; z <= size_[2]; ++z) {
      for (int y = 0; y <= std::min(layers, size_[1]); ++y) {
        for (int x = 0; x <= size_[0]; ++x) sum += eulerOfCellsAt(x, y, z, layers);
      }
    }
    return sum;
  }

  int layers() const { return size_[1]; }

 private:
  std::size_t index(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * size_[1] + y) * size_[0] + x;
  }
  bool isInside(int x, int y, int z, int layers) const {
    return x >= 0 && y >= 0 && z >= 0 && x < size_[0] && y < std::min(layers, size_[1]) && z < size_[2] &&
           inside_[index(x, y, z)];
  }
  /// Whether a cube has the cell whose lowest corner is (x, y, z) and which extends along the axes in the
  /// bits of `extent`.
  bool hasCell(int x, int y, int z, int extent, int layers) const {
    for (int neighbor = 0; neighbor < 8; ++neighbor) {
      if ((neighbor & extent) != 0) continue;
      if (isInside(x - (neighbor & 1), y - ((neighbor >> 1) & 1), z - ((neighbor >> 2) & 1), layers))
        return true;
    }
    return false;
  }
  int eulerOfCellsAt(int x, int y, int z, int layers) const {
    int sum = 0;
    for (int extent = 0; extent < 8; ++extent) {
      const int dimension = (extent & 1) + ((extent >> 1) & 1) + ((extent >> 2) & 1);
      if (hasCell(x, y, z, extent, layers)) sum += dimension % 2 == 0 ? 1 : -1;
    }
    return sum;
  }

  std::array<int, 3> size_{};
  std::vector<bool> inside_;
};

TEST(Figure, HasTheTopologyItNames) {
  // A solid with one handle has Euler number 0; its foot is one disc, of Euler number 1. The surface without
  // the foot then has 2 * 0 - 1.
  const Figure figure;
  const CubeComplex cubes(figure, 0.02);
  EXPECT_EQ(cubes.euler(cubes.layers()), 0);
  EXPECT_EQ(cubes.euler(1), 1);
  EXPECT_EQ(figure.topology().euler, -1);
  EXPECT_EQ(figure.topology().border_loops, 1);
}

TEST(Figure, IsOpenWhereItStands) {
  const Figure figure;
  Random random(11);
  const std::vector<Vec3> points = figure.sample(5000, random);
  EXPECT_GT(share(points, [](const Vec3& p) { return p.y() < 0.05; }), 0.0);
  for (const Vec3& point : points) {
    EXPECT_GE(point.y(), 0.0);
    EXPECT_NEAR(figure.implicitValue(point), 0.0, 1e-12);
  }
  EXPECT_EQ(figure.closestPoint({0.0, -0.5, 0.0}).y(), 0.0);
}

TEST(Figure, FieldIsLipschitzAndItsGradientRight) {
  const Figure figure;
  Random random(13);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 x(random.uniform(-1.2, 1.8), random.uniform(-0.1, 1.8), random.uniform(-1.0, 1.0));
    const Vec3 y = x + random.uniform(0.0, 0.3) * random.direction();
    EXPECT_LE(std::abs(figure.implicitValue(x) - figure.implicitValue(y)), (x - y).norm() * (1.0 + 1e-6));
  }
  for (const Vec3& x : figure.sample(300, random)) {
    const Vec3 step = 1e-5 * figure.normal(x);
    EXPECT_GT(figure.implicitValue(x + step), 0.0) << "the normal points outwards";
    const Vec3 across = figure.normal(x).unitOrthogonal();
    EXPECT_NEAR((figure.implicitValue(x + 1e-6 * across) - figure.implicitValue(x - 1e-6 * across)) / 2e-6,
                0.0, 1e-3);
  }
}

}  // namespace
}  // namespace mlsmesh::shapes
