// SPDX-License-Identifier: BSD-3-Clause
#include "clouds/random_clouds.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace mlsmesh::test {

using core::StoredAs;
using core::Vec3;
using shapes::Random;

namespace {

using Points = std::vector<Vec3>;

bool chance(Random& random, double probability) {
  return random.uniform() < probability;
}

double powerOfTen(Random& random, double low, double high) {
  return std::pow(10.0, random.uniform(low, high));
}

// Most parameters stay as they are: that is what users run.
MultiresolutionParameters drawParameters(Random& random, std::ostream& description) {
  static constexpr const char* kPresets[] = {"default", "default", "paper", "printed"};
  const std::size_t preset = random.index(4);
  MultiresolutionParameters parameters = preset < 2    ? defaultPreset()
                                         : preset == 2 ? paperPreset()
                                                       : printedPreset();
  parameters.reduce = !chance(random, 0.25);
  parameters.watertight = chance(random, 0.15);
  if (chance(random, 0.1)) parameters.hole_size = powerOfTen(random, 0, 3);
  parameters.refinement.levels = static_cast<int>(random.index(4));
  description << ", " << kPresets[preset] << (parameters.reduce ? "" : ", not reduced")
              << (parameters.watertight ? ", watertight" : "") << ", " << parameters.refinement.levels
              << " refinements";
  if (parameters.hole_size > 0) description << ", hole size " << parameters.hole_size;
  return parameters;
}

void turn(Points& points, Random& random) {
  const Eigen::Matrix3d rotation =
      Eigen::AngleAxisd(random.uniform(0, 6.3), random.direction()).toRotationMatrix();
  for (Vec3& p : points) p = rotation * p;
}

// Lattices and the like stay along the axes in two of three clouds.
void place(Points& points, Random& random, std::ostream& description) {
  if (chance(random, 0.1)) {
    const Vec3 stretch(powerOfTen(random, -6, 0), powerOfTen(random, -3, 0), 1);
    for (Vec3& p : points) p = p.cwiseProduct(stretch);
    description << ", stretched";
  }
  if (chance(random, 1.0 / 3)) {
    turn(points, random);
    description << ", turned";
  }
  if (chance(random, 0.3)) {
    const double scale = powerOfTen(random, -12, 12);
    for (Vec3& p : points) p *= scale;
    description << ", times " << scale;
  }
  if (chance(random, 0.1)) {
    double extent = 0;
    for (const Vec3& p : points) extent = std::max(extent, p.cwiseAbs().maxCoeff());
    const Vec3 shift = random.direction() * extent * powerOfTen(random, 0, 7);
    for (Vec3& p : points) p += shift;
    description << ", far from the origin";
  }
}

void repeatSome(Points& points, Random& random, std::ostream& description) {
  if (!chance(random, 0.1)) return;
  const std::size_t count = points.size();
  for (std::size_t i = 0; i < count / 2; ++i) points.push_back(points[random.index(count)]);
  description << ", repeated";
}

}  // namespace

RandomCloud drawCloud(std::uint64_t seed, std::size_t most) {
  Random random(seed);
  RandomCloud cloud;
  std::ostringstream description;
  description << std::setprecision(3);
  const CloudKind& kind = cloudKinds()[random.index(cloudKinds().size())];
  const double largest = std::log10(static_cast<double>(most));
  const auto count = static_cast<std::size_t>(powerOfTen(random, std::log10(3.0), largest));
  cloud.kind = kind.name;
  cloud.points = kind.draw(count, random);
  place(cloud.points, random, description);
  repeatSome(cloud.points, random, description);
  if (chance(random, 0.3)) cloud.stored_as = StoredAs::Double;
  description << (cloud.stored_as == StoredAs::Double ? ", doubles" : "");
  cloud.parameters = drawParameters(random, description);
  cloud.description =
      std::string(kind.name) + ", " + std::to_string(cloud.points.size()) + " points" + description.str();
  return cloud;
}

}  // namespace mlsmesh::test
