#include "tables/query/record_blend.h"

// What follows is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tables/query/record_blend.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace albtpu {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
// Two records, neighbours on the fastest axis, in one vector or more.
constexpr std::size_t kPair = 2 * kRecordSize;
using D = hn::CappedTag<float, kPair>;
using V = hn::Vec<D>;
constexpr D d;
constexpr std::size_t kLanes = hn::MaxLanes(d);

// Exactly `from` at 0 and `to` at 1.
template <class W>
HWY_INLINE W Lerp(W fraction, W from, W to) {
  return hn::MulAdd(fraction, to, hn::NegMulAdd(fraction, from, from));
}

// The corners of some of the axes, those in which a pulse is between two nodes; the last of them is blended
// first.
struct Corners {
  std::ptrdiff_t steps[3];
  float fractions[3];
  int count = 0;

  // On a node the other corner has no part: it need not be read.
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

// The pairs at `kPairs` offsets from `at`.
template <int kAxes, std::size_t kPairs>
HWY_INLINE void MeanPairs(const float* at, const Corners& corners, const std::ptrdiff_t* offsets,
                          float* pairs) {
  for (std::size_t p = 0; p < kPairs; ++p) {
    for (std::size_t lane = 0; lane < kPair; lane += kLanes) {
      hn::Store(Mean<kAxes>(at + offsets[p] + lane, corners), d, pairs + p * kPair + lane);
    }
  }
}

template <std::size_t kPairs>
HWY_INLINE void MeanPairs(const float* at, const Corners& corners, const std::ptrdiff_t* offsets,
                          float* pairs) {
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

// From pairs on both sides of an axis, those of one side first, to pairs.
template <std::size_t kPairs>
HWY_INLINE void LerpPairs(float fraction, const float* sides, float* pairs) {
  const V f = hn::Set(d, fraction);
  for (std::size_t lane = 0; lane < kPairs * kPair; lane += kLanes) {
    const V from = hn::Load(d, sides + lane), to = hn::Load(d, sides + kPairs * kPair + lane);
    hn::Store(Lerp(f, from, to), d, pairs + lane);
  }
}

// The means over wind speed, fetch and azimuth in the cell of a pulse. The next pulse is often in the same
// cell at the same wind, fetch and even azimuth.
template <std::size_t kPairs>
class Cell {
 public:
  Cell(const float* records, const BlendedPulses& pulses) : records_(records), pulses_(pulses) {
    for (std::size_t outer = 0; outer < BlendedPulses::kOuterCount; ++outer) {
      steps_[outer] = pulses.steps[outer] * static_cast<std::ptrdiff_t>(kRecordSize);
    }
    for (std::size_t p = 0; p < 2 * kPairs; ++p) {
      offsets_[p] = (p & 1) * steps_[kPairs == 4 ? BlendedPulses::kFootprint : BlendedPulses::kIncidence] +
                    (kPairs == 4 ? (p >> 1 & 1) * steps_[BlendedPulses::kIncidence] : 0) +
                    (p / kPairs) * steps_[BlendedPulses::kAzimuth];
    }
  }

  // The pairs at the corners of incidence and, fastest, footprint.
  HWY_INLINE const float* Enter(std::size_t i) {
    const std::int32_t row = pulses_.rows[i];
    const float wind_speed = pulses_.fractions[BlendedPulses::kWindSpeed][i];
    const float fetch = pulses_.fractions[BlendedPulses::kFetch][i];
    const float azimuth = pulses_.fractions[BlendedPulses::kAzimuth][i];
    const bool stays = row == row_ && wind_speed == wind_speed_ && fetch == fetch_;
    if (stays && azimuth == azimuth_) return pairs_;
    if (!stays || !has_both_azimuths_) {
      Prefetch(i + kAhead);
      const float* at = records_ + static_cast<std::ptrdiff_t>(row) * kRecordSize;
      Corners corners;
      has_both_azimuths_ = azimuth > 0 && azimuth < 1;
      if (!has_both_azimuths_) corners.Add(at, steps_[BlendedPulses::kAzimuth], azimuth);
      corners.Add(at, steps_[BlendedPulses::kFetch], fetch);
      corners.Add(at, steps_[BlendedPulses::kWindSpeed], wind_speed);
      row_ = row;
      wind_speed_ = wind_speed;
      fetch_ = fetch;
      if (has_both_azimuths_) {
        MeanPairs<2 * kPairs>(at, corners, offsets_, both_azimuths_);
      } else {
        MeanPairs<kPairs>(at, corners, offsets_, pairs_);
      }
    }
    azimuth_ = azimuth;
    if (has_both_azimuths_) LerpPairs<kPairs>(azimuth, both_azimuths_, pairs_);
    return pairs_;
  }

 private:
  static constexpr std::size_t kAhead = 8;  // pulses

  // Asks for what a pulse to come will read, if it is in another cell: a large table is bound by memory.
  HWY_INLINE void Prefetch(std::size_t i) const {
    if (i >= pulses_.count || pulses_.rows[i] == pulses_.rows[i - kAhead]) return;
    const float* at = records_ + static_cast<std::ptrdiff_t>(pulses_.rows[i]) * kRecordSize;
    const float azimuth = pulses_.fractions[BlendedPulses::kAzimuth][i];
    const std::size_t first = azimuth == 1 ? kPairs : 0, last = azimuth == 0 ? kPairs : 2 * kPairs;
    const std::ptrdiff_t fetch = steps_[BlendedPulses::kFetch],
                         wind_speed = steps_[BlendedPulses::kWindSpeed];
    for (std::size_t p = first; p < last; ++p) {
      for (const float* end : {at + offsets_[p], at + offsets_[p] + kPair - 1}) {
        ToSecondCache(end);
        ToSecondCache(end + fetch);
        ToSecondCache(end + wind_speed);
        ToSecondCache(end + fetch + wind_speed);
      }
    }
  }

  // The first has room for few lines that are under way: to ask it gains a fifth, to ask the second doubles the
  // rate in random order.
  static HWY_INLINE void ToSecondCache(const float* number) {
    constexpr int kRead = 0, kSecondCache = 2;
    __builtin_prefetch(number, kRead, kSecondCache);
  }

  const float* records_;
  const BlendedPulses& pulses_;
  std::ptrdiff_t steps_[BlendedPulses::kOuterCount];
  std::ptrdiff_t offsets_[2 * kPairs];
  std::int32_t row_ = -1;
  float wind_speed_ = 0, fetch_ = 0, azimuth_ = 0;
  bool has_both_azimuths_ = false;
  HWY_ALIGN float both_azimuths_[2 * kPairs * kPair];
  HWY_ALIGN float pairs_[kPairs * kPair];
};

// From one pair, given by vectors that hold it, to one record.
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
  for (std::size_t v = 0; v < kVectors; ++v) {
    hn::StoreU(Lerp(hn::Set(d, fraction), pair[v], pair[kVectors + v]), d, record + v * kLanes);
  }
}

void BlendWithFootprint(const float* records, const BlendedPulses& pulses, float* blended) {
  Cell<4> cell(records, pulses);
  for (std::size_t i = 0; i < pulses.count; ++i) {
    const float* at = cell.Enter(i);
    const V incidence = hn::Set(d, pulses.fractions[BlendedPulses::kIncidence][i]);
    const V footprint = hn::Set(d, pulses.fractions[BlendedPulses::kFootprint][i]);
    V pair[kPair / kLanes];
    for (std::size_t v = 0; v < kPair / kLanes; ++v, at += kLanes) {
      const V from = Lerp(incidence, hn::Load(d, at), hn::Load(d, at + 2 * kPair));
      const V to = Lerp(incidence, hn::Load(d, at + kPair), hn::Load(d, at + 3 * kPair));
      pair[v] = Lerp(footprint, from, to);
    }
    StoreRecord(pair, pulses.last[i], blended + i * kRecordSize);
  }
}

void BlendWithoutFootprint(const float* records, const BlendedPulses& pulses, float* blended) {
  Cell<2> cell(records, pulses);
  for (std::size_t i = 0; i < pulses.count; ++i) {
    const float* at = cell.Enter(i);
    const V incidence = hn::Set(d, pulses.fractions[BlendedPulses::kIncidence][i]);
    V pair[kPair / kLanes];
    for (std::size_t v = 0; v < kPair / kLanes; ++v, at += kLanes) {
      pair[v] = Lerp(incidence, hn::Load(d, at), hn::Load(d, at + kPair));
    }
    StoreRecord(pair, pulses.last[i], blended + i * kRecordSize);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace albtpu
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace albtpu {

HWY_EXPORT(BlendWithFootprint);
HWY_EXPORT(BlendWithoutFootprint);

void Blend(const float* records, const BlendedPulses& pulses, float* blended) {
  records += pulses.first * static_cast<std::ptrdiff_t>(kRecordSize);
  if (pulses.fractions[BlendedPulses::kFootprint] != nullptr) {
    HWY_DYNAMIC_DISPATCH(BlendWithFootprint)(records, pulses, blended);
  } else {
    HWY_DYNAMIC_DISPATCH(BlendWithoutFootprint)(records, pulses, blended);
  }
}

}  // namespace albtpu
#endif
