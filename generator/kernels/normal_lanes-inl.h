// Standard normal numbers in single precision, a block of four in each lane: the numbers of NormalStream, its slow
// twin, up to rounding. Included once for each instruction set.
#if defined(ALBTPU_NORMAL_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ALBTPU_NORMAL_LANES_INL_H
#undef ALBTPU_NORMAL_LANES_INL_H
#else
#define ALBTPU_NORMAL_LANES_INL_H
#endif

#include <Random123/philox.h>
#include <hwy/highway.h>

#include <cstdint>

#include "generator/math/random_stream.h"

HWY_BEFORE_NAMESPACE();
namespace albtpu {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, 8>;
using Words = hn::RebindToUnsigned<Floats>;
using Integers = hn::RebindToSigned<Floats>;
using FloatLanes = hn::Vec<Floats>;
using WordLanes = hn::Vec<Words>;

struct NormalPair {
  FloatLanes cosine, sine;
};

// The transform of Box and Muller, as BoxMuller in random_stream.cc. Its error, with e = 2^-24, half a unit in the last
// place of 1: the squared radius has a relative error of 4 e and, in the lower half of u, where r > 1, an additional
// absolute error of 4 e from rounding u + 1/2 and converting it to a float. The radius r therefore has an error of
// (3 r + 2 / r) e. Sine and cosine have errors of 2 e, their products with the radius of (6 r + 2 / r) e.
HWY_INLINE NormalPair BoxMuller(WordLanes u, WordLanes v) {
  const Floats f;
  const Words w;
  const Integers s;
  const auto number = [&](double x) { return hn::Set(f, static_cast<float>(x)); };

  // Write x = (u + 1/2) 2^-32 as 2^-halvings (1 - g) with g in [0, 1/2]. In the upper half of u, g comes from the
  // complement of u, which keeps its digits where x is too close to 1.
  const auto as_signed = hn::BitCast(s, u);
  const auto sign_of_u = hn::BroadcastSignBit(as_signed);
  const auto upper = hn::RebindMask(f, hn::MaskFromVec(sign_of_u));
  const auto least = hn::Xor(as_signed, sign_of_u);
  const FloatLanes scaled = hn::Add(hn::ConvertTo(f, least), number(0.5));
  const auto bits = hn::BitCast(s, scaled);
  const FloatLanes mantissa =
      hn::BitCast(f, hn::Or(hn::And(bits, hn::Set(s, 0x007FFFFF)), hn::Set(s, 0x3F000000)));  // in [1/2, 1)
  const FloatLanes lower_halvings = hn::ConvertTo(f, hn::Sub(hn::Set(s, 127 + 31), hn::ShiftRight<23>(bits)));
  const FloatLanes g = hn::IfThenElse(upper, hn::Mul(scaled, number(0x1p-32)), hn::Sub(number(1), mantissa));
  const FloatLanes halvings = hn::IfThenZeroElse(upper, lower_halvings);

  // -2 ln(1 - g) = 2 g + g^2 Q(g), with the minimax polynomial Q on [0, 1/2], within 2^-28 of the logarithm.
  FloatLanes q = number(3.49188614);
  for (const double c :
       {-4.96464109, 3.95342422, -1.1907326, 0.68209374, 0.351380289, 0.503777087, 0.666524291, 1.00000179})
    q = hn::MulAdd(q, g, number(c));
  const FloatLanes squared =
      hn::MulAdd(halvings, number(1.3862943611198906), hn::MulAdd(hn::Mul(g, g), q, hn::Add(g, g)));
  const FloatLanes radius = hn::Sqrt(squared);

  // The angle 2 pi v 2^-32 is the nearest number of quarter turns and a remainder in [-pi/4, pi/4). Sine and cosine of
  // the remainder are the polynomials of Moshier's Cephes (sinf.c).
  const FloatLanes rest =
      hn::Mul(hn::ConvertTo(f, hn::BitCast(s, hn::ShiftLeft<2>(v))), number(1.5707963267948966 * 0x1p-32));
  const FloatLanes square = hn::Mul(rest, rest);
  FloatLanes sine = hn::MulAdd(number(-1.9515295891e-4), square, number(8.3321608736e-3));
  sine = hn::MulAdd(sine, square, number(-1.6666654611e-1));
  sine = hn::MulAdd(hn::Mul(sine, square), rest, rest);
  FloatLanes cosine = hn::MulAdd(number(2.443315711809948e-5), square, number(-1.388731625493765e-3));
  cosine = hn::MulAdd(cosine, square, number(4.166664568298827e-2));
  cosine = hn::MulAdd(cosine, square, number(-0.5));
  cosine = hn::MulAdd(cosine, square, number(1));

  const WordLanes turns = hn::Add(v, hn::Set(w, 0x20000000u));  // the highest two bits count quarter turns
  const WordLanes sign = hn::Set(w, 0x80000000u);
  const auto odd = hn::RebindMask(f, hn::MaskFromVec(hn::BroadcastSignBit(hn::BitCast(s, hn::ShiftLeft<1>(turns)))));
  const auto sine_sign = hn::BitCast(f, hn::And(turns, sign));
  const auto cosine_sign = hn::BitCast(f, hn::And(hn::Add(turns, hn::Set(w, 0x40000000u)), sign));
  return {hn::Mul(radius, hn::Xor(hn::IfThenElse(odd, sine, cosine), cosine_sign)),
          hn::Mul(radius, hn::Xor(hn::IfThenElse(odd, cosine, sine), sine_sign))};
}

// The blocks of normal numbers of one realization.
class NormalLanes {
 public:
  explicit NormalLanes(const NormalStream& stream)
      : seed_(stream.seed()), realization_(stream.realization()), cell_(stream.cell()) {}

  struct Four {
    NormalPair first, second;
  };
  // The blocks `first`, `first` + 1, ... of a part, one in each lane; block b holds the numbers from 4 b on.
  HWY_INLINE Four operator()(std::uint32_t part, std::uint32_t first) const {
    WordLanes word[4];
    Philox(part, first, word);
    return {BoxMuller(word[0], word[1]), BoxMuller(word[2], word[3])};
  }

  // The random words of these blocks: the first two make the first pair of normal numbers, the others the second.
#if HWY_TARGET == HWY_SCALAR
  void Philox(std::uint32_t part, std::uint32_t block, WordLanes* word) const {
    const r123::Philox4x32::key_type key = {
        {static_cast<std::uint32_t>(seed_), static_cast<std::uint32_t>(seed_ >> 32)}};
    const r123::Philox4x32::ctr_type words = r123::Philox4x32()({{block, realization_, cell_, part}}, key);
    for (int i = 0; i < 4; ++i) word[i] = hn::Set(Words(), words[i]);
  }
#else
  HWY_INLINE void Philox(std::uint32_t part, std::uint32_t first, WordLanes* word) const {
    const Words w;
    const WideWords wide;
    const auto step = hn::Iota(wide, 0);
    const auto even_blocks = hn::Add(hn::Add(step, step), hn::Set(wide, first));
    WordLanes even[4], odd[4];
    PhiloxOfEvenLanes(part, hn::BitCast(w, even_blocks), even);
    PhiloxOfEvenLanes(part, hn::BitCast(w, hn::Add(even_blocks, hn::Set(wide, 1))), odd);
    for (int i = 0; i < 4; ++i)
      word[i] = hn::OddEven(hn::BitCast(w, hn::ShiftLeft<32>(hn::BitCast(wide, odd[i]))), even[i]);
  }
#endif

 private:
#if HWY_TARGET != HWY_SCALAR
  using WideWords = hn::Repartition<std::uint64_t, Words>;

  // Philox4x32-10 in the even lanes only, so that 64-bit products need no shuffling. The odd lanes of the words are
  // undefined.
  HWY_INLINE void PhiloxOfEvenLanes(std::uint32_t part, WordLanes block, WordLanes* word) const {
    const Words w;
    word[0] = block;
    word[1] = hn::Set(w, realization_);
    word[2] = hn::Set(w, cell_);
    word[3] = hn::Set(w, part);
    std::uint32_t key0 = static_cast<std::uint32_t>(seed_), key1 = static_cast<std::uint32_t>(seed_ >> 32);
    for (int round = 0; round < 10; ++round) {
      const auto product0 = hn::MulEven(word[0], hn::Set(w, 0xD2511F53u));
      const auto product1 = hn::MulEven(word[2], hn::Set(w, 0xCD9E8D57u));
      const WordLanes high0 = hn::BitCast(w, hn::ShiftRight<32>(product0));
      const WordLanes high1 = hn::BitCast(w, hn::ShiftRight<32>(product1));
      word[0] = hn::Xor(high1, hn::Xor(word[1], hn::Set(w, key0)));
      word[2] = hn::Xor(high0, hn::Xor(word[3], hn::Set(w, key1)));
      word[1] = hn::BitCast(w, product1);
      word[3] = hn::BitCast(w, product0);
      key0 += 0x9E3779B9u;
      key1 += 0xBB67AE85u;
    }
  }
#endif

  std::uint64_t seed_;
  std::uint32_t realization_, cell_;
};

}  // namespace HWY_NAMESPACE
}  // namespace albtpu
HWY_AFTER_NAMESPACE();

#endif
