// SPDX-License-Identifier: BSD-3-Clause
// This work is based on: I. Quilez, "Smooth minimum" and "Distance functions" (iquilezles.org, 2008 - 2013).
#include "shapes/field.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mlsmesh::shapes {
namespace {

constexpr int kSamplesPerSpan = 4;
constexpr int kMaxNewtonSteps = 60;

Vec3 unitOr(const Vec3& v, const Vec3& otherwise) {
  const double length = v.norm();
  return length > 0.0 ? Vec3(v / length) : otherwise;
}

Tube::Ball operator*(double factor, const Tube::Ball& ball) {
  return {factor * ball.center, factor * ball.radius};
}

Tube::Ball operator+(const Tube::Ball& a, const Tube::Ball& b) {
  return {a.center + b.center, a.radius + b.radius};
}

Tube::Ball combine(const Tube::Ball* control, const std::array<double, 4>& weights) {
  return weights[0] * control[0] + weights[1] * control[1] + weights[2] * control[2] +
         weights[3] * control[3];
}

/// Smooth minimum of two fields; the gradient's weights are in 0 .. 1 and sum to 1.
FieldValue smoothUnion(const FieldValue& a, const FieldValue& b, double blend) {
  const bool a_is_less = a.value < b.value;
  const FieldValue& less = a_is_less ? a : b;
  const FieldValue& more = a_is_less ? b : a;
  const double overlap = std::max(blend - (more.value - less.value), 0.0) / blend;
  const double share = 0.5 * overlap * overlap;
  FieldValue joined;
  joined.value = less.value - overlap * overlap * overlap * blend / 6.0;
  joined.gradient = (1.0 - share) * less.gradient + share * more.gradient;
  joined.color = (1.0 - share) * less.color + share * more.color;
  return joined;
}

}  // namespace

FieldValue Ellipsoid::at(const Vec3& x) const {
  const Vec3 scaled = (x - center_).cwiseQuotient(radii_);
  const double length = scaled.norm();
  const double scale = radii_.minCoeff();
  const Vec3 direction = unitOr(scaled, Vec3::UnitY());
  return {(length - 1.0) * scale, scale * direction.cwiseQuotient(radii_), Vec3::Zero()};
}

double Ellipsoid::lowerBound(const Vec3& x) const {
  return ((x - center_).norm() / radii_.maxCoeff() - 1.0) * radii_.minCoeff();
}

Dish::Dish(const Vec3& center, const Vec3& axis, double radius, double opening, double half_thickness)
    : center_(center),
      axis_(axis.normalized()),
      radius_(radius),
      cos_opening_(std::cos(opening)),
      sin_opening_(std::sin(opening)),
      half_thickness_(half_thickness) {}

Vec3 Dish::nearestOfCap(const Vec3& x) const {
  const Vec3 direction = unitOr(x - center_, axis_);
  const double cosine = direction.dot(axis_);
  if (cosine >= cos_opening_) return center_ + radius_ * direction;
  const Vec3 across = unitOr(direction - cosine * axis_, axis_.unitOrthogonal());
  return center_ + radius_ * (cos_opening_ * axis_ + sin_opening_ * across);
}

FieldValue Dish::at(const Vec3& x) const {
  const Vec3 offset = x - nearestOfCap(x);
  return {offset.norm() - half_thickness_, unitOr(offset, axis_), Vec3::Zero()};
}

double Dish::lowerBound(const Vec3& x) const {
  const Vec3 middle = center_ + radius_ * cos_opening_ * axis_;
  return (x - middle).norm() - radius_ * std::max(sin_opening_, 1.0 - cos_opening_) - half_thickness_;
}

Tube::Tube(const std::vector<Ball>& control) {
  const std::size_t n = control.size();
  control_.push_back(2.0 * control[0] + -1.0 * control[1]);
  control_.insert(control_.end(), control.begin(), control.end());
  control_.push_back(2.0 * control[n - 1] + -1.0 * control[n - 2]);
  const int samples = static_cast<int>(n - 1) * kSamplesPerSpan;
  for (int i = 0; i <= samples; ++i) {
    samples_.push_back(jet(static_cast<double>(i) / kSamplesPerSpan).ball);
  }
  max_radius_ = 0.0;
  for (const Ball& ball : control_) {
    box_.extend(Eigen::AlignedBox3d(ball.center.array() - ball.radius, ball.center.array() + ball.radius));
    max_radius_ = std::max(max_radius_, ball.radius);
  }
}

Tube::Jet Tube::jet(double t) const {
  const auto last_span = static_cast<double>(control_.size() - 4);
  const double span = std::clamp(std::floor(t), 0.0, last_span);
  const double s = t - span;
  const double r = 1.0 - s;
  const Ball* control = control_.data() + static_cast<std::size_t>(span);
  Jet place;
  place.ball = combine(control, {r * r * r / 6.0, (3.0 * s * s * s - 6.0 * s * s + 4.0) / 6.0,
                                 (3.0 * r * r * r - 6.0 * r * r + 4.0) / 6.0, s * s * s / 6.0});
  place.first = combine(control, {-0.5 * r * r, 1.5 * s * s - 2.0 * s, -1.5 * r * r + 2.0 * r, 0.5 * s * s});
  place.second = combine(control, {r, 3.0 * s - 2.0, 3.0 * r - 2.0, s});
  return place;
}

double Tube::nearestBall(const Vec3& x) const {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    const double distance = (x - samples_[i].center).norm() - samples_[i].radius;
    if (distance >= least) continue;
    least = distance;
    best = i;
  }
  const double low = best == 0 ? 0.0 : static_cast<double>(best - 1) / kSamplesPerSpan;
  const double high = static_cast<double>(std::min(best + 1, samples_.size() - 1)) / kSamplesPerSpan;
  return refine(x, low, high, static_cast<double>(best) / kSamplesPerSpan);
}

double Tube::refine(const Vec3& x, double low, double high, double t) const {
  // Newton's method for the root of the derivative of |x - c(t)| - r(t), kept within a shrinking bracket.
  for (int i = 0; i < kMaxNewtonSteps; ++i) {
    const Jet place = jet(t);
    const Vec3 offset = x - place.ball.center;
    const double distance = std::max(offset.norm(), 1e-12);
    const double along = offset.dot(place.first.center);
    const double slope = -along / distance - place.first.radius;
    const double bend = (place.first.center.squaredNorm() - offset.dot(place.second.center)) / distance -
                        along * along / (distance * distance * distance) - place.second.radius;
    (slope > 0.0 ? high : low) = t;
    double next = t - slope / bend;
    if (!(next >= low && next <= high)) next = 0.5 * (low + high);
    const bool converged = std::abs(next - t) < 1e-13;
    t = next;
    if (converged) break;
  }
  return t;
}

FieldValue Tube::at(const Vec3& x) const {
  const Ball ball = jet(nearestBall(x)).ball;
  const Vec3 offset = x - ball.center;
  return {offset.norm() - ball.radius, unitOr(offset, Vec3::UnitY()), Vec3::Zero()};
}

double Tube::lowerBound(const Vec3& x) const {
  return box_.contains(x) ? -max_radius_ : box_.exteriorDistance(x);
}

void Solid::add(std::unique_ptr<Part> part, double blend, const Vec3& color) {
  members_.push_back({std::move(part), blend, color});
}

FieldValue Solid::at(const Vec3& x) const {
  FieldValue joined{std::numeric_limits<double>::infinity(), Vec3::Zero(), Vec3::Zero()};
  for (const Member& member : members_) {
    if (member.part->lowerBound(x) > joined.value + member.blend) continue;
    FieldValue next = member.part->at(x);
    next.color = member.color;
    joined = std::isinf(joined.value) ? next : smoothUnion(joined, next, member.blend);
  }
  return joined;
}

}  // namespace mlsmesh::shapes
