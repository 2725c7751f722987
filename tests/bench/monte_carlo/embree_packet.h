// A packet of `kWidth` rays for Embree: RTCRayHit, RTCRayHit4, RTCRayHit8 and RTCRayHit16 as one template. Their
// layouts differ only in the width. ALBTPU_EMBREE is the major version of Embree, 3 or 4; only 3 has streams of rays.
#pragma once

#if ALBTPU_EMBREE == 3
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif

#include <algorithm>

namespace albtpu::bench {

// How the rays of a call are to be traced.
#if ALBTPU_EMBREE == 3
using EmbreeQuery = RTCIntersectContext;
#else
using EmbreeQuery = RTCIntersectArguments;
#endif
inline EmbreeQuery QueryOf(bool coherent_rays) {
  EmbreeQuery query;
#if ALBTPU_EMBREE == 3
  rtcInitIntersectContext(&query);
  query.flags = coherent_rays ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
#else
  rtcInitIntersectArguments(&query);
  query.flags = coherent_rays ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
#endif
  return query;
}

template <int kWidth>
struct alignas(std::clamp(4 * kWidth, 16, 64)) EmbreePacket {
  float origin_x[kWidth], origin_y[kWidth], origin_z[kWidth], near[kWidth];
  float direction_x[kWidth], direction_y[kWidth], direction_z[kWidth], time[kWidth];
  float far[kWidth];  // m along the ray; after a hit, the distance to it
  unsigned mask[kWidth], id[kWidth], flags[kWidth];
  float normal_x[kWidth], normal_y[kWidth], normal_z[kWidth];  // of the triangle, of any length
  float u[kWidth], v[kWidth];
  unsigned primitive[kWidth], geometry[kWidth], instance[kWidth];
#ifdef RTC_GEOMETRY_INSTANCE_ARRAY  // of Embree 4.3
  unsigned instance_primitive[kWidth];
#endif
};
static_assert(sizeof(EmbreePacket<1>) == sizeof(RTCRayHit) && sizeof(EmbreePacket<4>) == sizeof(RTCRayHit4) &&
              sizeof(EmbreePacket<8>) == sizeof(RTCRayHit8) && sizeof(EmbreePacket<16>) == sizeof(RTCRayHit16));

// One packet at a time, by rtcIntersect1, 4, 8 or 16.
template <typename Function, typename RayHit, typename... Valid>
void Intersect(Function* intersect, RTCScene scene, EmbreeQuery* query, RayHit* rays, Valid... valid) {
#if ALBTPU_EMBREE == 3
  intersect(valid..., scene, query, rays);
#else
  intersect(valid..., scene, rays, query);
#endif
}
inline constexpr struct {
  alignas(64) int lanes[16] = {-1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1};
} kAllValid;
inline void Intersect(RTCScene scene, EmbreeQuery* query, EmbreePacket<1>& packet) {
  Intersect(rtcIntersect1, scene, query, reinterpret_cast<RTCRayHit*>(&packet));
}
inline void Intersect(RTCScene scene, EmbreeQuery* query, EmbreePacket<4>& packet) {
  Intersect(rtcIntersect4, scene, query, reinterpret_cast<RTCRayHit4*>(&packet), kAllValid.lanes);
}
inline void Intersect(RTCScene scene, EmbreeQuery* query, EmbreePacket<8>& packet) {
  Intersect(rtcIntersect8, scene, query, reinterpret_cast<RTCRayHit8*>(&packet), kAllValid.lanes);
}
inline void Intersect(RTCScene scene, EmbreeQuery* query, EmbreePacket<16>& packet) {
  Intersect(rtcIntersect16, scene, query, reinterpret_cast<RTCRayHit16*>(&packet), kAllValid.lanes);
}

#if ALBTPU_EMBREE == 3
// As a stream.
inline void IntersectStream(RTCScene scene, EmbreeQuery* query, EmbreePacket<1>* packets, int count) {
  rtcIntersect1M(scene, query, reinterpret_cast<RTCRayHit*>(packets), static_cast<unsigned>(count),
                 sizeof(EmbreePacket<1>));
}
template <int kWidth>
void IntersectStream(RTCScene scene, EmbreeQuery* query, EmbreePacket<kWidth>* packets, int count) {
  rtcIntersectNM(scene, query, reinterpret_cast<RTCRayHitN*>(packets), kWidth, static_cast<unsigned>(count),
                 sizeof(EmbreePacket<kWidth>));
}

// As a stream of pointers to arrays.
template <int kWidth>
void IntersectArrays(RTCScene scene, EmbreeQuery* query, EmbreePacket<kWidth>& p, int count) {
  const RTCRayHitNp arrays = {
      .ray = {p.origin_x, p.origin_y, p.origin_z, p.near, p.direction_x, p.direction_y, p.direction_z, p.time, p.far,
              p.mask, p.id, p.flags},
      .hit = {p.normal_x, p.normal_y, p.normal_z, p.u, p.v, p.primitive, p.geometry, {p.instance}}};
  rtcIntersectNp(scene, query, &arrays, static_cast<unsigned>(count));
}
#endif

}  // namespace albtpu::bench
