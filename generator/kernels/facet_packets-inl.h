// A packet of rays and the facets below or above them, the fast twin of HeightField::FacetAt. Included once for each
// instruction set.
#if defined(ALBTPU_FACET_PACKETS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ALBTPU_FACET_PACKETS_INL_H
#undef ALBTPU_FACET_PACKETS_INL_H
#else
#define ALBTPU_FACET_PACKETS_INL_H
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

#include "generator/kernels/ray_bundle.h"
#include "generator/surface/ray_tracer.h"

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
static_assert(RayBundle::kStrips % kLanes == 0);

// For each index, the height there and the next one.
HWY_INLINE void LoadPairs(const float* heights, const std::int32_t* at, V& first, V& second) {
#if HWY_TARGET == HWY_SCALAR
  first = hn::Set(d, heights[at[0]]);
  second = hn::Set(d, heights[at[0] + 1]);
#else
  const hn::CappedTag<float, 2> pair;
  const hn::CappedTag<float, 4> pairs;
  const auto low = hn::Combine(pairs, hn::LoadU(pair, heights + at[1]), hn::LoadU(pair, heights + at[0]));
  const auto high = hn::Combine(pairs, hn::LoadU(pair, heights + at[3]), hn::LoadU(pair, heights + at[2]));
#if HWY_MAX_BYTES >= 32
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

// The surface under a beam. Horizontal positions are in steps of the grid from the centre of the lowest cell.
struct Grid {
  const float* heights;  // m
  std::ptrdiff_t stride;
  V stride_steps, last_cell;
  V steps_per_metre, origin;
  V x_per_height, y_per_height;  // steps per m, of the rays

  Grid(const RayBundle& rays, const HeightView& surface)
      : heights(surface.heights),
        stride(surface.stride),
        stride_steps(hn::Set(d, static_cast<float>(surface.stride))),
        last_cell(hn::Set(d, static_cast<float>(surface.points - 2))),
        steps_per_metre(hn::Set(d, 1 / surface.spacing)),
        origin(hn::Set(d, static_cast<float>((surface.points - 1) / 2) - 0.5f)),
        x_per_height(hn::Set(d, static_cast<float>(rays.x_per_height()) / surface.spacing)),
        y_per_height(hn::Set(d, static_cast<float>(rays.y_per_height()) / surface.spacing)) {}

  // From positions [m] about the centre of the beam to steps.
  HWY_INLINE V Steps(const float* metres) const { return hn::MulAdd(hn::LoadU(d, metres), steps_per_metre, origin); }
};

// The number of rays in a block: few enough to stay in the first-level cache and to be summed in single precision.
constexpr int kBlock = 16 * RayBundle::kStrips;

// The cells of a block's rays. One pass stores them in memory and the next pass loads the facets, so that its loads
// do not wait for arithmetic.
struct Cells {
  HWY_ALIGN float from_x[kBlock], from_y[kBlock];  // steps from the centre of the cell to the ray
  HWY_ALIGN std::int32_t at[kBlock];               // index of the height at the cell's low corner

  // Stores the cells below or above the points (x, y) [steps] of the packet at `ray`; beyond the edge, the outermost.
  HWY_INLINE void Enter(const Grid& grid, int ray, V x, V y) {
    const V cell_x = hn::Round(hn::Min(hn::Max(x, hn::Zero(d)), grid.last_cell));
    const V cell_y = hn::Round(hn::Min(hn::Max(y, hn::Zero(d)), grid.last_cell));
    hn::Store(hn::Sub(x, cell_x), d, from_x + ray);
    hn::Store(hn::Sub(y, cell_y), d, from_y + ray);
    // Adding 2^23 to an integer below it leaves the integer in the low bits of the float.
    const hn::RebindToSigned<D> di;
    const V index = hn::MulAdd(cell_x, grid.stride_steps, hn::Add(cell_y, hn::Set(d, 0x1p23f)));
    hn::Store(hn::And(hn::BitCast(di, index), hn::Set(di, 0x7fffff)), di, at + ray);
  }
};

// The facets below or above the rays of the packet at `ray`, within the cells stored for them.
struct Facets {
  V from_x, from_y;  // steps from the centre of the cell to the ray
  M beside_x;        // which triangle of the cell, as in HeightField::Triangle
  V rise_x, rise_y;  // of its plane, m per step
  V height;          // of the plane at the ray's position, m

  HWY_INLINE Facets(const Grid& grid, const Cells& cells, int ray) {
    V low, along_y, along_x, high;
    LoadPairs(grid.heights, cells.at + ray, low, along_y);
    LoadPairs(grid.heights + grid.stride, cells.at + ray, along_x, high);
    from_x = hn::Load(d, cells.from_x + ray);
    from_y = hn::Load(d, cells.from_y + ray);
    beside_x = hn::Gt(from_x, from_y);
    const V third = hn::IfThenElse(beside_x, along_x, along_y);
    const V from_low = hn::Sub(third, low), to_high = hn::Sub(high, third);
    rise_x = hn::IfThenElse(beside_x, from_low, to_high);
    rise_y = hn::IfThenElse(beside_x, to_high, from_low);
    // The height at the centre of the cell, which both triangles share.
    const V middle = hn::Mul(hn::Add(low, high), hn::Set(d, 0.5f));
    height = hn::MulAdd(rise_x, from_x, hn::MulAdd(rise_y, from_y, middle));
  }
};

// A step of Newton's method, from the height z [m] to the intersection of the rays with the planes of their facets.
struct Step {
  V rise;      // m
  M on_facet;  // rays whose intersection lies within the facet itself

  HWY_INLINE Step(const Grid& grid, const Facets& facets, V z) {
    const V approach = hn::NegMulAdd(facets.rise_x, grid.x_per_height,
                                     hn::NegMulAdd(facets.rise_y, grid.y_per_height, hn::Set(d, 1.0f)));
    // The limit keeps the direction of the step right even over a facet that turns away.
    const V min_approach = hn::Set(d, 0.1f);
    rise = hn::Div(hn::Sub(facets.height, z), hn::Max(approach, min_approach));
    const V x = hn::MulAdd(rise, grid.x_per_height, facets.from_x);
    const V y = hn::MulAdd(rise, grid.y_per_height, facets.from_y);
    const M same_cell = hn::Le(hn::Max(hn::Abs(x), hn::Abs(y)), hn::Set(d, 0.5f));
    const M other_triangle = hn::Xor(hn::Gt(x, y), facets.beside_x);
    on_facet = hn::AndNot(other_triangle, hn::And(same_cell, hn::Ge(approach, min_approach)));
  }
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace albtpu
HWY_AFTER_NAMESPACE();

#endif
