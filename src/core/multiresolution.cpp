// SPDX-License-Identifier: BSD-3-Clause
// The pipeline of B. Mederos, L. Velho, L. H. de Figueiredo, "Moving least squares multiresolution surface
// approximation", SIBGRAPI 2003, section 2.
#include "mlsmesh/core/multiresolution.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <numeric>
#include <utility>

#include "border_smoothing.h"
#include "mlsmesh/core/bsp_clustering.h"
#include "mlsmesh/core/failure.h"
#include "mlsmesh/core/noise.h"
#include "mlsmesh/core/outliers.h"
#include "mlsmesh/core/parameter_check.h"
#include "mlsmesh/core/self_intersections.h"
#include "sheet_clusters.h"
#include "side_flips.h"
#include "troubled_places.h"

namespace mlsmesh::core {
namespace {

// Times the stages one after the other and tells the progress handle which one runs.
class Stopwatch {
 public:
  Stopwatch(Progress progress, std::vector<StageTime>& stages)
      : progress_(std::move(progress)), stages_(stages) {}

  template <typename Work>
  void run(const std::string& stage, double end, const Work& work) {
    progress_.enterStage(stage, end);
    const auto start = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    stages_.push_back({stage, seconds.count()});
    progress_.advance(1);
  }

 private:
  Progress progress_;
  std::vector<StageTime>& stages_;
};

IndexLists singletons(Index count) {
  IndexLists lists;
  lists.begin.resize(static_cast<std::size_t>(count) + 1);
  std::iota(lists.begin.begin(), lists.begin.end(), 0);
  lists.items.resize(static_cast<std::size_t>(count));
  std::iota(lists.items.begin(), lists.items.end(), 0);
  return lists;
}

// Clusters, smaller than asked where a small cloud would leave too few of them to carry a surface.
IndexLists clustersOf(const std::vector<Vec3>& points, const MultiresolutionParameters& parameters,
                      Context& context) {
  ClusteringParameters clustering = parameters.clustering;
  IndexLists clusters = clusterPoints(points, clustering, context);
  if (clusters.count() >= parameters.min_representatives) return clusters;
  while (clusters.count() < parameters.min_representatives && clustering.max_size > 1) {
    clustering.max_size = std::max(1, 2 * clustering.max_size / 3);
    clustering.min_leaf = std::min(clustering.min_leaf, std::max(1, clustering.max_size / 2));
    clusters = clusterPoints(points, clustering, context);
  }
  if (clusters.count() < parameters.min_representatives)
    clusters = singletons(static_cast<Index>(points.size()));
  context.warnings.push_back("few points: clusters were made smaller, which leaves " +
                             std::to_string(clusters.count()) + " representatives");
  return clusters;
}

// The input points themselves in the place of representatives.
Representatives unreduced(const PointSet& points) {
  const std::size_t count = static_cast<std::size_t>(points.size());
  Representatives all;
  all.position = points.position;
  all.nearest.resize(count);
  std::iota(all.nearest.begin(), all.nearest.end(), 0);
  all.kind.assign(count, VertexKind::InputPoint);
  return all;
}

// Level 0: the vertices that a triangle uses, in the order of the representatives, copies of split ones last.
void makeLevelZero(const Triangulation& triangulation, Reconstruction& result) {
  const Representatives& all = result.representatives;
  const Index originals = all.size();
  const Index total = originals + static_cast<Index>(triangulation.duplicate_of.size());
  std::vector<Index> vertex_of(static_cast<std::size_t>(total), kNone);
  for (const Triangle& t : triangulation.triangles) {
    for (const Index v : t) vertex_of[v] = 0;
  }
  RefinedMesh& mesh = result.mesh;
  IndexLists members;
  for (Index v = 0; v < total; ++v) {
    if (vertex_of[v] == kNone) continue;
    vertex_of[v] = static_cast<Index>(mesh.position.size());
    const Index from = v < originals ? v : triangulation.duplicate_of[v - originals];
    result.representative_of.push_back(from);
    mesh.position.push_back(all.position[from]);
    mesh.kind.push_back(all.kind[from]);
    mesh.nearest.push_back(all.nearest[from]);
    mesh.parents.push_back({vertex_of[v], vertex_of[v]});
    members.append(result.clusters.data(from), result.clusters.size(from));
  }
  result.clusters = std::move(members);
  std::vector<Triangle> triangles = triangulation.triangles;
  for (Triangle& t : triangles) {
    for (Index& v : t) v = vertex_of[v];
  }
  mesh.normal = vertexNormals(triangles, mesh.position);
  for (std::size_t v = 0; v < mesh.position.size() && !all.normal.empty(); ++v) {
    const Vec3& fitted = all.normal[result.representative_of[v]];
    mesh.normal[v] = fitted.dot(mesh.normal[v]) < 0 ? Vec3(-fitted) : fitted;
  }
  mesh.level_triangles.push_back(std::move(triangles));
  const std::optional<HealingStatistics>& healing = triangulation.statistics.healing;
  mesh.level_intersections.push_back(healing ? std::optional(healing->intersections) : std::nullopt);
  mesh.level_vertices.push_back(static_cast<Index>(mesh.position.size()));
}

// The normals of the surface at the vertices of level 0; none away from sharp edges.
std::vector<VertexSides> vertexSides(const Reconstruction& result) {
  const RefinedMesh& mesh = result.mesh;
  std::vector<VertexSides> sides(mesh.position.size());
  for (std::size_t v = 0; v < sides.size(); ++v) {
    const Index crease = result.representatives.crease[result.representative_of[v]];
    if (crease != kNone) {
      sides[v] = {result.features.vertices[crease].side_normal, result.features.vertices[crease].sides};
    } else {
      sides[v].normal[0] = result.representatives.normal[result.representative_of[v]];
      sides[v].count = 1;
    }
  }
  return sides;
}

HalfEdgeMesh levelZero(const RefinedMesh& mesh) {
  HalfEdgeMesh level;
  std::string why;
  if (!buildMesh(static_cast<Index>(mesh.position.size()), mesh.level_triangles[0], level, &why)) {
    throw Failure(StatusCode::Internal, "the triangulation is not a manifold: " + why);
  }
  return level;
}

// Flips edges to the sides of sharp edges. Where triangles then meet that should not, edges stay.
void turnToSides(const Context& context, Reconstruction& result) {
  constexpr int kRounds = 4;
  RefinedMesh& mesh = result.mesh;
  std::vector<VertexSides> sides = vertexSides(result);
  for (int round = 0; round < kRounds; ++round) {
    HalfEdgeMesh level = levelZero(mesh);
    if (flipToSides(level, mesh.position, sides) == 0) return;
    std::vector<Triangle> triangles = level.triangles();
    const auto pairs = SelfIntersections(mesh.position, triangles, context, &level).all();
    const auto count = static_cast<std::int64_t>(pairs.size());
    if (count <= mesh.level_intersections[0].value_or(0)) {
      mesh.level_triangles[0] = std::move(triangles);
      mesh.level_intersections[0] = count;
      return;
    }
    for (const TrianglePair& pair : pairs) {
      for (const Index t : pair) {
        for (const Index v : triangles[t]) sides[v].count = 0;
      }
    }
  }
}

MeshReport reportLevel(const RefinedMesh& mesh, Index level, const Context& context) {
  const std::vector<Vec3> vertices(mesh.position.begin(), mesh.position.begin() + mesh.level_vertices[level]);
  const std::optional<std::int64_t>& known = mesh.level_intersections[level];
  if (!known) return reportMesh(vertices, mesh.level_triangles[level], context);
  MeshReport report = reportMesh(vertices, mesh.level_triangles[level]);
  report.self_intersections = known;
  return report;
}

// The cloud as the steps see it: its points, denoised and without outliers where that was needed, the search
// over them, and their surface.
class Surroundings {
 public:
  Surroundings(PointSet set, const SearchFactory& makeSearch)
      : points(std::move(set)), makeSearch_(makeSearch) {
    renewSearch();
  }

  const NeighborSearch& search() const { return *search_; }
  const MlsSurface& surface() const { return *surface_; }

  void renewSearch() { search_ = makeSearch_(points); }
  void renewSurface(const ProjectionParameters& parameters, double residual_limit) {
    surface_ = std::make_unique<MlsSurface>(points.position, *search_, parameters, residual_limit);
  }

  PointSet points;

 private:
  const SearchFactory& makeSearch_;
  std::unique_ptr<NeighborSearch> search_;
  std::unique_ptr<MlsSurface> surface_;
};

NoiseEstimate noiseOf(const Surroundings& cloud, double spacing, const MultiresolutionParameters& parameters,
                      const Context& context) {
  if (!parameters.noise.adapt || !parameters.reduce) return {};
  const double given = parameters.noise.sigma;
  if (given < 0) return estimateNoise(cloud.points.position, cloud.search(), context);
  return {given * spacing, given};
}

void denoise(const NoiseAdaptation& noise, const Context& context, Surroundings& cloud) {
  for (int pass = 0; pass < noise.passes; ++pass) {
    cloud.points.position =
        projectAll(cloud.points.position, cloud.search(), noise.denoising, noise.residual_limit, context);
    cloud.renewSearch();
  }
}

void renewSurface(const NoiseAdaptation& noise, Surroundings& cloud) {
  cloud.renewSurface(noise.parameters.projection, noise.passes > 0 ? 0 : noise.residual_limit);
}

void clusterAndReduce(const Surroundings& cloud, Context& context, Reconstruction& result) {
  const MultiresolutionParameters& parameters = result.noise.parameters;
  result.clusters = clustersOf(cloud.points.position, parameters, context);
  result.representatives =
      reducePoints(cloud.points, cloud.surface(), result.clusters, parameters.reduction, context);
}

// More representatives where sheets are near each other.
void divideBetweenSheets(const Surroundings& cloud, const Context& context, Reconstruction& result) {
  std::optional<DividedClusters> finer =
      clustersBetweenSheets(cloud.points.position, result.clusters, result.representatives, context);
  if (!finer) return;
  reduceDivided(finer->divided, std::move(finer->clusters), cloud.points, cloud.surface(),
                result.noise.parameters.reduction, context, result.representatives, result.clusters);
}

// Points that belong to no surface, as far as the representatives tell.
std::vector<Index> outliersOf(const Surroundings& cloud, const Context& context, Reconstruction& result) {
  const OutlierParameters& parameters = result.noise.parameters.outliers;
  if (!parameters.remove) return {};
  std::vector<Index> found = dropOutliers(parameters, result.representatives, result.clusters, context);
  const std::vector<Index> stray =
      strayPoints(cloud.points.position, cloud.surface(), result.representatives, result.clusters, context);
  found.insert(found.end(), stray.begin(), stray.end());
  std::sort(found.begin(), found.end());
  return found;
}

// Goes on without the outliers: with new clusters where they are many, with the old ones where a few went.
void leaveOut(const std::vector<Index>& outliers, Context& context, Surroundings& cloud,
              Reconstruction& result) {
  constexpr double kMany = 0.01;  // of the points
  const MultiresolutionParameters& parameters = result.noise.parameters;
  const bool many = static_cast<double>(outliers.size()) > kMany * cloud.points.size();
  std::vector<Vec3> positions;
  for (const Index p : outliers) positions.push_back(cloud.points.position[p]);
  removePoints(outliers, cloud.points);
  cloud.renewSearch();
  renewSurface(result.noise, cloud);
  if (many) {
    clusterAndReduce(cloud, context, result);
    return;
  }
  const std::vector<char> touched = forgetMembers(outliers, positions, parameters.projection.neighbors,
                                                  result.representatives, result.clusters);
  renewRepresentatives(touched, cloud.points, cloud.surface(), parameters.reduction, context,
                       result.representatives, result.clusters);
}

void removeOutliers(Context& context, Surroundings& cloud, Reconstruction& result) {
  constexpr int kRounds = 3;      // what one outlier hid, the next round sees,
  constexpr double kFew = 0.001;  // unless they are so few, of the points, that none hides another
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<Index> outliers = outliersOf(cloud, context, result);
    if (outliers.empty()) return;
    result.outliers += static_cast<Index>(outliers.size());
    const bool few = outliers.size() < kFew * static_cast<double>(cloud.points.size());
    leaveOut(outliers, context, cloud, result);
    if (few) return;
  }
  dropOutliers(result.noise.parameters.outliers, result.representatives, result.clusters, context);
}

// Looks for sharp edges in a clean cloud, and reduces again where there are some.
void keepFeatures(const Surroundings& cloud, const Context& context, Reconstruction& result) {
  MultiresolutionParameters& parameters = result.noise.parameters;
  const FeatureParameters& features = parameters.features;
  if (!features.detect || result.noise.estimate.relative > features.max_noise) return;
  result.features = detectFeatures(cloud.points, cloud.search(), result.clusters,
                                   result.representatives.variation, features, context);
  if (!result.features.any()) return;
  result.representatives = reducePoints(cloud.points, cloud.surface(), result.clusters, parameters.reduction,
                                        context, result.features);
  parameters.refinement.threshold *= features.threshold_share;
}

void reduce(Stopwatch& stages, Context& context, Surroundings& cloud, Reconstruction& result) {
  if (!result.noise.parameters.reduce) {
    result.clusters = singletons(cloud.points.size());
    result.representatives = unreduced(cloud.points);
    return;
  }
  stages.run("reduction", 0.25, [&] { clusterAndReduce(cloud, context, result); });
  stages.run("outliers", 0.3, [&] {
    removeOutliers(context, cloud, result);
    divideBetweenSheets(cloud, context, result);
  });
  stages.run("features", 0.35, [&] { keepFeatures(cloud, context, result); });
  if (result.noise.drops_crowded) dropCrowded(result.representatives, result.clusters, context);
}

void warnOfSeams(const FrontStatistics& front, Context& context) {
  if (front.seams == 0) return;
  context.warnings.push_back("the cloud is one-sided or contradictory: it was cut open along " +
                             std::to_string(front.seams) + " seams (" + std::to_string(front.seam_edges) +
                             " edges)");
}

// Borders move to the rim of the cloud where its points are where they were measured, and borders are to
// stay: patches go on better from the triangles of the representatives.
void moveBorders(const Surroundings& cloud, const Context& context, Reconstruction& result) {
  const MultiresolutionParameters& parameters = result.noise.parameters;
  const bool stay = parameters.refinement.smooth_borders && !parameters.watertight;
  if (!parameters.reduce || !stay || result.noise.passes > 0) return;
  smoothBorders(cloud.points, cloud.surface(), result.clusters, context, result.mesh);
}

Triangulation triangulateRepresentatives(const std::vector<Vec3>& points, const NeighborSearch& search,
                                         const Context& context, const Reconstruction& result) {
  const Representatives& all = result.representatives;
  TriangulationInput input{all.position};
  input.spacing = result.spacing;
  input.may_split = true;
  if (result.noise.parameters.reduce) {
    input.normals = &all.normal;
    input.cloud_spacing = &all.spacing;
    input.cloud = &search;
    input.cloud_points = &points;
    input.cloud_nearest = &all.nearest;
  } else {
    input.search = &search;
  }
  return triangulate(input, result.noise.parameters.triangulation, context);
}

// What is left to wish for: fewer are better.
Index faultsOf(const Triangulation& triangulation) {
  constexpr Index kHandle = 10;  // as bad as so many troubled vertices
  const HealingStatistics& healing = *triangulation.statistics.healing;
  return static_cast<Index>(triangulation.troubled.size()) + healing.opened_places +
         kHandle * healing.handles;
}

// Triangulates again, with smaller clusters where there was trouble, as long as that leaves less of it.
void refineTroubledPlaces(const Surroundings& cloud, Context& context, Reconstruction& result,
                          Triangulation& triangulation) {
  constexpr int kRounds = 2;
  const MultiresolutionParameters& parameters = result.noise.parameters;
  const bool may_refine = parameters.reduce && parameters.triangulation.heal && !result.features.any() &&
                          result.noise.passes == 0;
  for (int round = 0; may_refine && round < kRounds && !triangulation.troubled.empty(); ++round) {
    const std::vector<char> marked = aroundTrouble(triangulation, result.representatives.size());
    IndexLists clusters = result.clusters;
    Representatives representatives = result.representatives;
    reduceDivided(marked,
                  finerClusters(cloud.points.position, clusters, marked, parameters.clustering, context),
                  cloud.points, cloud.surface(), parameters.reduction, context, representatives, clusters);
    if (result.noise.drops_crowded) dropCrowded(representatives, clusters, context);
    std::swap(representatives, result.representatives);
    std::swap(clusters, result.clusters);
    Triangulation finer = triangulateRepresentatives(cloud.points.position, cloud.search(), context, result);
    if (faultsOf(finer) >= faultsOf(triangulation)) {
      std::swap(representatives, result.representatives);
      std::swap(clusters, result.clusters);
      return;
    }
    triangulation = std::move(finer);
  }
}

void makeLevelZero(const Surroundings& cloud, Context& context, Reconstruction& result) {
  Triangulation triangulation =
      triangulateRepresentatives(cloud.points.position, cloud.search(), context, result);
  refineTroubledPlaces(cloud, context, result, triangulation);
  result.front = triangulation.statistics;
  warnOfSeams(result.front, context);
  makeLevelZero(triangulation, result);
  if (result.features.any()) turnToSides(context, result);
  moveBorders(cloud, context, result);
}

// Patches over the holes that are to be closed; their vertices have no points.
void closeHolesOf(const Surroundings& cloud, Context& context, Reconstruction& result) {
  const MultiresolutionParameters& parameters = result.noise.parameters;
  const double longest =
      parameters.watertight ? std::numeric_limits<double>::infinity() : parameters.hole_size * result.spacing;
  std::vector<Index> source;
  result.patches = closeHoles(cloud.points, cloud.search(), longest, context, result.mesh, source);
  for (const Index vertex : source) {
    result.representative_of.push_back(result.representative_of[vertex]);
    result.clusters.begin.push_back(result.clusters.begin.back());
  }
  if (result.patches.open_loops > 0) {
    context.warnings.push_back(std::to_string(result.patches.open_loops) +
                               " holes stay open: no patch over them keeps clear of the mesh");
  }
}

}  // namespace

Reconstruction reconstruct(PointSet points, const SearchFactory& search_factory,
                           const MultiresolutionParameters& parameters, Context& context) {
  check(parameters);
  const SearchFactory makeSearch =
      search_factory ? search_factory : [](const PointSet& set) { return makeKdTree(set.position); };
  Reconstruction result;
  Stopwatch stages(context.progress, result.stages);
  std::unique_ptr<Surroundings> cloud;
  stages.run("search", 0.05, [&] {
    cloud = std::make_unique<Surroundings>(std::move(points), makeSearch);
    result.spacing = medianSpacing(cloud->points.position, cloud->search(), context);
  });
  stages.run("noise", 0.1, [&] {
    result.noise = adaptTo(noiseOf(*cloud, result.spacing, parameters, context), parameters);
  });
  if (result.noise.passes > 0) stages.run("denoising", 0.2, [&] { denoise(result.noise, context, *cloud); });
  renewSurface(result.noise, *cloud);
  reduce(stages, context, *cloud, result);
  stages.run("triangulation", result.noise.parameters.reduce ? 0.45 : 0.7,
             [&] { makeLevelZero(*cloud, context, result); });
  if (parameters.watertight || parameters.hole_size > 0) {
    stages.run("holes", parameters.reduce ? 0.5 : 0.75, [&] { closeHolesOf(*cloud, context, result); });
  }
  const RefinementParameters& refinement = result.noise.parameters.refinement;
  const double begin = context.progress.fraction();
  for (int level = 1; level <= refinement.levels; ++level) {
    const double share = static_cast<double>(level) / refinement.levels;
    stages.run("refinement " + std::to_string(level), begin + share * (0.95 - begin), [&] {
      addLevel(cloud->points, cloud->surface(), result.spacing, refinement, context, result.mesh,
               result.features);
    });
  }
  stages.run("report", 1.0, [&] {
    for (Index level = 0; level < result.mesh.levelCount(); ++level) {
      result.reports.push_back(reportLevel(result.mesh, level, context));
    }
  });
  result.points = std::move(cloud->points);
  return result;
}

}  // namespace mlsmesh::core
