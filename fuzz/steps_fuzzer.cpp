// SPDX-License-Identifier: BSD-3-Clause
// Small clouds and parameters, drawn from the bytes, through the four steps: one by one, or all at once. Ends
// in abort() if a step breaks what its header promises.
#include <fuzzer/FuzzedDataProvider.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "clouds/soundness.h"
#include "mlsmesh/core/bsp_clustering.h"
#include "mlsmesh/core/failure.h"
#include "mlsmesh/core/parameter_check.h"

namespace {

using namespace mlsmesh;
using core::Context;
using core::Index;
using core::PointSet;
using core::StoredAs;
using core::Triangle;
using core::Vec3;

using Points = std::vector<Vec3>;

[[noreturn]] void violated(const std::string& promise) {
  std::fprintf(stderr, "steps_fuzzer: %s\n", promise.c_str());
  std::abort();
}

void expect(bool holds, const char* promise) {
  if (!holds) violated(promise);
}

template <typename Value, typename Bits>
double anyValue(FuzzedDataProvider& bytes) {
  const auto bits = bytes.ConsumeIntegral<Bits>();
  Value value;
  std::memcpy(&value, &bits, sizeof value);
  return static_cast<double>(value);
}

double anyCoordinate(FuzzedDataProvider& bytes, bool is_double) {
  return is_double ? anyValue<double, std::uint64_t>(bytes) : anyValue<float, std::uint32_t>(bytes);
}

// On a small lattice, so that few bytes make many ties; every now and then anywhere, or where a point is.
Points drawPoints(FuzzedDataProvider& bytes, StoredAs stored_as) {
  constexpr std::size_t kMost = 300;
  const int side = bytes.ConsumeIntegralInRange(1, 15), sheets = bytes.ConsumeIntegralInRange(0, 15);
  const bool any_bits = bytes.ConsumeIntegralInRange(0, 7) == 0;
  const double unit = std::ldexp(1.0, bytes.ConsumeIntegralInRange(-60, 60));
  const double jitter = std::ldexp(unit, -bytes.ConsumeIntegralInRange(1, 50));
  const std::size_t count = bytes.ConsumeIntegralInRange<std::size_t>(3, kMost);
  Points points;
  while (points.size() < count && bytes.remaining_bytes() > 0) {
    if (any_bits) {
      const bool is_double = stored_as == StoredAs::Double;
      const double x = anyCoordinate(bytes, is_double), y = anyCoordinate(bytes, is_double);
      points.emplace_back(x, y, anyCoordinate(bytes, is_double));
      continue;
    }
    const auto code = bytes.ConsumeIntegral<std::uint16_t>();
    const int x = code & 15, y = code >> 4 & 15, z = code >> 8 & 15, what = code >> 12;
    Vec3 p(x % (side + 1), y % (side + 1), z % (sheets + 1));
    p *= unit;
    if (what == 15 && !points.empty()) p = points[static_cast<std::size_t>(code & 255) % points.size()];
    if (what >= 12) p += jitter * Vec3(x - 7, z - 7, y - 7);
    points.push_back(p);
  }
  return points;
}

template <typename Enum>
Enum drawOne(FuzzedDataProvider& bytes, int count) {
  return static_cast<Enum>(bytes.ConsumeIntegralInRange(0, count - 1));
}

void drawTriangulation(FuzzedDataProvider& bytes, TriangulationParameters& parameters) {
  parameters.neighbors = bytes.ConsumeIntegralInRange(4, 40);
  parameters.order = drawOne<FrontOrder>(bytes, 2);
  parameters.seeds = drawOne<SeedRule>(bytes, 2);
  parameters.restart = bytes.ConsumeBool();
  parameters.candidates = drawOne<CandidateRule>(bytes, 2);
  parameters.apex_choice = drawOne<ApexChoice>(bytes, 2);
  parameters.length_rule = drawOne<LengthRule>(bytes, 2);
  parameters.overlap_test = drawOne<OverlapTest>(bytes, 2);
  parameters.fill_small_loops = bytes.ConsumeBool();
  parameters.fill_max_edges = bytes.ConsumeIntegralInRange(3, 64);
  parameters.fill_supported_edges = bytes.ConsumeIntegralInRange(0, 64);
  parameters.length_factor = bytes.ConsumeIntegralInRange(1, 40) / 4.0;
  parameters.heal = bytes.ConsumeBool();
}

void drawRefinement(FuzzedDataProvider& bytes, RefinementParameters& parameters) {
  parameters.test = drawOne<RefinementTest>(bytes, 2);
  parameters.threshold = bytes.ConsumeIntegralInRange(0, 20) / 100.0;
  parameters.split_mode = drawOne<SplitMode>(bytes, 2);
  parameters.min_edge_ratio = bytes.ConsumeIntegralInRange(0, 10) / 10.0;
  parameters.max_displacement = bytes.ConsumeIntegralInRange(1, 30) / 10.0;
  parameters.border_displacement = bytes.ConsumeIntegralInRange(0, 30) / 10.0;
  parameters.smooth_borders = bytes.ConsumeBool();
  parameters.fold_guard = bytes.ConsumeBool();
  parameters.flips = drawOne<FlipRule>(bytes, 3);
  parameters.flip_guard = bytes.ConsumeBool();
}

// A preset, and in every other case any member of it in its range.
MultiresolutionParameters drawParameters(FuzzedDataProvider& bytes) {
  const int preset = bytes.ConsumeIntegralInRange(0, 2);
  MultiresolutionParameters parameters = preset == 0   ? defaultPreset()
                                         : preset == 1 ? paperPreset()
                                                       : printedPreset();
  parameters.reduce = bytes.ConsumeBool();
  parameters.watertight = bytes.ConsumeBool();
  parameters.hole_size = bytes.ConsumeIntegral<std::uint8_t>() / 2;
  parameters.refinement.levels = bytes.ConsumeIntegralInRange(0, 2);
  if (bytes.ConsumeBool()) {
    parameters.min_representatives = bytes.ConsumeIntegralInRange(3, 60);
    parameters.clustering.split_plane = drawOne<SplitPlane>(bytes, 2);
    parameters.clustering.split_rule = drawOne<SplitRule>(bytes, 2);
    parameters.clustering.max_size = bytes.ConsumeIntegralInRange(1, 20);
    parameters.clustering.min_leaf = bytes.ConsumeIntegralInRange(1, 10);
    parameters.projection.neighbors = bytes.ConsumeIntegralInRange(4, 40);
    parameters.projection.degree = bytes.ConsumeIntegralInRange(0, 3);
    parameters.projection.method = drawOne<ProjectionMethod>(bytes, 2);
    parameters.projection.support_rule = drawOne<SupportRule>(bytes, 2);
    parameters.reduction.clamp = drawOne<ClampRule>(bytes, 2);
    parameters.outliers.remove = bytes.ConsumeBool();
    parameters.noise.sigma = bytes.ConsumeIntegralInRange(-1, 10) / 8.0;
    parameters.features.detect = bytes.ConsumeBool();
    drawTriangulation(bytes, parameters.triangulation);
    drawRefinement(bytes, parameters.refinement);
  }
  core::check(parameters);
  return parameters;
}

void expectPartition(const core::IndexLists& clusters, const PointSet& points) {
  std::vector<char> seen(points.position.size(), 0);
  for (Index c = 0; c < clusters.count(); ++c) expect(clusters.size(c) > 0, "a cluster is empty");
  for (const Index p : clusters.items) expect(seen[p]++ == 0, "a point is in two clusters");
  expect(clusters.items.size() == seen.size(), "a point is in no cluster");
}

void expectRepresentatives(const core::Representatives& all, const core::IndexLists& clusters,
                           const PointSet& points) {
  expect(all.size() == clusters.count(), "not one representative a cluster");
  for (Index r = 0; r < all.size(); ++r) {
    expect(all.position[r].allFinite(), "a representative is not finite");
    expect(points.stored(all.position[r]) == all.position[r], "a representative is not as stored");
    expect(std::abs(all.normal[r].norm() - 1) < 1e-9, "a normal of a representative is no unit vector");
    expect(all.nearest[r] >= 0 && all.nearest[r] < points.size(), "a representative has no nearest point");
  }
}

// Clustering, reduction and triangulation, each with what the one before made of the cloud.
void runSteps(const PointSet& points, const MultiresolutionParameters& parameters, bool may_split,
              const Context& context) {
  const auto search = core::makeKdTreeOver(points.position);
  const core::MlsSurface surface(points.position, *search, parameters.projection);
  core::IndexLists clusters = clusterPoints(points.position, parameters.clustering, context);
  expectPartition(clusters, points);
  const core::Representatives all = reducePoints(points, surface, clusters, parameters.reduction, context);
  expectPartition(clusters, points);
  expectRepresentatives(all, clusters, points);
  core::TriangulationInput input{parameters.reduce ? all.position : points.position};
  input.spacing = medianSpacing(points.position, *search, context);
  input.may_split = may_split;
  const core::Triangulation made = triangulate(input, parameters.triangulation, context);
  expect(may_split || made.duplicate_of.empty(), "a point was duplicated");
  Points vertices = input.points;
  for (const Index v : made.duplicate_of) vertices.push_back(input.points[v]);
  const std::string fault = test::faultOf(vertices, made.triangles);
  if (!fault.empty()) violated("triangulation: " + fault);
}

void runAll(PointSet points, const MultiresolutionParameters& parameters, Context& context) {
  const std::string fault = test::faultOf(reconstruct(std::move(points), nullptr, parameters, context));
  if (!fault.empty()) violated("reconstruction: " + fault);
}

bool mayRefuse(StatusCode code) {
  return code == StatusCode::TooFewPoints || code == StatusCode::DegenerateInput ||
         code == StatusCode::NoTriangles || code == StatusCode::EmptyInput;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  FuzzedDataProvider bytes(data, size);
  Context context;
  context.threads = 1;
  const bool step_by_step = bytes.ConsumeBool(), may_split = bytes.ConsumeBool();
  const StoredAs stored_as = bytes.ConsumeBool() ? StoredAs::Double : StoredAs::Float;
  const MultiresolutionParameters parameters = drawParameters(bytes);
  const Status status = core::guarded([&] {
    PointSet points = makePointSet(drawPoints(bytes, stored_as), stored_as, nullptr, context);
    if (step_by_step)
      runSteps(points, parameters, may_split, context);
    else
      runAll(std::move(points), parameters, context);
  });
  if (!status.ok() && !mayRefuse(status.code))
    violated(std::string(name(status.code)) + ": " + status.message);
  return 0;
}
