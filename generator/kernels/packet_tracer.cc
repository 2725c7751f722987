#include "generator/kernels/packet_tracer.h"

#include <cassert>

// The following is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "generator/kernels/packet_tracer.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "generator/kernels/facet_packets-inl.h"

HWY_BEFORE_NAMESPACE();
namespace albtpu {
namespace HWY_NAMESPACE {
namespace {

constexpr int kMaxSteps = 8;

// A block of rays of a bundle and their intersections with the water. Each operation is a short pass over all rays, so
// that the processor overlaps the work on several packets and the constants of a pass stay in registers.
class Block {
 public:
  // The rays from `first` on.
  Block(const Grid& grid, const RayBundle& rays, const HeightView& surface, int first)
      : grid_(grid),
        rays_(rays),
        surface_(surface),
        first_(first),
        count_(HWY_MIN(rays.count() - first, kBlock)),
        end_((count_ + RayBundle::kStrips - 1) / RayBundle::kStrips * RayBundle::kStrips) {}

  // Intersects vertical lines through the points where the rays cross z = 0.
  void IntersectUnshifted() {
    for (int ray = 0; ray < end_; ray += kLanes) Enter(ray, hn::Zero(d));
    for (int ray = 0; ray < end_; ray += kLanes) {
      const Facets facets(grid_, cells_, ray);
      Keep(ray, facets.height, facets);
    }
    ClearSurplus();
  }

  // Intersects the rays by two Newton steps, after which all but a few packets have converged. Half of them have
  // converged after one step, so a branch there would be as good as random. The first step of a ray starts from the
  // height to which it led the previous ray of the same strip, a good first guess. `heights` [m] holds these heights,
  // in the end those of the last row. Adds the rays that do not converge to `unsettled_rays`.
  void Intersect(float* heights, int* unsettled_rays) {
    for (int row = 0; row < end_; row += RayBundle::kStrips) {
      for (int i = 0; i < RayBundle::kStrips; i += kLanes) Enter(row + i, hn::Load(d, heights + i));
      for (int i = 0; i < RayBundle::kStrips; i += kLanes) {
        V z = hn::Load(d, heights + i);
        z = hn::Add(z, Step(grid_, Facets(grid_, cells_, row + i), z).rise);
        hn::Store(z, d, heights + i);
        hn::Store(z, d, z_ + row + i);
      }
    }
    for (int ray = 0; ray < end_; ray += kLanes) Enter(ray, hn::Load(d, z_ + ray));
    for (int ray = 0; ray < end_; ray += kLanes)
      if (HWY_UNLIKELY(!hn::AllTrue(d, Advance(ray).on_facet))) *unsettled_rays += IntersectFurther(ray);
    ClearSurplus();
  }

  // Snell's law as in RefractAtSlope, less the refraction by still water, without cancellation.
  //
  // Derivation: with r = 1 / n, c the cosine of the incidence, h the horizontal part of the incident direction, the
  // slope m, L^2 = 1 + |m|^2 and mu = r m . h, Eq. 17 (docs/physics.md, section 3) multiplied by L^2 is the vector
  //     horizontal: L^2 r h + m lift,    downward: q = r c L^2 + lift,    lift = s - r c - mu,
  //     s^2 = L^2 (1 - r^2) + (r c + mu)^2 = s0^2 + D,
  //     s0^2 = 1 - r^2 + r^2 c^2,    D = |m|^2 (1 - r^2) + 2 r c mu + mu^2.
  // It has the length L^2, so secant = L^2 / q and tangent = r h secant + m lift / q. Still water has m = 0, q = s0.
  // With s - s0 = D / (s + s0), the differences are
  //     secant - 1 / s0 = (|m|^2 (s0 - r c) + mu - D / (s + s0)) / (s0 q),
  //     tangent - r h / s0 = r h (secant - 1 / s0) + m lift / q.
  void AddRefracted(const StillWater& still, PacketSums* sums) const {
    const V s0 = hn::Set(d, still.s0), s0_squared = hn::Set(d, still.s0 * still.s0),
            inverse_s0 = hn::Set(d, 1 / still.s0), rc = hn::Set(d, still.rc), two_rc = hn::Set(d, 2 * still.rc),
            s0_less_rc = hn::Set(d, still.s0 - still.rc), rhx = hn::Set(d, still.rhx), rhy = hn::Set(d, still.rhy),
            one_less_r2 = hn::Set(d, still.one_less_r2);
    V sum[kHeightSecant + 1];
    for (V& s : sum) s = hn::Zero(d);
    for (int ray = 0; ray < end_; ray += kLanes) {
      const V z = hn::Load(d, z_ + ray);
      const V mx = SlopeX(ray), my = SlopeY(ray);
      const V mm = hn::MulAdd(mx, mx, hn::Mul(my, my));
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
    }
    for (int k = 0; k <= kHeightSecant; ++k) AddLanes(sum[k], &sums->sum[k]);
  }

  // Adds slopes and their squares to the sum `slope_x` and the four sums after it.
  void AddSlopes(PacketSum slope_x, PacketSums* sums) const {
    V x = hn::Zero(d), y = x, xx = x, yy = x, xy = x;
    for (int ray = 0; ray < end_; ray += kLanes) {
      const V mx = SlopeX(ray), my = SlopeY(ray);
      x = hn::Add(x, mx);
      y = hn::Add(y, my);
      xx = hn::MulAdd(mx, mx, xx);
      yy = hn::MulAdd(my, my, yy);
      xy = hn::MulAdd(mx, my, xy);
    }
    double* sum = sums->sum + slope_x;
    for (const V& lanes : {x, y, xx, yy, xy}) AddLanes(lanes, sum++);
  }

  // Adds the unshifted heights and their products with the slopes.
  void AddHeightSlopes(PacketSums* sums) const {
    V height = hn::Zero(d), x = height, y = height;
    for (int ray = 0; ray < end_; ray += kLanes) {
      const V z = hn::Load(d, z_ + ray);
      height = hn::Add(height, z);
      x = hn::MulAdd(z, SlopeX(ray), x);
      y = hn::MulAdd(z, SlopeY(ray), y);
    }
    AddLanes(height, sums->sum + kUnshiftedHeight);
    AddLanes(x, sums->sum + kUnshiftedHeightX);
    AddLanes(y, sums->sum + kUnshiftedHeightY);
  }

 private:
  HWY_INLINE void Enter(int ray, V z) {
    cells_.Enter(grid_, ray, hn::MulAdd(z, grid_.x_per_height, grid_.Steps(rays_.x() + first_ + ray)),
                 hn::MulAdd(z, grid_.y_per_height, grid_.Steps(rays_.y() + first_ + ray)));
  }
  HWY_INLINE void Keep(int ray, V z, const Facets& facets) {
    hn::Store(z, d, z_ + ray);
    hn::Store(facets.rise_x, d, rise_x_ + ray);
    hn::Store(facets.rise_y, d, rise_y_ + ray);
  }
  HWY_INLINE Step Advance(int ray) {
    const V z = hn::Load(d, z_ + ray);
    const Facets facets(grid_, cells_, ray);
    const Step step(grid_, facets, z);
    Keep(ray, hn::Add(z, step.rise), facets);
    return step;
  }

  // Takes further steps for the packet at `ray`. Rays that do not converge are intersected one by one; returns their
  // number. A ray has converged when its intersection lies on its facet, or when a step hardly moves it: on an edge,
  // either of two facets is correct.
  HWY_NOINLINE int IntersectFurther(int ray) {
    const V tolerance = hn::Set(d, 0x1p-14f * surface_.spacing);
    HWY_ALIGN float settled[kLanes];
    for (int i = 0; i < kMaxSteps; ++i) {
      Enter(ray, hn::Load(d, z_ + ray));
      const Step step = Advance(ray);
      const M now = hn::Or(step.on_facet, hn::Le(hn::Abs(step.rise), tolerance));
      if (hn::AllTrue(d, now)) return 0;
      hn::Store(hn::IfThenElseZero(now, hn::Set(d, 1.0f)), d, settled);
    }
    int count = 0;
    for (int lane = 0; lane < kLanes; ++lane) {
      if (settled[lane] != 0) continue;
      const int one = ray + lane;
      IntersectOne(rays_, surface_, first_ + one, z_[one], rise_x_[one], rise_y_[one]);
      if (one < count_) ++count;
    }
    return count;
  }

  // Gives surplus rays an intersection with still water, which adds nothing to any sum.
  void ClearSurplus() {
    for (int ray = count_; ray < end_; ++ray) z_[ray] = rise_x_[ray] = rise_y_[ray] = 0;
  }

  HWY_INLINE V SlopeX(int ray) const { return hn::Mul(hn::Load(d, rise_x_ + ray), grid_.steps_per_metre); }
  HWY_INLINE V SlopeY(int ray) const { return hn::Mul(hn::Load(d, rise_y_ + ray), grid_.steps_per_metre); }
  static HWY_INLINE void AddLanes(V sum, double* total) {
    HWY_ALIGN float lanes[kLanes];
    hn::Store(sum, d, lanes);
    for (const float lane : lanes) *total += static_cast<double>(lane);
  }

  const Grid grid_;
  const RayBundle& rays_;
  const HeightView& surface_;
  int first_, count_;
  int end_;  // the end of the full rows, which hold `count_` rays and some surplus ones
  Cells cells_;
  HWY_ALIGN float z_[kBlock];                        // m
  HWY_ALIGN float rise_x_[kBlock], rise_y_[kBlock];  // of the intersected facets, m per step
};

void SumRays(const RayBundle& rays, const HeightView& surface, Wanted wanted, PacketSums* sums) {
  const Grid grid(rays, surface);
  const StillWater still = StillWaterOf(rays);
  HWY_ALIGN float heights[RayBundle::kStrips] = {};
  for (int first = 0; first < rays.count(); first += kBlock) {
    Block block(grid, rays, surface, first);
    const bool unshifted = wanted == Wanted::kBeamAndUnshifted;
    if (unshifted || rays.vertical()) block.IntersectUnshifted();
    if (unshifted) {
      block.AddSlopes(kUnshiftedX, sums);
      block.AddHeightSlopes(sums);
    }
    if (!rays.vertical()) block.Intersect(heights, &sums->unsettled_rays);
    block.AddSlopes(kSlopeX, sums);
    block.AddRefracted(still, sums);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace albtpu
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace albtpu {

namespace {

// Below 2^23, indices are exact in single precision.
[[maybe_unused]] bool MayBeTraced(const HeightView& surface) {
  return surface.points >= 3 && surface.points % 2 == 1 && surface.stride >= surface.points &&
         surface.points * surface.stride < 1 << 23;
}

}  // namespace

HWY_EXPORT(SumRays);

TracedBundle TracePackets(const RayBundle& rays, const HeightView& surface) {
  assert(MayBeTraced(surface));
  PacketSums sums;
  HWY_DYNAMIC_DISPATCH(SumRays)(rays, surface, Wanted::kBeamAndUnshifted, &sums);
  return MeansOf(rays, sums);
}

TracedBeam Trace(const RayBundle& rays, const HeightView& surface) {
  assert(MayBeTraced(surface));
  PacketSums sums;
  HWY_DYNAMIC_DISPATCH(SumRays)(rays, surface, Wanted::kBeam, &sums);
  return MeansOf(rays, sums).beam;
}

}  // namespace albtpu
#endif
