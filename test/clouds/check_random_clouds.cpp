// SPDX-License-Identifier: BSD-3-Clause
// mlsmesh_random_clouds [COUNT [SEED [MOST]]]: reconstructs COUNT (1000) clouds of all kinds, of up to MOST
// (2000) points, drawn from SEED, SEED + 1, ... (1); each must end in a refusal that it may deserve or in
// levels that keep every promise, and within kSlower times what a clean surface of its size takes. Prints a
// table by kind, and what each violation was. Exit code 1 if there is one.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <tuple>

#include "clouds/random_clouds.h"
#include "clouds/soundness.h"
#include "shapes/shape.h"

namespace {

using namespace mlsmesh;

constexpr double kSlower = 50;   // points all about no surface are denoised at some 20 times the cost
constexpr double kAlways = 0.1;  // seconds that any cloud may take

struct Tally {
  int clouds = 0, refused = 0, crossing = 0, violations = 0;
  double slowest = 0;  // over the time of a clean surface
  std::uint64_t slowest_seed = 0;
};

/// What a clean surface takes with these parameters, in seconds a point.
double cleanSecondsAPoint(const MultiresolutionParameters& parameters) {
  static std::map<std::tuple<bool, bool, int, bool, bool>, double> known;
  double& seconds = known[{parameters.reduce, parameters.watertight, parameters.refinement.levels,
                           parameters.noise.adapt, parameters.triangulation.heal}];
  if (seconds > 0) return seconds;
  shapes::Random random(1);
  constexpr std::size_t kPoints = 5000;
  const std::vector<core::Vec3> points = shapes::makeShape("torus")->sample(kPoints, random);
  seconds = test::outcomeOf(points, core::StoredAs::Float, parameters).seconds;
  for (int i = 0; i < 2; ++i)
    seconds = std::min(seconds, test::outcomeOf(points, core::StoredAs::Float, parameters).seconds);
  return seconds /= kPoints;
}

void check(std::uint64_t seed, std::size_t most, std::map<std::string, Tally>& tallies) {
  const test::RandomCloud cloud = test::drawCloud(seed, most);
  core::Context context;
  context.threads = 1;
  const test::Outcome outcome = test::outcomeOf(cloud.points, cloud.stored_as, cloud.parameters, context);
  Tally& tally = tallies[cloud.kind];
  ++tally.clouds;
  tally.refused += outcome.code != StatusCode::Ok;
  tally.crossing += outcome.self_intersections > 0;
  const double expected = cleanSecondsAPoint(cloud.parameters) * static_cast<double>(cloud.points.size());
  const double slower = std::max(0.0, outcome.seconds - kAlways) / expected;
  if (slower > tally.slowest) {
    tally.slowest = slower;
    tally.slowest_seed = seed;
  }
  if (outcome.fault.empty() && slower <= kSlower) return;
  ++tally.violations;
  const std::string why =
      outcome.fault.empty() ? "took " + std::to_string(outcome.seconds) + " s" : outcome.fault;
  std::printf("seed %llu: %s: %s\n", static_cast<unsigned long long>(seed), cloud.description.c_str(),
              why.c_str());
}

int print(const std::map<std::string, Tally>& tallies) {
  Tally sum;
  std::printf("%-34s %7s %8s %9s %10s  slowest over a clean surface\n", "kind", "clouds", "refused",
              "crossing", "violations");
  const auto row = [](const char* kind, const Tally& tally) {
    std::printf("%-34s %7d %8d %9d %10d  %.1f (seed %llu)\n", kind, tally.clouds, tally.refused,
                tally.crossing, tally.violations, tally.slowest,
                static_cast<unsigned long long>(tally.slowest_seed));
  };
  for (const auto& [kind, tally] : tallies) {
    row(kind.c_str(), tally);
    sum.clouds += tally.clouds;
    sum.refused += tally.refused;
    sum.crossing += tally.crossing;
    sum.violations += tally.violations;
    if (tally.slowest > sum.slowest) {
      sum.slowest = tally.slowest;
      sum.slowest_seed = tally.slowest_seed;
    }
  }
  row("all", sum);
  return sum.violations;
}

}  // namespace

int main(int argc, char** argv) {
  const auto argument = [&](int i, const char* otherwise) {
    return std::strtoull(argc > i ? argv[i] : otherwise, nullptr, 10);
  };
  const std::uint64_t count = argument(1, "1000"), first = argument(2, "1");
  const auto most = static_cast<std::size_t>(std::max(3ULL, argument(3, "2000")));
  std::map<std::string, Tally> tallies;
  for (std::uint64_t seed = first; seed < first + count; ++seed) check(seed, most, tallies);
  return print(tallies) == 0 ? 0 : 1;
}
