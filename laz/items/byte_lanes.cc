#include "laz/items/byte_lanes.h"

#include <algorithm>
#include <cstring>
#include <utility>

// The code below is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "laz/items/byte_lanes.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace albtpu::laz {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::CappedTag<std::uint32_t, kByteLanes>;
using D16 = hn::Rebind<std::uint16_t, D>;
using V = hn::Vec<D>;
constexpr D d;
constexpr std::size_t kSize = hn::MaxLanes(d), kVectors = kByteLanes / kSize;

// As SymbolModel::Update(), of all lanes of a vector.
void UpdateLanes(std::size_t first, std::uint32_t cycle, ByteLaneModels::Tables& tables) {
  std::uint16_t* const counts = tables.counts.data() + first;
  V total = hn::Add(hn::Load(d, &tables.totals[first]), hn::Set(d, cycle));
  const auto many = hn::Gt(total, hn::Set(d, kMaxCounted));
  if (!hn::AllFalse(d, many)) {
    V sum = hn::Zero(d);
    for (std::size_t i = 0; i < tables.counts.size(); i += kByteLanes) {
      const V count = hn::PromoteTo(d, hn::LoadU(D16(), counts + i));
      const V halved = hn::Sub(count, hn::IfThenElseZero(many, hn::ShiftRight<1>(count)));
      hn::StoreU(hn::DemoteTo(D16(), hn::BitCast(hn::RebindToSigned<D>(), halved)), D16(), counts + i);
      sum = hn::Add(sum, halved);
    }
    total = hn::IfThenElse(many, sum, total);
  }
  hn::Store(total, d, &tables.totals[first]);
  alignas(64) std::array<std::uint32_t, kSize> scales;
  for (std::size_t l = 0; l < kSize; ++l) scales[l] = 0x80000000u / tables.totals[first + l];
  const V scale = hn::Load(d, scales.data()), all = hn::Set(d, 1u << kProbabilityBits);
  std::uint32_t* const shares = tables.shares.data() + first;
  V sum = hn::Zero(d), below = sum;
  const std::size_t last = tables.shares.size() - kByteLanes;
  for (std::size_t i = 0; i < last; i += kByteLanes) {
    sum = hn::Add(sum, hn::PromoteTo(d, hn::LoadU(D16(), counts + i)));
    const V end = hn::ShiftRight<31 - kProbabilityBits>(hn::Mul(scale, sum));
    hn::Store(hn::Or(below, hn::ShiftLeft<kProbabilityBits>(hn::Sub(end, below))), d, shares + i);
    below = end;
  }
  const V rest = hn::ShiftLeft<kProbabilityBits>(hn::Sub(all, below));
  hn::Store(hn::Or(hn::Or(below, rest), hn::Set(d, ByteLaneModels::kIsLast)), d, shares + last);
}

void UpdateTables(std::uint32_t cycle, ByteLaneModels::Tables& tables) {
  for (std::size_t v = 0; v < kVectors; ++v) UpdateLanes(v * kSize, cycle, tables);
}

#if HWY_TARGET == HWY_SCALAR

// Leaves the coding of all lanes to EncodeLane().
void EncodeRun(const LaneWindow& window, const ByteLaneRun& run, ByteLaneModels::Tables& tables, LaneIntervals& lanes) {
  for (std::size_t l = 0; l < kByteLanes; ++l) {
    lanes.reach[l] = ~std::uint64_t{0};
    std::uint8_t last = window.Byte(l, run.before);
    for (std::uint32_t i = 0; i < run.count; ++i) {
      const std::uint8_t byte = window.Byte(l, run.record(i) + window.offset);
      ++tables.counts[static_cast<std::uint8_t>(byte - last) * kByteLanes + l];
      last = byte;
    }
  }
}

#else

using D8 = hn::CappedTag<std::uint8_t, LaneWindow::kSize>;
using DI = hn::RebindToSigned<D>;
using DB = hn::Repartition<std::uint8_t, D>;
using DW = hn::Repartition<std::uint64_t, D>;
using W = hn::Vec<DW>;
constexpr DW dw;

// The even and the odd lanes of a vector, each in 64 bits.
struct Halves {
  W even, odd;
};

HWY_INLINE Halves Widen(V v) {
  const W wide = hn::BitCast(dw, v);
  return {hn::And(wide, hn::Set(dw, 0xFFFFFFFFu)), hn::ShiftRight<32>(wide)};
}

using Numbers = ByteLaneModels::Lanes<std::uint64_t>;

HWY_INLINE void Store(const Halves& halves, std::size_t vector, Numbers& numbers) {
  hn::Store(halves.even, dw, &numbers[vector * kSize]);
  hn::Store(halves.odd, dw, &numbers[vector * kSize + kSize / 2]);
}

// Between the order of lanes and that of Store().
constexpr std::size_t LaneOf(std::size_t stored) {
  const std::size_t in_vector = stored % kSize;
  return stored - in_vector + 2 * (in_vector % (kSize / 2)) + in_vector / (kSize / 2);
}

HWY_INLINE Halves Load(const Numbers& of_lanes, std::size_t vector) {
  alignas(64) Numbers numbers;
  for (std::size_t i = 0; i < kByteLanes; ++i) numbers[i] = of_lanes[LaneOf(i)];
  return {hn::Load(dw, &numbers[vector * kSize]), hn::Load(dw, &numbers[vector * kSize + kSize / 2])};
}

HWY_INLINE W BigEndian(W v) {
  alignas(16) static constexpr std::uint8_t kOrder[16] = {7, 6, 5, 4, 3, 2, 1, 0, 15, 14, 13, 12, 11, 10, 9, 8};
  return hn::BitCast(dw, hn::TableLookupBytes(hn::BitCast(DB(), v), hn::LoadDup128(DB(), kOrder)));
}

HWY_INLINE W LargerHalves(W a, W b) { return hn::BitCast(dw, hn::Max(hn::BitCast(d, a), hn::BitCast(d, b))); }

// The intervals of a vector of lanes, as LaneIntervals.
struct Intervals {
  V length;
  Halves begin, next, reach;
};

// Codes the symbols of one point by their shares. States the bytes to write, and where.
HWY_INLINE void Narrow(V share, std::size_t vector, Intervals& at, Numbers& bytes, Numbers& places) {
  const V mask = hn::Set(d, ByteLaneModels::kShareMask);
  const V part = hn::ShiftRight<kProbabilityBits>(at.length);
  const V by = hn::Mul(hn::And(share, mask), part);
  const V is_last = hn::BitCast(d, hn::BroadcastSignBit(hn::BitCast(DI(), share)));
  const V rest = hn::And(hn::And(at.length, mask), is_last);
  const V own = hn::And(hn::ShiftRight<kProbabilityBits>(share), mask);
  const V length = hn::Add(hn::Mul(own, part), rest);
  // At least 2^9 is left, so that at most two bytes leave.
  const auto eight_if_zero = [](V v) { return hn::IfThenElseZero(hn::Eq(v, hn::Zero(d)), hn::Set(d, 8)); };
  const V bits = hn::Add(eight_if_zero(hn::ShiftRight<24>(length)), eight_if_zero(hn::ShiftRight<16>(length)));
  at.length = hn::Shl(length, bits);
  const Halves raise = Widen(by), shift = Widen(bits);
  const auto step = [](W raised_by, W shifted_by, W& begin, W& next, W& reach) {
    const W raised = hn::Add(begin, raised_by);
    begin = hn::Shl(raised, shifted_by);
    next = hn::Add(next, hn::ShiftRight<3>(shifted_by));
    reach = LargerHalves(reach, begin);
    return BigEndian(raised);
  };
  Store(at.next, vector, places);
  const W even = step(raise.even, shift.even, at.begin.even, at.next.even, at.reach.even);
  const W odd = step(raise.odd, shift.odd, at.begin.odd, at.next.odd, at.reach.odd);
  Store({even, odd}, vector, bytes);
}

void EncodeRun(const LaneWindow& window, const ByteLaneRun& run, ByteLaneModels::Tables& tables, LaneIntervals& lanes) {
  const D8 d8;
  const auto places_in_window = hn::LoadU(d8, window.places.data());
  const auto load = [&](const char* bytes) { return hn::LoadU(d8, reinterpret_cast<const std::uint8_t*>(bytes)); };
  auto last = load(run.before);
  std::array<Intervals, kVectors> intervals;
  for (std::size_t v = 0; v < kVectors; ++v) {
    const Halves begin = Load(lanes.begin, v);
    intervals[v] = {hn::Load(d, &lanes.length[v * kSize]), begin, Load(lanes.next, v), begin};
  }
  alignas(16) std::array<std::uint8_t, LaneWindow::kSize> symbols;
  alignas(64) Numbers bytes, places;
  const std::uint32_t* const shares = tables.shares.data();
  std::uint16_t* const counts = tables.counts.data();
  const std::size_t record_length = run.record_length;
  const char* record = run.first + window.offset;
  for (const char* const end = record + run.count * record_length; record != end; record += record_length) {
    const auto known = load(record);
    hn::Store(hn::TableLookupBytesOr0(hn::Sub(known, last), places_in_window), d8, symbols.data());
    last = known;
    for (std::size_t v = 0; v < kVectors; ++v) {
      const V symbol = hn::PromoteTo(d, hn::LoadU(hn::Rebind<std::uint8_t, D>(), &symbols[v * kSize]));
      const V lane = hn::Iota(d, static_cast<std::uint32_t>(v * kSize));
      const V index = hn::Add(hn::Mul(symbol, hn::Set(d, kByteLanes)), lane);
      Narrow(hn::GatherIndex(d, shares, hn::BitCast(DI(), index)), v, intervals[v], bytes, places);
    }
    // Through the memory: to take the lanes out of registers takes longer.
    asm volatile("" : : "r"(symbols.data()), "r"(bytes.data()), "r"(places.data()) : "memory");
    for (std::size_t l = 0; l < kByteLanes; ++l)
      std::memcpy(reinterpret_cast<char*>(places[l]) - ArithmeticEncoder::kOpenBytes, &bytes[l], sizeof bytes[l]);
    for (std::size_t l = 0; l < kByteLanes; ++l) ++counts[symbols[l] * kByteLanes + l];
  }
  const auto give = [](const Halves& halves, std::size_t vector, Numbers& of_lanes) {
    alignas(64) Numbers numbers;
    Store(halves, vector, numbers);
    for (std::size_t i = vector * kSize; i < (vector + 1) * kSize; ++i) of_lanes[LaneOf(i)] = numbers[i];
  };
  for (std::size_t v = 0; v < kVectors; ++v) {
    hn::Store(intervals[v].length, d, &lanes.length[v * kSize]);
    give(intervals[v].begin, v, lanes.begin);
    give(intervals[v].next, v, lanes.next);
    give(intervals[v].reach, v, lanes.reach);
  }
}

#endif

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace albtpu::laz
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace albtpu::laz {

HWY_EXPORT(UpdateTables);
HWY_EXPORT(EncodeRun);

void ByteLaneModels::Start() {
  tables_.counts.fill(1);
  tables_.totals.fill(0);
  HWY_DYNAMIC_DISPATCH(UpdateTables)(kSymbols, tables_);
  until_update_ = cycle_ = (kSymbols + 6) >> 1;
}

void ByteLaneModels::Pass(std::uint32_t points) {
  if ((until_update_ -= points) > 0) return;
  HWY_DYNAMIC_DISPATCH(UpdateTables)(cycle_, tables_);
  until_update_ = cycle_ = std::min((5 * cycle_) >> 2, (kSymbols + 6) << 3);
}

namespace {

// As EncodeRun() does it for all lanes, but with carries through any number of bytes. Counts no symbols.
void EncodeLane(const LaneWindow& window, const ByteLaneRun& run, const ByteLaneModels::Tables& tables,
                std::size_t lane, ArithmeticEncoder& encoder) {
  constexpr std::uint32_t kMask = ByteLaneModels::kShareMask;
  ArithmeticEncoder local = std::move(encoder);  // Its state stays in registers here.
  std::uint8_t last = window.Byte(lane, run.before);
  for (std::uint32_t i = 0; i < run.count; ++i) {
    const std::uint8_t byte = window.Byte(lane, run.record(i) + window.offset);
    const std::uint32_t share = tables.shares[static_cast<std::uint8_t>(byte - last) * kByteLanes + lane];
    last = byte;
    const std::uint32_t length = local.interval().length, part = length >> kProbabilityBits;
    const std::uint32_t rest = (share & ByteLaneModels::kIsLast) != 0 ? length & kMask : 0;
    local.Narrow((share & kMask) * part, (share >> kProbabilityBits & kMask) * part + rest);
  }
  encoder = std::move(local);
}

}  // namespace

void EncodeByteLanes(const LaneWindow& window, const ByteLaneRun& run, ByteLaneModels& models,
                     const std::array<ArithmeticEncoder*, kByteLanes>& encoders) {
  LaneIntervals lanes;
  for (std::size_t l = 0; l < kByteLanes; ++l) {
    lanes.begin[l] = encoders[l]->interval().begin;
    lanes.length[l] = encoders[l]->interval().length;
    lanes.next[l] = reinterpret_cast<std::uintptr_t>(encoders[l]->Reserve(LaneIntervals::kMostBytes * run.count));
  }
  HWY_DYNAMIC_DISPATCH(EncodeRun)(window, run, models.tables(), lanes);
  for (std::size_t l = 0; l < kByteLanes; ++l) {
    if (lanes.reach[l] >> 32 == 0xFFFFFFFFu) [[unlikely]]
      EncodeLane(window, run, models.tables(), l, *encoders[l]);
    else
      encoders[l]->Continue({lanes.begin[l], lanes.length[l]}, reinterpret_cast<char*>(lanes.next[l]));
  }
  models.Pass(run.count);
}

}  // namespace albtpu::laz
#endif
