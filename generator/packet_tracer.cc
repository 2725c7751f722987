#include "generator/packet_tracer.h"

#include <cassert>
#include <cstddef>
#include <cstdint>

#include "generator/packet_sums.h"

// What follows is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "generator/packet_tracer.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace albtpu {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::CappedTag<float, 8>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;
constexpr D d;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(d));

// Packets that walk side by side, so that one does not wait for another's loads: one ray of each strip.
constexpr int kPackets = RayBundle::kStrips / kLanes;
static_assert(kPackets * kLanes == RayBundle::kStrips);

// The two heights `at` and after each index.
HWY_INLINE void LoadPairs(const float* heights, const std::int32_t* at, V& first, V& second) {
#if HWY_TARGET == HWY_SCALAR
  first = hn::Set(d, heights[at[0]]);
  second = hn::Set(d, heights[at[0] + 1]);
#else
  const hn::CappedTag<float, 2> pair;
  const hn::CappedTag<float, 4> pairs;
  const auto low = hn::Combine(pairs, hn::LoadU(pair, heights + at[1]), hn::LoadU(pair, heights + at[0]));
  const auto high = hn::Combine(pairs, hn::LoadU(pair, heights + at[3]), hn::LoadU(pair, heights + at[2]));
#if HWY_TARGET == HWY_AVX2
  const auto low2 = hn::Combine(pairs, hn::LoadU(pair, heights + at[5]), hn::LoadU(pair, heights + at[4]));
  const auto high2 = hn::Combine(pairs, hn::LoadU(pair, heights + at[7]), hn::LoadU(pair, heights + at[6]));
  first = hn::Combine(d, hn::ConcatEven(pairs, high2, low2), hn::ConcatEven(pairs, high, low));
  second = hn::Combine(d, hn::ConcatOdd(pairs, high2, low2), hn::ConcatOdd(pairs, high, low));
#else
  first = hn::ConcatEven(pairs, high, low);
  second = hn::ConcatOdd(pairs, high, low);
#endif
#endif
}

// The surface under a beam: lengths in steps of the grid, from the centre of its lowest cell.
struct Grid {
  const float* heights;  // m
  std::ptrdiff_t stride;
  V stride_steps, last_cell;
  V steps_per_metre, origin;
  V x_per_height, y_per_height;  // steps per m, of the rays

  Grid(const RayBundle& rays, const HeightWindow& surface)
      : heights(surface.heights),
        stride(surface.stride),
        stride_steps(hn::Set(d, static_cast<float>(surface.stride))),
        last_cell(hn::Set(d, static_cast<float>(surface.points - 2))),
        steps_per_metre(hn::Set(d, 1 / surface.spacing)),
        origin(hn::Set(d, static_cast<float>((surface.points - 1) / 2) - 0.5f)),
        x_per_height(hn::Set(d, static_cast<float>(rays.x_per_height()) / surface.spacing)),
        y_per_height(hn::Set(d, static_cast<float>(rays.y_per_height()) / surface.spacing)) {}
};

// Rays on their way. (Vectors are named one by one and never copied as a whole: g++ 12 copies such structures
// by way of general registers, at half the speed.)
struct Packet {
  V x_at_zero, y_at_zero;  // steps
  V z;                     // m, the height that is tried
  V cell_x, cell_y;        // steps; that of y with kMagic
  V from_x, from_y;        // steps from the centre of the cell to the ray
  M beside_x;              // which of the cell's triangles
  V rise_x, rise_y;        // m a step, of its plane
  V middle;                // m, height of the plane at the centre of the cell, which both triangles share
  M settled;

  HWY_INLINE void Start(const Grid& grid, const float* x, const float* y) {
    x_at_zero = hn::MulAdd(hn::LoadU(d, x), grid.steps_per_metre, grid.origin);
    y_at_zero = hn::MulAdd(hn::LoadU(d, y), grid.steps_per_metre, grid.origin);
  }

  // The cell under or over the point (x, y); beyond the edge, one of the outermost. Adding kMagic rounds to
  // the nearest whole number and leaves it in the low bits.
  static constexpr float kMagic = 0x1p23f;
  HWY_INLINE void EnterCellAt(const Grid& grid, V x, V y) {
    const V magic = hn::Set(d, kMagic);
    cell_x = hn::Sub(hn::Add(hn::Min(hn::Max(x, hn::Zero(d)), grid.last_cell), magic), magic);
    cell_y = hn::Add(hn::Min(hn::Max(y, hn::Zero(d)), grid.last_cell), magic);
    from_x = hn::Sub(x, cell_x);
    from_y = hn::Sub(y, hn::Sub(cell_y, magic));
    beside_x = hn::Gt(from_x, from_y);
  }
  HWY_INLINE void EnterCellAtHeight(const Grid& grid) {
    EnterCellAt(grid, hn::MulAdd(z, grid.x_per_height, x_at_zero),
                hn::MulAdd(z, grid.y_per_height, y_at_zero));
  }

  HWY_INLINE void TakeFacet(const Grid& grid) {
    const hn::RebindToSigned<D> di;
    HWY_ALIGN std::int32_t at[kLanes];
    const auto index = hn::BitCast(di, hn::MulAdd(cell_x, grid.stride_steps, cell_y));
    hn::Store(hn::And(index, hn::Set(di, 0x7fffff)), di, at);
    V low, along_y, along_x, high;
    LoadPairs(grid.heights, at, low, along_y);
    LoadPairs(grid.heights + grid.stride, at, along_x, high);
    const V third = hn::IfThenElse(beside_x, along_x, along_y);
    const V from_low = hn::Sub(third, low), to_high = hn::Sub(high, third);
    rise_x = hn::IfThenElse(beside_x, from_low, to_high);
    rise_y = hn::IfThenElse(beside_x, to_high, from_low);
    middle = hn::Mul(hn::Add(low, high), hn::Set(d, 0.5f));
  }

  HWY_INLINE V SurfaceHeight() const {
    return hn::MulAdd(rise_x, from_x, hn::MulAdd(rise_y, from_y, middle));
  }

  // One step of Newton, from the cell that was entered to the meeting with the plane of its facet, and into
  // the cell there. Settled are rays that this leaves in the triangle, and those that it hardly moves: on an
  // edge either of two facets is right.
  HWY_INLINE void Step(const Grid& grid, V tolerance) {
    TakeFacet(grid);
    const V approach =
        hn::NegMulAdd(rise_x, grid.x_per_height, hn::NegMulAdd(rise_y, grid.y_per_height, hn::Set(d, 1.0f)));
    const V least_approach =
        hn::Set(d, 0.1f);  // over a facet that turns away a step still goes the right way
    const V last_z = z, last_x = cell_x, last_y = cell_y;
    const M last_beside_x = beside_x;
    z = hn::Add(z, hn::Div(hn::Sub(SurfaceHeight(), z), hn::Max(approach, least_approach)));
    EnterCellAtHeight(grid);
    const M same_cell = hn::And(hn::Eq(cell_x, last_x), hn::Eq(cell_y, last_y));
    const M on_plane = hn::AndNot(hn::Xor(beside_x, last_beside_x), hn::Ge(approach, least_approach));
    settled = hn::Or(hn::And(same_cell, on_plane), hn::Le(hn::Abs(hn::Sub(z, last_z)), tolerance));
  }

  // The meetings that are not settled, one by one.
  HWY_NOINLINE int MeetAlone(const RayBundle& rays, const HeightWindow& surface, int first) {
    HWY_ALIGN float height[kLanes], x[kLanes], y[kLanes], known[kLanes];
    hn::Store(z, d, height);
    hn::Store(rise_x, d, x);
    hn::Store(rise_y, d, y);
    hn::Store(hn::IfThenElseZero(settled, hn::Set(d, 1.0f)), d, known);
    int count = 0;
    for (int lane = 0; lane < kLanes; ++lane) {
      if (known[lane] != 0) continue;
      MeetOne(rays, surface, first + lane, height[lane], x[lane], y[lane]);
      if (first + lane < rays.count()) ++count;
    }
    z = hn::Load(d, height);
    rise_x = hn::Load(d, x);
    rise_y = hn::Load(d, y);
    return count;
  }

  // Rays that stand for none meet still water, which adds nothing to any sum.
  HWY_INLINE void KeepFirst(int rays) {
    const M real = hn::FirstN(d, static_cast<std::size_t>(HWY_MAX(0, HWY_MIN(rays, kLanes))));
    z = hn::IfThenElseZero(real, z);
    rise_x = hn::IfThenElseZero(real, rise_x);
    rise_y = hn::IfThenElseZero(real, rise_y);
  }
};

// Snell's law as RefractAtSlope has it, less what still water does. With r = 1 / n, c the cosine of the
// incidence, h the horizontal part of the incident direction and s0 = sqrt(1 - r^2 + r^2 c^2), on a slope m,
// with mu = r m . h,
//     D = |m|^2 (1 - r^2) + 2 r c mu + mu^2,    s = sqrt(s0^2 + D),    lift = s - r c - mu,
//     q = r c (1 + |m|^2) + lift,
//     secant - 1 / s0 = (|m|^2 (s0 - r c) + mu - D / (s + s0)) / (s0 q),
//     tangent - r h / s0 = r h (secant - 1 / s0) + m lift / q.
struct Optics {
  V steps_per_metre;
  V s0, s0_squared, inverse_s0, rc, two_rc, s0_less_rc, rhx, rhy, one_less_r2;

  Optics(const Grid& grid, const StillWater& still)
      : steps_per_metre(grid.steps_per_metre),
        s0(hn::Set(d, still.s0)),
        s0_squared(hn::Set(d, still.s0 * still.s0)),
        inverse_s0(hn::Set(d, 1 / still.s0)),
        rc(hn::Set(d, still.rc)),
        two_rc(hn::Set(d, 2 * still.rc)),
        s0_less_rc(hn::Set(d, still.s0 - still.rc)),
        rhx(hn::Set(d, still.rhx)),
        rhy(hn::Set(d, still.rhy)),
        one_less_r2(hn::Set(d, still.one_less_r2)) {}

  HWY_INLINE void Add(const Packet& packet, V* sum) const {
    const V z = packet.z;
    const V mx = hn::Mul(packet.rise_x, steps_per_metre), my = hn::Mul(packet.rise_y, steps_per_metre);
    const V mxx = hn::Mul(mx, mx), myy = hn::Mul(my, my);
    const V mm = hn::Add(mxx, myy);
    const V mu = hn::MulAdd(mx, rhx, hn::Mul(my, rhy));
    const V difference = hn::MulAdd(mm, one_less_r2, hn::Mul(mu, hn::Add(two_rc, mu)));
    const V s = hn::Sqrt(hn::Add(s0_squared, difference));
    const V lift = hn::Sub(s, hn::Add(rc, mu));
    const V q = hn::Add(hn::MulAdd(rc, mm, rc), lift);
    const V both = hn::Add(s, s0);
    const V inverse = hn::Div(hn::Set(d, 1.0f), hn::Mul(both, q));
    const V secant =
        hn::Mul(hn::MulSub(hn::MulAdd(mm, s0_less_rc, mu), both, difference), hn::Mul(inverse, inverse_s0));
    const V gain = hn::Mul(hn::Mul(lift, both), inverse);
    const V tx = hn::MulAdd(gain, mx, hn::Mul(rhx, secant)), ty = hn::MulAdd(gain, my, hn::Mul(rhy, secant));
    sum[kHeight] = hn::Add(sum[kHeight], z);
    sum[kTangentX] = hn::Add(sum[kTangentX], tx);
    sum[kTangentY] = hn::Add(sum[kTangentY], ty);
    sum[kSecant] = hn::Add(sum[kSecant], secant);
    sum[kHeightTangentX] = hn::MulAdd(z, tx, sum[kHeightTangentX]);
    sum[kHeightTangentY] = hn::MulAdd(z, ty, sum[kHeightTangentY]);
    sum[kHeightSecant] = hn::MulAdd(z, secant, sum[kHeightSecant]);
    sum[kSlopeX] = hn::Add(sum[kSlopeX], mx);
    sum[kSlopeY] = hn::Add(sum[kSlopeY], my);
    sum[kSlopeXX] = hn::Add(sum[kSlopeXX], mxx);
    sum[kSlopeYY] = hn::Add(sum[kSlopeYY], myy);
    sum[kSlopeXY] = hn::MulAdd(mx, my, sum[kSlopeXY]);
  }

  HWY_INLINE void AddHeightSlope(const Packet& packet, V* sum) const {
    const V z = hn::Mul(packet.z, steps_per_metre);
    sum[kUndisturbedHeightX] = hn::MulAdd(z, packet.rise_x, sum[kUndisturbedHeightX]);
    sum[kUndisturbedHeightY] = hn::MulAdd(z, packet.rise_y, sum[kUndisturbedHeightY]);
  }

  HWY_INLINE void AddUndisturbed(const Packet& packet, V* sum) const {
    AddHeightSlope(packet, sum);
    const V mx = hn::Mul(packet.rise_x, steps_per_metre), my = hn::Mul(packet.rise_y, steps_per_metre);
    sum[kUndisturbedHeight] = hn::Add(sum[kUndisturbedHeight], packet.z);
    sum[kUndisturbedX] = hn::Add(sum[kUndisturbedX], mx);
    sum[kUndisturbedY] = hn::Add(sum[kUndisturbedY], my);
    sum[kUndisturbedXX] = hn::MulAdd(mx, mx, sum[kUndisturbedXX]);
    sum[kUndisturbedYY] = hn::MulAdd(my, my, sum[kUndisturbedYY]);
    sum[kUndisturbedXY] = hn::MulAdd(mx, my, sum[kUndisturbedXY]);
  }
};

enum class Walk { kVertical, kSlanted, kSlantedAndUndisturbed };

// Sums over short blocks are in single precision, lane by lane.
constexpr int kBlock = 64 * RayBundle::kStrips;
constexpr int kMostSteps = 8;

template <Walk kWalk>
void SumRays(const RayBundle& rays, const HeightWindow& surface, PacketSums* sums) {
  const Grid grid(rays, surface);
  const Optics optics(grid, StillWaterOf(rays));
  const V tolerance = hn::Set(d, 0x1p-14f * surface.spacing);
  V start[kPackets];  // the height of the ray before in the same strip: a good first guess
  for (V& z : start) z = hn::Zero(d);
  for (int block = 0; block < rays.count(); block += kBlock) {
    V sum[kPacketSums];
    for (V& s : sum) s = hn::Zero(d);
    const int end = HWY_MIN(block + kBlock, rays.count());
    for (int row = block; row < end; row += RayBundle::kStrips) {
      const bool ragged = row + RayBundle::kStrips > rays.count();
      Packet packet[kPackets];
      for (int i = 0; i < kPackets; ++i) {
        const int first = row + i * kLanes;
        Packet& p = packet[i];
        p.Start(grid, rays.x() + first, rays.y() + first);
        if constexpr (kWalk != Walk::kSlanted) {
          p.EnterCellAt(grid, p.x_at_zero, p.y_at_zero);
          p.TakeFacet(grid);
          p.z = p.SurfaceHeight();
          if (ragged) p.KeepFirst(rays.count() - first);
          if constexpr (kWalk == Walk::kVertical) optics.AddHeightSlope(p, sum);
          if constexpr (kWalk == Walk::kSlantedAndUndisturbed) optics.AddUndisturbed(p, sum);
        }
        if constexpr (kWalk != Walk::kVertical) {
          p.z = start[i];
          p.EnterCellAtHeight(grid);
          p.Step(grid, tolerance);
        }
      }
      for (int i = 0; i < kPackets; ++i) {
        const int first = row + i * kLanes;
        Packet& p = packet[i];
        if constexpr (kWalk != Walk::kVertical) {
          for (int step = 1; step < kMostSteps && !hn::AllTrue(d, p.settled); ++step) p.Step(grid, tolerance);
          if (HWY_UNLIKELY(!hn::AllTrue(d, p.settled))) sums->met_alone += p.MeetAlone(rays, surface, first);
          start[i] = p.z;
          if (ragged) p.KeepFirst(rays.count() - first);
        }
        optics.Add(p, sum);
      }
    }
    HWY_ALIGN float lanes[kLanes];
    for (int k = 0; k < kPacketSums; ++k) {
      hn::Store(sum[k], d, lanes);
      for (const float lane : lanes) sums->sum[k] += static_cast<double>(lane);
    }
  }
}

void SumVertical(const RayBundle& rays, const HeightWindow& surface, PacketSums* sums) {
  SumRays<Walk::kVertical>(rays, surface, sums);
}
void SumSlanted(const RayBundle& rays, const HeightWindow& surface, PacketSums* sums) {
  SumRays<Walk::kSlanted>(rays, surface, sums);
}
void SumSlantedAndUndisturbed(const RayBundle& rays, const HeightWindow& surface, PacketSums* sums) {
  SumRays<Walk::kSlantedAndUndisturbed>(rays, surface, sums);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace albtpu
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace albtpu {

namespace {

// Indexes are exact in single precision.
[[maybe_unused]] bool MayBeTraced(const HeightWindow& surface) {
  return surface.points >= 3 && surface.points % 2 == 1 && surface.stride >= surface.points &&
         surface.points * surface.stride < 1 << 23;
}

}  // namespace

HWY_EXPORT(SumVertical);
HWY_EXPORT(SumSlanted);
HWY_EXPORT(SumSlantedAndUndisturbed);

TracedBundle TracePackets(const RayBundle& rays, const HeightWindow& surface) {
  assert(MayBeTraced(surface));
  PacketSums sums;
  if (rays.vertical()) {
    HWY_DYNAMIC_DISPATCH(SumVertical)(rays, surface, &sums);
  } else {
    HWY_DYNAMIC_DISPATCH(SumSlantedAndUndisturbed)(rays, surface, &sums);
  }
  return MeansOf(rays, sums);
}

TracedBeam Trace(const RayBundle& rays, const HeightWindow& surface) {
  assert(MayBeTraced(surface));
  PacketSums sums;
  if (rays.vertical()) {
    HWY_DYNAMIC_DISPATCH(SumVertical)(rays, surface, &sums);
  } else {
    HWY_DYNAMIC_DISPATCH(SumSlanted)(rays, surface, &sums);
  }
  return MeansOf(rays, sums).beam;
}

}  // namespace albtpu
#endif
