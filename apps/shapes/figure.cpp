// SPDX-License-Identifier: BSD-3-Clause
#include "shapes/figure.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mlsmesh::shapes {
namespace {

constexpr int kGridDepth = 6;
constexpr int kMaxSteps = 200;

const Vec3 kSkin(0.47, 0.55, 0.66);
const Vec3 kBelly(0.62, 0.68, 0.75);
const Vec3 kEar(0.87, 0.60, 0.60);
const Vec3 kIvory(0.97, 0.93, 0.80);
const Vec3 kTip(0.80, 0.55, 0.55);
const Vec3 kSole(0.78, 0.72, 0.70);
const Vec3 kEye(0.10, 0.10, 0.14);

void addTube(Solid& solid, const std::vector<Tube::Ball>& control, double blend, const Vec3& color) {
  solid.add(std::make_unique<Tube>(control), blend, color);
}

void addBody(Solid& solid) {
  solid.add(std::make_unique<Ellipsoid>(Vec3(-0.02, 0.42, 0.0), Vec3(0.56, 0.56, 0.52)), 0.1, kSkin);
  solid.add(std::make_unique<Ellipsoid>(Vec3(0.14, 0.40, 0.0), Vec3(0.43, 0.42, 0.40)), 0.10, kBelly);
  addTube(solid, {{{0.0, 0.75, 0.0}, 0.36}, {{0.12, 0.95, 0.0}, 0.33}, {{0.30, 1.15, 0.0}, 0.30}}, 0.15,
          kSkin);
  solid.add(std::make_unique<Ellipsoid>(Vec3(0.42, 1.24, 0.0), Vec3(0.38, 0.37, 0.34)), 0.14, kSkin);
}

void addTrunkAndTail(Solid& solid) {
  addTube(solid,
          {{{0.66, 1.20, 0.0}, 0.19},
           {{0.86, 1.02, 0.0}, 0.155},
           {{1.00, 0.76, 0.0}, 0.125},
           {{1.22, 0.66, 0.0}, 0.105},
           {{1.42, 0.84, 0.0}, 0.09},
           {{1.44, 1.10, 0.0}, 0.08},
           {{1.56, 1.30, 0.0}, 0.075}},
          0.12, kSkin);
  addTube(solid, {{{1.53, 1.25, 0.0}, 0.072}, {{1.58, 1.315, 0.0}, 0.085}}, 0.05, kTip);
  addTube(solid,
          {{{-0.42, 0.28, 0.0}, 0.10},
           {{-0.72, 0.26, 0.0}, 0.075},
           {{-1.02, 0.50, 0.0}, 0.06},
           {{-1.02, 0.92, 0.0}, 0.055},
           {{-0.66, 1.12, 0.0}, 0.06},
           {{-0.28, 1.00, 0.0}, 0.085},
           {{0.0, 0.86, 0.0}, 0.10}},
          0.10, kSkin);
}

/// `side` is -1 or 1.
void addSide(Solid& solid, double side) {
  const auto place = [side](double x, double y, double z) { return Vec3(x, y, side * z); };
  const Vec3 ear_axis = place(-0.62, 0.10, 0.55).normalized();
  solid.add(std::make_unique<Dish>(place(0.25, 1.30, 0.60) - 0.62 * ear_axis, ear_axis, 0.62, 0.66, 0.035),
            0.07, kEar);
  addTube(solid,
          {{place(0.60, 1.05, 0.18), 0.06},
           {place(0.80, 0.90, 0.31), 0.052},
           {place(1.00, 0.88, 0.40), 0.042},
           {place(1.14, 0.99, 0.42), 0.032}},
          0.05, kIvory);
  solid.add(std::make_unique<Ellipsoid>(place(0.66, 1.36, 0.215), Vec3(0.055, 0.06, 0.055)), 0.025, kEye);
  addTube(solid,
          {{place(0.12, 0.86, 0.24), 0.15},
           {place(0.32, 0.76, 0.40), 0.14},
           {place(0.54, 0.64, 0.44), 0.12},
           {place(0.74, 0.66, 0.42), 0.13}},
          0.09, kSkin);
  addTube(solid,
          {{place(0.05, 0.25, 0.34), 0.21}, {place(0.34, 0.23, 0.45), 0.18}, {place(0.62, 0.22, 0.47), 0.15}},
          0.10, kSkin);
  addTube(solid, {{place(0.68, 0.20, 0.47), 0.14}, {place(0.72, 0.27, 0.47), 0.16}}, 0.06, kSole);
}

Solid makeElephant() {
  Solid solid;
  addBody(solid);
  addTrunkAndTail(solid);
  addSide(solid, -1.0);
  addSide(solid, 1.0);
  return solid;
}

/// One step from y towards the point of the zero set nearest to x: on the tangent plane at y, whatever is
/// left of the way to x, and back to the surface. In the plane y = 0 when `on_base`.
Vec3 closestStep(const Solid& solid, const Vec3& x, const Vec3& y, bool on_base) {
  const FieldValue f = solid.at(y);
  Vec3 gradient = f.gradient;
  Vec3 way = x - y;
  if (on_base) gradient.y() = way.y() = 0.0;
  const double squared_length = std::max(gradient.squaredNorm(), 1e-12);
  way -= gradient * (gradient.dot(way) / squared_length);
  return way - gradient * (f.value / squared_length);
}

Vec3 project(const Solid& solid, const Vec3& x, Vec3 start, bool on_base) {
  for (int i = 0; i < kMaxSteps; ++i) {
    // Half steps, where whole ones swing about the goal, still come nearer to it.
    const Vec3 step = (i < kMaxSteps / 4 ? 1.0 : 0.5) * closestStep(solid, x, start, on_base);
    start += step;
    if (on_base) start.y() = 0.0;
    if (step.norm() < 1e-14) break;
  }
  return start;
}

}  // namespace

Figure::Figure()
    : solid_(makeElephant()),
      box_(Vec3(-1.07, 0.0, -0.84), Vec3(1.67, 1.70, 0.84)),
      sampler_(
          [this](const Vec3& x) {
            const FieldValue f = solid_.at(x);
            return ValueAndGradient{f.value, f.gradient};
          },
          box_, kGridDepth) {}

std::vector<Vec3> Figure::sample(std::size_t count, Random& random) const {
  std::vector<Vec3> points;
  points.reserve(count + 8);
  while (points.size() < count) sampler_.appendCrossings(random, points);
  points.resize(count);
  return points;
}

Vec3 Figure::closestPoint(const Vec3& x) const {
  Vec3 free = project(solid_, x, x, false);
  if (free.y() >= 0.0) return free;
  return project(solid_, x, {free.x(), 0.0, free.z()}, true);
}

double Figure::distanceBound(const Vec3& x) const {
  return std::max(std::abs(implicitValue(x)), -x.y());
}

}  // namespace mlsmesh::shapes
