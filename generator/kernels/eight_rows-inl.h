// Transposes eight rows of numbers into eight lanes and back. Included once for each instruction set.
#if defined(ALBTPU_EIGHT_ROWS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ALBTPU_EIGHT_ROWS_INL_H
#undef ALBTPU_EIGHT_ROWS_INL_H
#else
#define ALBTPU_EIGHT_ROWS_INL_H
#endif

#include <hwy/highway.h>

#include <cstddef>

HWY_BEFORE_NAMESPACE();
namespace albtpu {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using EightRows = hn::CappedTag<float, 8>;

#if HWY_TARGET == HWY_SCALAR

// Both functions are documented below.
inline void FourColumnsToLanes(const float* rows, std::size_t row_stride, float* lanes, std::size_t lane_stride) {
  for (int i = 0; i < 4; ++i)
    for (int r = 0; r < 8; ++r) lanes[i * lane_stride + r] = rows[r * row_stride + i];
}

inline void FourLanesToColumns(const float* lanes, std::size_t lane_stride, float* rows, std::size_t row_stride) {
  for (int i = 0; i < 4; ++i)
    for (int r = 0; r < 8; ++r) rows[r * row_stride + i] = lanes[i * lane_stride + r];
}

#else

// Transposes the square of four by four numbers in each 128 bits of the four vectors.
template <class D, class V = hn::Vec<D> >
HWY_INLINE void TransposeSquares(D d, V* v) {
  const hn::RepartitionToWide<D> pairs;
  const auto a = hn::BitCast(pairs, hn::InterleaveLower(d, v[0], v[1]));
  const auto b = hn::BitCast(pairs, hn::InterleaveUpper(d, v[0], v[1]));
  const auto c = hn::BitCast(pairs, hn::InterleaveLower(d, v[2], v[3]));
  const auto e = hn::BitCast(pairs, hn::InterleaveUpper(d, v[2], v[3]));
  v[0] = hn::BitCast(d, hn::InterleaveLower(pairs, a, c));
  v[1] = hn::BitCast(d, hn::InterleaveUpper(pairs, a, c));
  v[2] = hn::BitCast(d, hn::InterleaveLower(pairs, b, e));
  v[3] = hn::BitCast(d, hn::InterleaveUpper(pairs, b, e));
}

// lanes[i lane_stride + r] = rows[r row_stride + i] for i below 4 and r below 8. Rows are aligned to four numbers,
// lanes to eight.
template <class D = EightRows>
HWY_INLINE void FourColumnsToLanes(const float* rows, std::size_t row_stride, float* lanes, std::size_t lane_stride) {
  const D d;
  hn::Vec<D> v[4];
  if constexpr (hn::MaxLanes(D()) == 8) {
    const hn::Half<D> four;
    for (int i = 0; i < 4; ++i)
      v[i] = hn::Combine(d, hn::Load(four, rows + (i + 4) * row_stride), hn::Load(four, rows + i * row_stride));
    TransposeSquares(d, v);
    for (int i = 0; i < 4; ++i) hn::Store(v[i], d, lanes + i * lane_stride);
  } else {
    for (int half = 0; half < 8; half += 4) {
      for (int i = 0; i < 4; ++i) v[i] = hn::Load(d, rows + (half + i) * row_stride);
      TransposeSquares(d, v);
      for (int i = 0; i < 4; ++i) hn::Store(v[i], d, lanes + i * lane_stride + half);
    }
  }
}

// The inverse: rows[r row_stride + i] = lanes[i lane_stride + r].
template <class D = EightRows>
HWY_INLINE void FourLanesToColumns(const float* lanes, std::size_t lane_stride, float* rows, std::size_t row_stride) {
  const D d;
  hn::Vec<D> v[4];
  if constexpr (hn::MaxLanes(D()) == 8) {
    const hn::Half<D> four;
    for (int i = 0; i < 4; ++i) v[i] = hn::Load(d, lanes + i * lane_stride);
    TransposeSquares(d, v);
    for (int i = 0; i < 4; ++i) {
      hn::Store(hn::LowerHalf(four, v[i]), four, rows + i * row_stride);
      hn::Store(hn::UpperHalf(four, v[i]), four, rows + (i + 4) * row_stride);
    }
  } else {
    for (int half = 0; half < 8; half += 4) {
      for (int i = 0; i < 4; ++i) v[i] = hn::Load(d, lanes + i * lane_stride + half);
      TransposeSquares(d, v);
      for (int i = 0; i < 4; ++i) hn::Store(v[i], d, rows + (half + i) * row_stride);
    }
  }
}

#endif

}  // namespace HWY_NAMESPACE
}  // namespace albtpu
HWY_AFTER_NAMESPACE();

#endif
