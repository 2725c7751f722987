// The entry points of libFuzzer and of replay_main.cc, for the target that the program is named after.
#include "tests/fuzz/fuzz_target.h"

#include <algorithm>
#include <cstring>
#include <filesystem>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace albtpu::fuzz {
namespace {

const Target* this_target;

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

// HDF5 asks for as much memory as a damaged file states; if it gets none, it fails to read. What is asked for by `new`
// is a fault all the same.
constexpr char kAllocatorOptions[] = "allocator_may_return_null=1:max_allocation_size_mb=2048";
extern "C" const char* __asan_default_options() { return kAllocatorOptions; }
extern "C" const char* __tsan_default_options() { return kAllocatorOptions; }

// Is called first. The program is NAME_fuzz.
extern "C" int LLVMFuzzerInitialize(int*, char*** arguments) {
  const std::string program = std::filesystem::path(**arguments).filename();
  const auto target =
      std::ranges::find_if(kTargets, [&](const Target& each) { return program == std::string(each.name) + "_fuzz"; });
  ALBTPU_MUST(target != kTargets.end());
  this_target = &*target;
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  this_target->run(View(data, size));
  return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned int seed) {
  Random random(seed);
  const auto mutate = this_target->mutate;
  const std::string other = mutate == nullptr ? "" : mutate(View(data, size), max_size, random);
  if (other.empty() || other.size() > max_size) return LLVMFuzzerMutate(data, size, max_size);
  std::memcpy(data, other.data(), other.size());
  return other.size();
}

}  // namespace albtpu::fuzz
