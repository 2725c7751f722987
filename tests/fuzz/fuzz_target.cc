// The entry points of libFuzzer and of replay_main.cc, for the target ALBTPU_FUZZ_TARGET.
#include "tests/fuzz/fuzz_target.h"

#include <algorithm>
#include <cstring>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace albtpu::fuzz {
namespace {

const Target& ThisTarget() {
  static const auto target = std::ranges::find(kTargets, ALBTPU_FUZZ_TARGET, &Target::name);
  ALBTPU_MUST(target != kTargets.end());
  return *target;
}

std::string_view View(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

}  // namespace

std::string MutateBytes(std::string bytes, std::size_t most) {
  if (most == 0) return "";
  const std::size_t size = std::min(bytes.size(), most);
  bytes.resize(most);
  bytes.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(bytes.data()), size, most));
  return bytes;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ThisTarget().run(View(data, size));
  return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned int seed) {
  Random random(seed);
  const auto mutate = ThisTarget().mutate;
  const std::string other = mutate == nullptr ? "" : mutate(View(data, size), max_size, random);
  if (other.empty() || other.size() > max_size) return LLVMFuzzerMutate(data, size, max_size);
  std::memcpy(data, other.data(), other.size());
  return other.size();
}

}  // namespace albtpu::fuzz
