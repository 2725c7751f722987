#include "tables/query/record_blend.h"

// The code below is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tables/query/record_blend.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace albtpu {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
// Two records that are neighbours on the innermost axis, in one vector or more.
constexpr std::size_t kPair = 2 * kRecordSize;
using D = hn::CappedTag<float, kPair>;
using V = hn::Vec<D>;
constexpr D d;
constexpr std::size_t kLanes = hn::MaxLanes(d);

// Exactly `from` at fraction 0 and `to` at fraction 1.
template <class W>
HWY_INLINE W Lerp(W fraction, W from, W to) {
  return hn::MulAdd(fraction, to, hn::NegMulAdd(fraction, from, from));
}

// The corners of a cell on those axes on which a pulse lies between two nodes. The last of these axes is blended
// first.
struct Corners {
  std::ptrdiff_t steps[3];
  float fractions[3];
  int count = 0;

  // On a node, the other corner has no weight and is not read.
  HWY_INLINE void Add(const float*& at, std::ptrdiff_t step, float fraction) {
    if (fraction == 0) return;
    if (fraction == 1) {
      at += step;
      return;
    }
    steps[count] = step;
    fractions[count++] = fraction;
  }
};

template <int kAxes>
HWY_INLINE V Mean(const float* at, const Corners& corners) {
  if constexpr (kAxes == 0) {
    return hn::LoadU(d, at);
  } else {
    constexpr int kAxis = kAxes - 1;
    const Corners& c = corners;
    const V from = Mean<kAxis>(at, c), to = Mean<kAxis>(at + c.steps[kAxis], c);
    return Lerp(hn::Set(d, c.fractions[kAxis]), from, to);
  }
}

// The means of the pairs at `kPairs` offsets from `at`.
template <int kAxes, std::size_t kPairs>
HWY_INLINE void MeanPairs(const float* at, const Corners& corners, const std::ptrdiff_t* offsets, float* pairs) {
  for (std::size_t p = 0; p < kPairs; ++p)
    for (std::size_t lane = 0; lane < kPair; lane += kLanes)
      hn::Store(Mean<kAxes>(at + offsets[p] + lane, corners), d, pairs + p * kPair + lane);
}

template <std::size_t kPairs>
HWY_INLINE void MeanPairs(const float* at, const Corners& corners, const std::ptrdiff_t* offsets, float* pairs) {
  switch (corners.count) {
    case 0:
      return MeanPairs<0, kPairs>(at, corners, offsets, pairs);
    case 1:
      return MeanPairs<1, kPairs>(at, corners, offsets, pairs);
    case 2:
      return MeanPairs<2, kPairs>(at, corners, offsets, pairs);
    default:
      return MeanPairs<3, kPairs>(at, corners, offsets, pairs);
  }
}

// Blends the pairs on both sides of an axis. `sides` holds those of the lower side first.
template <std::size_t kPairs>
HWY_INLINE void LerpPairs(float fraction, const float* sides, float* pairs) {
  const V f = hn::Set(d, fraction);
  for (std::size_t lane = 0; lane < kPairs * kPair; lane += kLanes) {
    const V from = hn::Load(d, sides + lane), to = hn::Load(d, sides + kPairs * kPair + lane);
    hn::Store(Lerp(f, from, to), d, pairs + lane);
  }
}

// The means over the three slowest slots in the cell of a pulse. The next pulse often has the same cell and the same
// fractions there.
template <std::size_t kPairs>
class Cell {
 public:
  Cell(const float* records, const BlendedPulses& pulses) : records_(records), pulses_(pulses) {
    for (std::size_t slot = 0; slot < BlendedPulses::kSlotCount; ++slot)
      steps_[slot] = pulses.steps[slot] * static_cast<std::ptrdiff_t>(kRecordSize);
    for (std::size_t p = 0; p < 2 * kPairs; ++p) {
      offsets_[p] = (p & 1) * steps_[kPairs == 4 ? BlendedPulses::kFastest : BlendedPulses::kFast] +
                    (kPairs == 4 ? (p >> 1 & 1) * steps_[BlendedPulses::kFast] : 0) +
                    (p / kPairs) * steps_[BlendedPulses::kMiddle];
    }
  }

  // The pairs at the corners of kFast and kFastest; kFastest varies first.
  HWY_INLINE const float* Enter(std::size_t i) {
    const std::int32_t row = pulses_.rows[i];
    const float slowest = pulses_.fractions[BlendedPulses::kSlowest][i];
    const float slow = pulses_.fractions[BlendedPulses::kSlow][i];
    const float middle = pulses_.fractions[BlendedPulses::kMiddle][i];
    const bool stays = row == row_ && slowest == slowest_ && slow == slow_;
    if (stays && middle == middle_) return pairs_;
    if (!stays || !has_both_sides_) {
      Prefetch(i + kAhead);
      const float* at = records_ + static_cast<std::ptrdiff_t>(row) * kRecordSize;
      Corners corners;
      has_both_sides_ = middle > 0 && middle < 1;
      if (!has_both_sides_) corners.Add(at, steps_[BlendedPulses::kMiddle], middle);
      corners.Add(at, steps_[BlendedPulses::kSlow], slow);
      corners.Add(at, steps_[BlendedPulses::kSlowest], slowest);
      row_ = row;
      slowest_ = slowest;
      slow_ = slow;
      if (has_both_sides_)
        MeanPairs<2 * kPairs>(at, corners, offsets_, both_sides_);
      else
        MeanPairs<kPairs>(at, corners, offsets_, pairs_);
    }
    middle_ = middle;
    if (has_both_sides_) LerpPairs<kPairs>(middle, both_sides_, pairs_);
    return pairs_;
  }

 private:
  static constexpr std::size_t kAhead = 8;  // pulses

  // Prefetches what a later pulse reads if it is in another cell: large tables are limited by memory latency.
  HWY_INLINE void Prefetch(std::size_t i) const {
    if (i >= pulses_.count || pulses_.rows[i] == pulses_.rows[i - kAhead]) return;
    const float* at = records_ + static_cast<std::ptrdiff_t>(pulses_.rows[i]) * kRecordSize;
    const float middle = pulses_.fractions[BlendedPulses::kMiddle][i];
    const std::size_t first = middle == 1 ? kPairs : 0, last = middle == 0 ? kPairs : 2 * kPairs;
    const std::ptrdiff_t slow = steps_[BlendedPulses::kSlow], slowest = steps_[BlendedPulses::kSlowest];
    for (std::size_t p = first; p < last; ++p) {
      for (const float* end : {at + offsets_[p], at + offsets_[p] + kPair - 1}) {
        ToSecondCache(end);
        ToSecondCache(end + slow);
        ToSecondCache(end + slowest);
        ToSecondCache(end + slow + slowest);
      }
    }
  }

  // The first-level cache can have few lines in flight: prefetching into it raises the rate in random order by a fifth,
  // prefetching into the second-level cache doubles it.
  static HWY_INLINE void ToSecondCache(const float* number) {
    constexpr int kRead = 0, kSecondCache = 2;
    __builtin_prefetch(number, kRead, kSecondCache);
  }

  const float* records_;
  const BlendedPulses& pulses_;
  std::ptrdiff_t steps_[BlendedPulses::kSlotCount];
  std::ptrdiff_t offsets_[2 * kPairs];
  std::int32_t row_ = -1;
  float slowest_ = 0, slow_ = 0, middle_ = 0;
  bool has_both_sides_ = false;
  HWY_ALIGN float both_sides_[2 * kPairs * kPair];
  HWY_ALIGN float pairs_[kPairs * kPair];
};

// Blends a pair, given as the vectors that hold it, into one record.
HWY_INLINE void StoreRecord(const V* pair, float fraction, float* record) {
#if HWY_TARGET != HWY_SCALAR
  if constexpr (kLanes == kPair) {
    const hn::Half<D> half;
    const auto from = hn::LowerHalf(half, pair[0]), to = hn::UpperHalf(half, pair[0]);
    hn::StoreU(Lerp(hn::Set(half, fraction), from, to), half, record);
    return;
  }
#endif
  constexpr std::size_t kVectors = kRecordSize / kLanes;
  for (std::size_t v = 0; v < kVectors; ++v)
    hn::StoreU(Lerp(hn::Set(d, fraction), pair[v], pair[kVectors + v]), d, record + v * kLanes);
}

void BlendFiveSlots(const float* records, const BlendedPulses& pulses, float* blended) {
  Cell<4> cell(records, pulses);
  for (std::size_t i = 0; i < pulses.count; ++i) {
    const float* at = cell.Enter(i);
    const V fast = hn::Set(d, pulses.fractions[BlendedPulses::kFast][i]);
    const V fastest = hn::Set(d, pulses.fractions[BlendedPulses::kFastest][i]);
    V pair[kPair / kLanes];
    for (std::size_t v = 0; v < kPair / kLanes; ++v, at += kLanes) {
      const V from = Lerp(fast, hn::Load(d, at), hn::Load(d, at + 2 * kPair));
      const V to = Lerp(fast, hn::Load(d, at + kPair), hn::Load(d, at + 3 * kPair));
      pair[v] = Lerp(fastest, from, to);
    }
    StoreRecord(pair, pulses.innermost[i], blended + i * kRecordSize);
  }
}

void BlendFourSlots(const float* records, const BlendedPulses& pulses, float* blended) {
  Cell<2> cell(records, pulses);
  for (std::size_t i = 0; i < pulses.count; ++i) {
    const float* at = cell.Enter(i);
    const V fast = hn::Set(d, pulses.fractions[BlendedPulses::kFast][i]);
    V pair[kPair / kLanes];
    for (std::size_t v = 0; v < kPair / kLanes; ++v, at += kLanes)
      pair[v] = Lerp(fast, hn::Load(d, at), hn::Load(d, at + kPair));
    StoreRecord(pair, pulses.innermost[i], blended + i * kRecordSize);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace albtpu
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace albtpu {

HWY_EXPORT(BlendFiveSlots);
HWY_EXPORT(BlendFourSlots);

void Blend(const float* records, const BlendedPulses& pulses, float* blended) {
  records += pulses.first * static_cast<std::ptrdiff_t>(kRecordSize);
  if (pulses.fractions[BlendedPulses::kFastest] != nullptr)
    HWY_DYNAMIC_DISPATCH(BlendFiveSlots)(records, pulses, blended);
  else
    HWY_DYNAMIC_DISPATCH(BlendFourSlots)(records, pulses, blended);
}

}  // namespace albtpu
#endif
