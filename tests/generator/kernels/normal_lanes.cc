#include "tests/generator/kernels/normal_lanes.h"

#include <algorithm>
#include <cstddef>

// This file is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/generator/kernels/normal_lanes.cc"
#include <hwy/foreach_target.h>

#include "generator/kernels/normal_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace albtpu {
namespace HWY_NAMESPACE {
namespace {

void Fill(const NormalStream& stream, std::span<float> normals) {
  const Floats f;
  const NormalLanes lanes(stream);
  const std::size_t at_once = 4 * hn::Lanes(f);
  for (std::size_t i = 0; i < normals.size(); i += at_once) {
    const NormalLanes::Four four = lanes(stream.part(), static_cast<std::uint32_t>(i / 4));
    const bool whole = i + at_once <= normals.size();
    HWY_ALIGN float rest[4 * hn::MaxLanes(Floats())];
    hn::StoreInterleaved4(four.first.cosine, four.first.sine, four.second.cosine, four.second.sine, f,
                          whole ? &normals[i] : rest);
    if (!whole) std::copy_n(rest, normals.size() - i, normals.begin() + i);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace albtpu
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace albtpu {
namespace {
HWY_EXPORT(Fill);
}  // namespace

void FillInSinglePrecision(const NormalStream& stream, std::span<float> normals) {
  HWY_DYNAMIC_DISPATCH(Fill)(stream, normals);
}

}  // namespace albtpu
#endif
