#include "tests/bench/monte_carlo/embree_tracer.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace albtpu::bench {
namespace {

constexpr float kStart = 0.5f;  // m above the mean surface
constexpr float kFar = 10;      // m along the ray
constexpr int kBlock = 1024;    // number of rays that are traced and then refracted together

RTCBuildQuality QualityOf(EmbreeBuild build) {
  switch (build) {
    case EmbreeBuild::kHigh:
      return RTC_BUILD_QUALITY_HIGH;
    case EmbreeBuild::kMedium:
      return RTC_BUILD_QUALITY_MEDIUM;
    case EmbreeBuild::kLow:
      return RTC_BUILD_QUALITY_LOW;
    case EmbreeBuild::kRefit:
      return RTC_BUILD_QUALITY_REFIT;
  }
  return RTC_BUILD_QUALITY_MEDIUM;
}

// Embree divides the cells of a grid along the diagonal from the end of their first row to the beginning of the second.
// With columns in reverse order, that is the diagonal from the low corner to the high one.
int VertexAt(int ix, int iy, int points) { return ix * points + points - 1 - iy; }

void SetTriangles(RTCGeometry geometry, int points) {
  const std::size_t count = 2 * static_cast<std::size_t>(points - 1) * (points - 1);
  auto* corner = static_cast<unsigned*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), count));
  for (int ix = 0; ix + 1 < points; ++ix) {
    for (int iy = 0; iy + 1 < points; ++iy) {
      const int low = VertexAt(ix, iy, points), high = VertexAt(ix + 1, iy + 1, points);
      for (const int third : {VertexAt(ix + 1, iy, points), VertexAt(ix, iy + 1, points)})
        for (const int vertex : {low, third, high}) *corner++ = static_cast<unsigned>(vertex);
    }
  }
}

void SetGrid(RTCGeometry geometry, int points) {
  auto* grid = static_cast<RTCGrid*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_GRID, 0, RTC_FORMAT_GRID, sizeof(RTCGrid), 1));
  const auto side = static_cast<unsigned short>(points);
  *grid = {.startVertexID = 0, .stride = side, .width = side, .height = side};
}

}  // namespace

std::string Name(const EmbreeOptions& options) {
  static constexpr const char* kBuilds[] = {"high", "medium", "low", "refit"};
  static constexpr const char* kRays[] = {"1", "4", "8", "16", "1M", "8M", "Np"};
  std::string name = options.geometry == EmbreeGeometry::kGrid ? "grid" : "triangles";
  name += std::string("/") + kBuilds[static_cast<int>(options.build)];
  name += std::string("/") + kRays[static_cast<int>(options.rays)];
  name += options.robust ? "/robust" : "/fast";
  name += options.coherent ? "/coherent" : "/incoherent";
  return name;
}

EmbreeTracer::EmbreeTracer(const EmbreeOptions& options, int points, float spacing)
    : options_(options), points_(points), query_(QueryOf(options.coherent)) {
  const std::string device = "threads=1" + (options.device.empty() ? "" : "," + options.device);
  device_ = rtcNewDevice(device.c_str());
  assert(device_ != nullptr);
  scene_ = rtcNewScene(device_);
  const bool moving = options.build == EmbreeBuild::kRefit || options.build == EmbreeBuild::kLow;
  rtcSetSceneFlags(scene_, (options.robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE) |
                               (moving ? RTC_SCENE_FLAG_DYNAMIC : RTC_SCENE_FLAG_NONE));
  // A scene with a refitted mesh needs the low build quality.
  rtcSetSceneBuildQuality(scene_, moving ? RTC_BUILD_QUALITY_LOW : QualityOf(options.build));
  const bool grid = options.geometry == EmbreeGeometry::kGrid;
  geometry_ = rtcNewGeometry(device_, grid ? RTC_GEOMETRY_TYPE_GRID : RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetGeometryBuildQuality(geometry_, QualityOf(options.build));
  const std::size_t count = static_cast<std::size_t>(points) * points;
  vertices_ = static_cast<float*>(
      rtcSetNewGeometryBuffer(geometry_, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), count));
  const int centre = (points - 1) / 2;
  for (int ix = 0; ix < points; ++ix) {
    for (int iy = 0; iy < points; ++iy) {
      float* vertex = vertices_ + 3 * VertexAt(ix, iy, points);
      vertex[0] = static_cast<float>(ix - centre) * spacing;
      vertex[1] = static_cast<float>(iy - centre) * spacing;
      vertex[2] = 0;
    }
  }
  grid ? SetGrid(geometry_, points) : SetTriangles(geometry_, points);
  rtcCommitGeometry(geometry_);
  rtcAttachGeometry(scene_, geometry_);
}

EmbreeTracer::~EmbreeTracer() {
  rtcReleaseGeometry(geometry_);
  rtcReleaseScene(scene_);
  rtcReleaseDevice(device_);
}

void EmbreeTracer::SetHeights(const float* heights) {
  for (int ix = 0; ix < points_; ++ix)
    for (int iy = 0; iy < points_; ++iy) vertices_[3 * VertexAt(ix, iy, points_) + 2] = *heights++;
  rtcUpdateGeometryBuffer(geometry_, RTC_BUFFER_TYPE_VERTEX, 0);
  rtcCommitGeometry(geometry_);
  rtcCommitScene(scene_);
}

// The intersections of a block of rays with the surface; zeros for rays that found none.
struct EmbreeTracer::Hits {
  alignas(64) float height[kBlock];  // m
  alignas(64) float slope_x[kBlock], slope_y[kBlock];
  alignas(64) float found[kBlock];  // 1 or 0
};

template <int kWidth>
void EmbreeTracer::TraceBlock(const FloatRays& rays, int first, int count, Hits& hits) {
  static_assert(kBlock % kWidth == 0);
  static thread_local std::array<EmbreePacket<kWidth>, kBlock / kWidth> packets;
  const Eigen::Vector3f direction = rays.direction.cast<float>();
  const Eigen::Vector2f shift = kStart / direction.z() * direction.head<2>();
  const int used = (count + kWidth - 1) / kWidth;
  for (int p = 0; p < used; ++p) {
    EmbreePacket<kWidth>& packet = packets[p];
    for (int lane = 0; lane < kWidth; ++lane) {
      const int r = first + std::min(p * kWidth + lane, count - 1);  // the last ray fills up the last packet
      packet.origin_x[lane] = rays.x[r] + shift.x();
      packet.origin_y[lane] = rays.y[r] + shift.y();
    }
    std::fill_n(packet.origin_z, kWidth, kStart);
    std::fill_n(packet.near, kWidth, 0.0f);
    std::fill_n(packet.direction_x, kWidth, direction.x());
    std::fill_n(packet.direction_y, kWidth, direction.y());
    std::fill_n(packet.direction_z, kWidth, direction.z());
    std::fill_n(packet.time, kWidth, 0.0f);
    std::fill_n(packet.far, kWidth, kFar);
    std::fill_n(packet.mask, kWidth, ~0u);
    std::fill_n(packet.flags, kWidth, 0u);
    std::fill_n(packet.geometry, kWidth, RTC_INVALID_GEOMETRY_ID);
    std::fill_n(packet.instance, kWidth, RTC_INVALID_GEOMETRY_ID);
  }
#if ALBTPU_EMBREE == 3
  if constexpr (kWidth == kBlock) {
    IntersectArrays(scene_, &query_, packets[0], count);
  } else if (options_.rays == EmbreeRays::k1M || options_.rays == EmbreeRays::k8M) {
    if constexpr (kWidth == 1 || kWidth == 8) IntersectStream(scene_, &query_, packets.data(), used);
  } else
#endif
  {
    for (int p = 0; p < used; ++p) Intersect(scene_, &query_, packets[p]);
  }
  for (int p = 0; p < used; ++p) {
    const EmbreePacket<kWidth>& packet = packets[p];
    for (int lane = 0; lane < kWidth; ++lane) {
      const int i = p * kWidth + lane;
      const bool found = packet.geometry[lane] != RTC_INVALID_GEOMETRY_ID;
      hits.found[i] = found ? 1.0f : 0.0f;
      hits.height[i] = found ? kStart + packet.far[lane] * direction.z() : 0.0f;
      hits.slope_x[i] = found ? -packet.normal_x[lane] / packet.normal_z[lane] : 0.0f;
      hits.slope_y[i] = found ? -packet.normal_y[lane] / packet.normal_z[lane] : 0.0f;
    }
  }
}

BeamMeans EmbreeTracer::Trace(const FloatRays& rays, double refractive_index) {
  const int total = static_cast<int>(rays.x.size());
  hit_heights_.resize(total);
  const float ratio = static_cast<float>(1 / refractive_index);
  const Eigen::Vector3f direction = ratio * rays.direction.cast<float>();
  const float dx = direction.x(), dy = direction.y(), dz = direction.z();
  static thread_local Hits hits;
  double sums[8] = {};
  for (int first = 0; first < total; first += kBlock) {
    const int count = std::min(kBlock, total - first);
    switch (options_.rays) {
      case EmbreeRays::k1:
      case EmbreeRays::k1M:
        TraceBlock<1>(rays, first, count, hits);
        break;
      case EmbreeRays::k4:
        TraceBlock<4>(rays, first, count, hits);
        break;
      case EmbreeRays::k8:
      case EmbreeRays::k8M:
        TraceBlock<8>(rays, first, count, hits);
        break;
      case EmbreeRays::k16:
        TraceBlock<16>(rays, first, count, hits);
        break;
      case EmbreeRays::kNp:
#if ALBTPU_EMBREE == 3
        TraceBlock<kBlock>(rays, first, count, hits);
#endif
        break;
    }
    // RefractAtSlope of sea/response/closed_form.h, vectorized.
    float found = 0, height = 0, tx = 0, ty = 0, secants = 0, htx = 0, hty = 0, hs = 0;
#pragma omp simd reduction(+ : found, height, tx, ty, secants, htx, hty, hs)
    for (int i = 0; i < count; ++i) {
      const float mx = hits.slope_x[i], my = hits.slope_y[i], h = hits.height[i], weight = hits.found[i];
      const float q = 1 + mx * mx + my * my;
      const float v = mx * dx + my * dy - dz;
      const float lift = (v - std::sqrt(q * (1 - ratio * ratio) + v * v)) / q;
      const float secant = -weight / (dz + lift);
      const float tangent_x = (dx - lift * mx) * secant, tangent_y = (dy - lift * my) * secant;
      found += weight;
      height += h;
      tx += tangent_x;
      ty += tangent_y;
      secants += secant;
      htx += h * tangent_x;
      hty += h * tangent_y;
      hs += h * secant;
    }
    const float block[8] = {found, height, tx, ty, secants, htx, hty, hs};
    for (int s = 0; s < 8; ++s) sums[s] += block[s];
    for (int i = 0; i < count; ++i)
      hit_heights_[first + i] = hits.found[i] != 0 ? hits.height[i] : std::numeric_limits<float>::quiet_NaN();
  }
  const double count = sums[0];
  const double height = sums[1] / count;
  BeamMeans means{.tangent_x = sums[2] / count,
                  .tangent_y = sums[3] / count,
                  .secant = sums[4] / count,
                  .height_tangent_x = sums[5] / count,
                  .height_tangent_y = sums[6] / count,
                  .height_secant = sums[7] / count,
                  .lost = total - static_cast<int>(count)};
  means.height_tangent_x -= height * means.tangent_x;
  means.height_tangent_y -= height * means.tangent_y;
  means.height_secant -= height * means.secant;
  return means;
}

}  // namespace albtpu::bench
