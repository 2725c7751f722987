// Embree 3 or 4 as the tracer of a beam: the surface is a mesh in its tree and rays are in its packets; refraction and
// sums follow.
#pragma once

#include <string>
#include <vector>

#include "tests/bench/monte_carlo/beam_case.h"
#include "tests/bench/monte_carlo/embree_packet.h"

namespace albtpu::bench {

enum class EmbreeGeometry { kTriangles, kGrid };
enum class EmbreeBuild { kHigh, kMedium, kLow, kRefit };   // rtcSetGeometryBuildQuality and rtcSetSceneBuildQuality
enum class EmbreeRays { k1, k4, k8, k16, k1M, k8M, kNp };  // rtcIntersect...: one ray, packets, streams

// Those that this version of Embree has.
inline constexpr EmbreeRays kEmbreeRays[] = {
    EmbreeRays::k1,  EmbreeRays::k4,  EmbreeRays::k8,  EmbreeRays::k16,
#if ALBTPU_EMBREE == 3
    EmbreeRays::k1M, EmbreeRays::k8M, EmbreeRays::kNp,
#endif
};

struct EmbreeOptions {
  EmbreeGeometry geometry = EmbreeGeometry::kTriangles;
  EmbreeBuild build = EmbreeBuild::kHigh;
  EmbreeRays rays = EmbreeRays::k8;
  bool robust = true;
  bool coherent = true;
  std::string device = {};  // more of rtcNewDevice's configuration, such as "isa=avx2"
};
std::string Name(const EmbreeOptions& options);  // such as "triangles/high/8/robust/coherent"

// Runs on one thread. Rays start half a metre above the mean surface, higher than the waves.
class EmbreeTracer {
 public:
  EmbreeTracer(const EmbreeOptions& options, int points, float spacing);
  ~EmbreeTracer();
  EmbreeTracer(const EmbreeTracer&) = delete;
  EmbreeTracer& operator=(const EmbreeTracer&) = delete;

  // Moves the vertices to new heights (row-major, ix slow) and builds or refits the tree.
  void SetHeights(const float* heights);

  BeamMeans Trace(const FloatRays& rays, double refractive_index);

  // The heights at which the rays of the last beam met the surface, in its order, m; NaN for lost rays.
  const std::vector<float>& hit_heights() const { return hit_heights_; }

 private:
  struct Hits;
  template <int kWidth>
  void TraceBlock(const FloatRays& rays, int first, int count, Hits& hits);

  EmbreeOptions options_;
  int points_;
  RTCDevice device_;
  RTCScene scene_;
  RTCGeometry geometry_;
  float* vertices_;
  EmbreeQuery query_;
  std::vector<float> hit_heights_;
};

}  // namespace albtpu::bench
