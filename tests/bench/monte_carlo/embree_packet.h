// A packet of `kWidth` rays for Embree: RTCRayHit, RTCRayHit4, RTCRayHit8 and RTCRayHit16 as one template. Their
// layouts differ only in the width.
#pragma once

#include <embree3/rtcore.h>

#include <algorithm>

namespace albtpu::bench {

template <int kWidth>
struct alignas(std::clamp(4 * kWidth, 16, 64)) EmbreePacket {
  float origin_x[kWidth], origin_y[kWidth], origin_z[kWidth], near[kWidth];
  float direction_x[kWidth], direction_y[kWidth], direction_z[kWidth], time[kWidth];
  float far[kWidth];  // m along the ray; after a hit, the distance to it
  unsigned mask[kWidth], id[kWidth], flags[kWidth];
  float normal_x[kWidth], normal_y[kWidth], normal_z[kWidth];  // of the triangle, of any length
  float u[kWidth], v[kWidth];
  unsigned primitive[kWidth], geometry[kWidth], instance[kWidth];
};
static_assert(sizeof(EmbreePacket<1>) == sizeof(RTCRayHit) && sizeof(EmbreePacket<4>) == sizeof(RTCRayHit4) &&
              sizeof(EmbreePacket<8>) == sizeof(RTCRayHit8) && sizeof(EmbreePacket<16>) == sizeof(RTCRayHit16));

// One packet at a time.
inline void Intersect(RTCScene scene, RTCIntersectContext* context, EmbreePacket<1>& packet) {
  rtcIntersect1(scene, context, reinterpret_cast<RTCRayHit*>(&packet));
}
inline constexpr struct {
  alignas(64) int lanes[16] = {-1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1};
} kAllValid;
inline void Intersect(RTCScene scene, RTCIntersectContext* context, EmbreePacket<4>& packet) {
  rtcIntersect4(kAllValid.lanes, scene, context, reinterpret_cast<RTCRayHit4*>(&packet));
}
inline void Intersect(RTCScene scene, RTCIntersectContext* context, EmbreePacket<8>& packet) {
  rtcIntersect8(kAllValid.lanes, scene, context, reinterpret_cast<RTCRayHit8*>(&packet));
}
inline void Intersect(RTCScene scene, RTCIntersectContext* context, EmbreePacket<16>& packet) {
  rtcIntersect16(kAllValid.lanes, scene, context, reinterpret_cast<RTCRayHit16*>(&packet));
}

// As a stream.
inline void IntersectStream(RTCScene scene, RTCIntersectContext* context, EmbreePacket<1>* packets, int count) {
  rtcIntersect1M(scene, context, reinterpret_cast<RTCRayHit*>(packets), static_cast<unsigned>(count),
                 sizeof(EmbreePacket<1>));
}
template <int kWidth>
void IntersectStream(RTCScene scene, RTCIntersectContext* context, EmbreePacket<kWidth>* packets, int count) {
  rtcIntersectNM(scene, context, reinterpret_cast<RTCRayHitN*>(packets), kWidth, static_cast<unsigned>(count),
                 sizeof(EmbreePacket<kWidth>));
}

// As a stream of pointers to arrays.
template <int kWidth>
void IntersectArrays(RTCScene scene, RTCIntersectContext* context, EmbreePacket<kWidth>& p, int count) {
  const RTCRayHitNp arrays = {
      .ray = {p.origin_x, p.origin_y, p.origin_z, p.near, p.direction_x, p.direction_y, p.direction_z, p.time, p.far,
              p.mask, p.id, p.flags},
      .hit = {p.normal_x, p.normal_y, p.normal_z, p.u, p.v, p.primitive, p.geometry, {p.instance}}};
  rtcIntersectNp(scene, context, &arrays, static_cast<unsigned>(count));
}

}  // namespace albtpu::bench
