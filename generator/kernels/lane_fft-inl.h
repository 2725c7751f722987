// Executes a LaneFft. Included once for each instruction set.
#if defined(ALBTPU_LANE_FFT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ALBTPU_LANE_FFT_INL_H
#undef ALBTPU_LANE_FFT_INL_H
#else
#define ALBTPU_LANE_FFT_INL_H
#endif

#include <hwy/highway.h>

#include <cstddef>

#include "generator/kernels/lane_fft.h"

HWY_BEFORE_NAMESPACE();
namespace albtpu {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Series = hn::CappedTag<float, LaneFft::kSeries>;
using SeriesLanes = hn::Vec<Series>;

struct ComplexLanes {
  SeriesLanes re, im;
};
HWY_INLINE ComplexLanes operator+(ComplexLanes a, ComplexLanes b) { return {hn::Add(a.re, b.re), hn::Add(a.im, b.im)}; }
HWY_INLINE ComplexLanes operator-(ComplexLanes a, ComplexLanes b) { return {hn::Sub(a.re, b.re), hn::Sub(a.im, b.im)}; }
HWY_INLINE ComplexLanes TimesI(ComplexLanes a) { return {hn::Neg(a.im), a.re}; }
HWY_INLINE ComplexLanes PlusI(ComplexLanes a, ComplexLanes b) {  // a + i b
  return {hn::Sub(a.re, b.im), hn::Add(a.im, b.re)};
}
HWY_INLINE ComplexLanes MinusI(ComplexLanes a, ComplexLanes b) {  // a - i b
  return {hn::Add(a.re, b.im), hn::Sub(a.im, b.re)};
}
HWY_INLINE ComplexLanes operator*(SeriesLanes s, ComplexLanes a) { return {hn::Mul(s, a.re), hn::Mul(s, a.im)}; }
HWY_INLINE ComplexLanes MulAdd(SeriesLanes s, ComplexLanes a, ComplexLanes b) {  // s a + b
  return {hn::MulAdd(s, a.re, b.re), hn::MulAdd(s, a.im, b.im)};
}
HWY_INLINE SeriesLanes Number(double x) { return hn::Set(Series(), static_cast<float>(x)); }
// (re + i im) a
HWY_INLINE ComplexLanes Times(float re, float im, ComplexLanes a) {
  const SeriesLanes c = hn::Set(Series(), re), s = hn::Set(Series(), im);
  return {hn::NegMulAdd(s, a.im, hn::Mul(c, a.re)), hn::MulAdd(s, a.re, hn::Mul(c, a.im))};
}
HWY_INLINE ComplexLanes LoadElement(const float* element) {
  return {hn::Load(Series(), element), hn::Load(Series(), element + LaneFft::kSeries)};
}
HWY_INLINE void StoreElement(ComplexLanes a, float* element) {
  hn::Store(a.re, Series(), element);
  hn::Store(a.im, Series(), element + LaneFft::kSeries);
}

// Unscaled inverse transforms of `kRadix` numbers in place.
template <int kRadix>
HWY_INLINE void Butterfly(ComplexLanes* x);

template <>
HWY_INLINE void Butterfly<2>(ComplexLanes* x) {
  const ComplexLanes sum = x[0] + x[1];
  x[1] = x[0] - x[1];
  x[0] = sum;
}

template <>
HWY_INLINE void Butterfly<3>(ComplexLanes* x) {
  const ComplexLanes sum = x[1] + x[2], difference = Number(0.8660254037844386) * (x[1] - x[2]);  // sin 60
  const ComplexLanes mean = MulAdd(Number(-0.5), sum, x[0]);
  x[0] = x[0] + sum;
  x[1] = PlusI(mean, difference);
  x[2] = MinusI(mean, difference);
}

template <>
HWY_INLINE void Butterfly<4>(ComplexLanes* x) {
  const ComplexLanes a = x[0] + x[2], b = x[0] - x[2], c = x[1] + x[3], d = x[1] - x[3];
  x[0] = a + c;
  x[1] = PlusI(b, d);
  x[2] = a - c;
  x[3] = MinusI(b, d);
}

template <>
HWY_INLINE void Butterfly<5>(ComplexLanes* x) {
  const SeriesLanes cos72 = Number(0.30901699437494742), cos144 = Number(-0.80901699437494742);
  const SeriesLanes sin72 = Number(0.95105651629515357), sin144 = Number(0.58778525229247313);
  const ComplexLanes sum1 = x[1] + x[4], sum2 = x[2] + x[3], dif1 = x[1] - x[4], dif2 = x[2] - x[3];
  const ComplexLanes a = MulAdd(cos72, sum1, MulAdd(cos144, sum2, x[0]));
  const ComplexLanes b = MulAdd(cos144, sum1, MulAdd(cos72, sum2, x[0]));
  const ComplexLanes c = MulAdd(sin72, dif1, sin144 * dif2);
  const ComplexLanes d = sin144 * dif1 - sin72 * dif2;
  x[0] = x[0] + sum1 + sum2;
  x[1] = PlusI(a, c);
  x[2] = PlusI(b, d);
  x[3] = MinusI(b, d);
  x[4] = MinusI(a, c);
}

template <>
HWY_INLINE void Butterfly<8>(ComplexLanes* x) {
  ComplexLanes even[4] = {x[0], x[2], x[4], x[6]}, odd[4] = {x[1], x[3], x[5], x[7]};
  Butterfly<4>(even);
  Butterfly<4>(odd);
  const SeriesLanes root = Number(0.70710678118654752);
  odd[1] = root * PlusI(odd[1], odd[1]);  // exp(i pi / 4) odd
  odd[3] = root * PlusI(odd[3], odd[3]);  // exp(3 i pi / 4) odd without a factor i, which comes below
  x[0] = even[0] + odd[0];
  x[1] = even[1] + odd[1];
  x[2] = PlusI(even[2], odd[2]);
  x[3] = PlusI(even[3], odd[3]);
  x[4] = even[0] - odd[0];
  x[5] = even[1] - odd[1];
  x[6] = MinusI(even[2], odd[2]);
  x[7] = MinusI(even[3], odd[3]);
}

// Combines transforms into transforms kRadix times as long; passes each element to `store(index, element)`.
template <int kRadix, class Store>
HWY_INLINE void RunPass(const LaneFft::Pass& pass, int size, const float* data, const Store& store) {
  const int length = pass.length;
  for (int first = 0; first < size; first += kRadix * length) {
    const float* twiddle = pass.twiddles.data();
    for (int k = 0; k < length; ++k, twiddle += 2 * (kRadix - 1)) {
      ComplexLanes x[kRadix];
      for (int q = 0; q < kRadix; ++q) x[q] = LoadElement(data + LaneFft::kElement * (first + q * length + k));
      if (length > 1)
        for (int q = 1; q < kRadix; ++q) x[q] = Times(twiddle[2 * q - 2], twiddle[2 * q - 1], x[q]);
      Butterfly<kRadix>(x);
      for (int q = 0; q < kRadix; ++q) store(first + q * length + k, x[q]);
    }
  }
}

template <class Store>
HWY_INLINE void RunPass(const LaneFft::Pass& pass, int size, const float* data, const Store& store) {
  switch (pass.radix) {
    case 2:
      return RunPass<2>(pass, size, data, store);
    case 3:
      return RunPass<3>(pass, size, data, store);
    case 4:
      return RunPass<4>(pass, size, data, store);
    case 5:
      return RunPass<5>(pass, size, data, store);
    default:
      return RunPass<8>(pass, size, data, store);
  }
}

// The sums over j of element j, which lies at Place(j), times exp(2 pi i index j / size), for the indices from `begin`
// to `end` - 1. The sum for `index` is stored at `at(index)`. Overwrites the data, `size` elements.
template <class At>
HWY_INLINE void Transform(const LaneFft& fft, float* data, int begin, int end, const At& at) {
  for (std::size_t lane = 0; lane < LaneFft::kSeries; lane += hn::MaxLanes(Series())) {
    float* own = data + lane;
    for (const LaneFft::Pass& pass : fft.passes()) {
      if (&pass != &fft.passes().back()) {
        RunPass(pass, fft.size(), own, [&](int i, ComplexLanes x) { StoreElement(x, own + LaneFft::kElement * i); });
      } else {
        RunPass(pass, fft.size(), own, [&](int i, ComplexLanes x) {
          if (begin <= i && i < end) StoreElement(x, at(i) + lane);
        });
      }
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace albtpu
HWY_AFTER_NAMESPACE();

#endif
