// SPDX-License-Identifier: BSD-3-Clause
// What happens where there is no memory: a program of its own, because its operator new fails when it is told
// to.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <new>
#include <string>
#include <vector>

#include "../pcl/clouds.h"
#include "mlsmesh/advancing_front_triangulation.h"
#include "mlsmesh/bsp_clustering.h"
#include "mlsmesh/mls_multiresolution.h"
#include "mlsmesh/mls_reduction.h"
#include "mlsmesh/mls_refinement.h"
#include "mlsmesh/mls_surface.h"

namespace {

enum class Shortage { None, Once, FromThenOn };

std::atomic<Shortage> g_shortage{Shortage::None};
std::atomic<std::int64_t> g_left{0};  // allocations until the one that fails

// Whether this allocation, of any thread, is to fail.
bool isRefused() {
  const Shortage shortage = g_shortage.load(std::memory_order_relaxed);
  if (shortage == Shortage::None) return false;
  const std::int64_t left = --g_left;
  return left == 0 || (left < 0 && shortage == Shortage::FromThenOn);
}

void* allocate(std::size_t size) {
  if (isRefused()) throw std::bad_alloc();
  void* const memory = std::malloc(size > 0 ? size : 1);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

void* allocateAligned(std::size_t size, std::align_val_t alignment) {
  if (isRefused()) throw std::bad_alloc();
  const auto bytes = static_cast<std::size_t>(alignment);
  void* const memory = std::aligned_alloc(bytes, (size + bytes - 1) / bytes * bytes);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

void* operator new(std::size_t size) {
  return allocate(size);
}
void* operator new[](std::size_t size) {
  return allocate(size);
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return isRefused() ? nullptr : std::malloc(size > 0 ? size : 1);
}
void* operator new[](std::size_t size, const std::nothrow_t& nothrow) noexcept {
  return operator new(size, nothrow);
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return allocateAligned(size, alignment);
}
void* operator new[](std::size_t size, std::align_val_t alignment) {
  return allocateAligned(size, alignment);
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete[](void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, const std::nothrow_t&) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, const std::nothrow_t&) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}

namespace mlsmesh {
namespace {

using Point = pcl::PointXYZRGBNormal;

constexpr std::int64_t kUnlimited = std::int64_t{1} << 40;

/// Allocations fail as told from the n-th on (n >= 1) while it lives.
class Short {
 public:
  Short(Shortage shortage, std::int64_t n) {
    g_left = n;
    g_shortage = shortage;
  }
  ~Short() { g_shortage = Shortage::None; }
  Short(const Short&) = delete;
  Short& operator=(const Short&) = delete;

  /// How many there have been.
  static std::int64_t countSince(std::int64_t n) { return n - g_left; }
};

/// One verb of one object that is used again and again.
struct Verb {
  std::function<const Status&()> run;
  std::function<bool()> left_nothing;
  std::function<std::string()> result;  ///< all that it made, as bytes
};

std::string bytesOf(const std::vector<pcl::Vertices>& polygons) {
  std::string bytes;
  for (const pcl::Vertices& polygon : polygons) {
    bytes.append(reinterpret_cast<const char*>(polygon.vertices.data()),
                 polygon.vertices.size() * sizeof(polygon.vertices[0]));
  }
  return bytes;
}

std::string bytesOf(const pcl::PolygonMesh& mesh) {
  return std::string(mesh.cloud.data.begin(), mesh.cloud.data.end()) + bytesOf(mesh.polygons);
}

/// Fails an allocation after the other, at most about `most` of them, spread over the run.
void failEverywhere(const Verb& verb, Shortage shortage, std::int64_t most) {
  std::int64_t count = 0;
  {
    const Short counter(Shortage::Once, kUnlimited);
    ASSERT_TRUE(verb.run().ok());
    count = Short::countSince(kUnlimited);
  }
  const std::string expected = verb.result();
  ASSERT_FALSE(expected.empty());
  const std::int64_t stride = std::max<std::int64_t>(1, count / most);
  std::int64_t refused = 0;
  for (std::int64_t n = 1; n <= count; n += stride) {
    StatusCode code = StatusCode::Ok;
    {
      const Short shortness(shortage, n);
      code = verb.run().code;
    }
    if (code ==
        StatusCode::Ok) {  // one thread may have needed less than the time before, or could do without
      ASSERT_EQ(verb.result(), expected) << n;
      continue;
    }
    ++refused;
    ASSERT_EQ(code, StatusCode::OutOfMemory) << n;
    ASSERT_TRUE(verb.left_nothing()) << n;
  }
  EXPECT_GT(refused, 0);
  ASSERT_TRUE(verb.run().ok());
  EXPECT_EQ(verb.result(), expected) << "the object is as before";
}

void failEverywhere(const Verb& verb, std::int64_t most = 300) {
  failEverywhere(verb, Shortage::Once, most);
  failEverywhere(verb, Shortage::FromThenOn, most);
}

pcl::PointCloud<Point>::Ptr sphere(int count) {
  return testing::cloudOf<Point>(testing::spherePoints(count));
}

/// A box, with sharp edges, and points that belong to nothing.
pcl::PointCloud<Point>::Ptr boxWithStrays() {
  constexpr int kSide = 12;
  std::vector<core::Vec3> points;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      for (int i = 0; i <= kSide; ++i) {
        for (int j = 0; j <= kSide; ++j) {
          core::Vec3 p;
          p[axis] = side;
          p[(axis + 1) % 3] = 2.0 * i / kSide - 1;
          p[(axis + 2) % 3] = 2.0 * j / kSide - 1;
          points.push_back(p);
        }
      }
    }
  }
  for (int i = 0; i < 6; ++i) points.emplace_back(3 + i, 0.5 * i, 2);
  return testing::cloudOf<Point>(points);
}

template <typename Step>
void setUp(const pcl::PointCloud<Point>::Ptr& cloud, int threads, Step& step) {
  step.setInputCloud(cloud);
  step.setNumberOfThreads(threads);
}

void failReconstruction(const pcl::PointCloud<Point>::Ptr& cloud, int threads, std::int64_t most,
                        const std::function<void(MultiresolutionParameters&)>& change) {
  MlsMultiresolution<Point> step;
  setUp(cloud, threads, step);
  change(step.parameters());
  pcl::PolygonMesh mesh;
  failEverywhere({[&]() -> const Status& {
                    step.reconstruct(mesh);
                    return step.status();
                  },
                  [&] {
                    return testing::isEmpty(mesh) && step.getLevelCount() == 0 && step.reports().empty() &&
                           !step.status().message.empty();
                  },
                  [&] { return bytesOf(mesh); }},
                 most);
}

TEST(AllocationFailure, OfAnyAllocationOfATinyReconstruction) {
  failReconstruction(sphere(24), 1, kUnlimited,
                     [](MultiresolutionParameters& p) { p.refinement.levels = 1; });
}

TEST(AllocationFailure, OfReconstructionsOfEveryKind) {
  for (const int threads : {1, 3}) {
    const std::int64_t most = threads == 1 ? 100 : 30;
    failReconstruction(sphere(600), threads, most, [](MultiresolutionParameters&) {});
    failReconstruction(sphere(300), threads, most, [](MultiresolutionParameters& p) { p.reduce = false; });
    failReconstruction(boxWithStrays(), threads, most, [](MultiresolutionParameters&) {});
    failReconstruction(testing::cloudOf<Point>(testing::cylinderPoints(40, 16)), threads, most,
                       [](MultiresolutionParameters& p) { p.watertight = true; });
  }
}

TEST(AllocationFailure, OfTheLevels) {
  MlsMultiresolution<Point> step;
  setUp(sphere(100), 1, step);
  step.compute();
  ASSERT_TRUE(step.status().ok());
  for (std::int64_t n = 1;; ++n) {
    pcl::PolygonMesh mesh = testing::usedMesh();
    bool made = false;
    {
      const Short shortness(Shortage::Once, n);
      made = step.getLevel(0, mesh);
    }
    if (made) {
      EXPECT_GT(n, 1);
      break;
    }
    ASSERT_TRUE(testing::isEmpty(mesh)) << n;
  }
}

TEST(AllocationFailure, OfClustering) {
  BspClustering<Point> step;
  setUp(sphere(400), 2, step);
  std::vector<pcl::PointIndices> clusters;
  failEverywhere({[&]() -> const Status& {
                    step.extract(clusters);
                    return step.status();
                  },
                  [&] { return clusters.empty(); }, [&] { return std::to_string(clusters.size()); }});
}

TEST(AllocationFailure, OfReduction) {
  MlsReduction<Point, Point> step;
  setUp(sphere(400), 2, step);
  pcl::PointCloud<Point> output;
  failEverywhere({[&]() -> const Status& {
                    step.process(output);
                    return step.status();
                  },
                  [&] { return testing::isEmpty(output) && step.clusterSizes().empty(); },
                  [&] {
                    std::string bytes;
                    for (const Point& p : output) bytes.append(reinterpret_cast<const char*>(p.data), 12);
                    return bytes;
                  }});
}

TEST(AllocationFailure, OfTriangulation) {
  AdvancingFrontTriangulation<Point> step;
  setUp(sphere(300), 2, step);
  std::vector<pcl::Vertices> polygons;
  failEverywhere({[&]() -> const Status& {
                    step.reconstruct(polygons);
                    return step.status();
                  },
                  [&] { return polygons.empty(); }, [&] { return bytesOf(polygons); }});
}

TEST(AllocationFailure, OfRefinement) {
  const auto cloud = sphere(300);
  MlsMultiresolution<Point> first;
  setUp(cloud, 1, first);
  first.setLevels(0);
  const pcl::PolygonMesh::Ptr coarse(new pcl::PolygonMesh);
  first.reconstruct(*coarse);
  ASSERT_TRUE(first.status().ok());
  MlsRefinement<Point> step;
  setUp(cloud, 2, step);
  step.setInputMesh(coarse);
  step.setLevels(2);
  pcl::PolygonMesh mesh;
  failEverywhere({[&]() -> const Status& {
                    step.process(mesh);
                    return step.status();
                  },
                  [&] { return testing::isEmpty(mesh) && step.getLevelCount() == 0; },
                  [&] { return bytesOf(mesh); }});
}

TEST(AllocationFailure, OfTheSurface) {
  MlsSurface<Point> step;
  setUp(sphere(300), 2, step);
  failEverywhere({[&]() -> const Status& {
                    step.compute();
                    return step.status();
                  },
                  [&] { return !step.ready(); },
                  [&] { return std::to_string(step.project(core::Vec3(0, 0, 1.1)).position.z()); }});
}

TEST(AllocationFailure, IsToldWithoutMemoryForTheText) {
  for (const bool is_ours : {true, false}) {
    const core::Failure failure(StatusCode::NoTriangles, std::string(100, 'x'));
    const Short shortness(Shortage::FromThenOn, 1);
    const Status status = core::guarded([&] {
      if (is_ours) throw core::Failure(failure);
      throw std::bad_alloc();
    });
    EXPECT_EQ(status.code, is_ours ? StatusCode::NoTriangles : StatusCode::OutOfMemory);
    EXPECT_EQ(status.message, "out of memory");
  }
}

}  // namespace
}  // namespace mlsmesh
