// Shared by all fuzz targets: what a target is, how it reports a fault, and what its mutator draws from.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/status.h"

namespace albtpu::fuzz {

using Random = std::minstd_rand;  // As in libFuzzer.

struct Target {
  std::string_view name;  // Of its program, NAME_fuzz, and of the folders of its inputs.
  // Takes arbitrary bytes, in memory beyond which sanitizers detect reads, and checks what must hold for all of them.
  void (*run)(std::string_view input);
  // Makes an input that gets further than mutated bytes do. An empty one, or one of more than `most` bytes, leaves the
  // input to be mutated byte by byte.
  std::string (*mutate)(std::string_view input, std::size_t most, Random& random) = nullptr;
};

// Of one source. CMakeLists.txt makes a program of each.
extern const std::vector<Target> kTargets;

// Aborts if the condition is false, also in builds without assertions.
#define ALBTPU_MUST(condition)                                                            \
  do {                                                                                    \
    if (!(condition)) {                                                                   \
      std::fprintf(stderr, "%s:%d: does not hold: %s\n", __FILE__, __LINE__, #condition); \
      std::abort();                                                                       \
    }                                                                                     \
  } while (false)

// The status of a file that is refused: of its kind, with some words, which begin with the `name` of the file.
inline void MustExplain(const absl::Status& status, std::string_view name = "") {
  ALBTPU_MUST(absl::IsInvalidArgument(status) || absl::IsDataLoss(status) ||
              (name.empty() && absl::IsUnimplemented(status)));
  ALBTPU_MUST(status.message().size() > name.size() + 20);
  ALBTPU_MUST(status.message().substr(0, name.size()) == absl::string_view(name.data(), name.size()));
}

// Chooses one input in `many`, always the same, for checks that take much longer than the rest.
inline bool IsOneIn(std::size_t many, std::string_view input) {
  return std::hash<std::string_view>()(input) % many == 0;
}

// `bytes` mutated byte by byte, `most` at most: by libFuzzer, or by replay_main.cc.
std::string MutateBytes(std::string bytes, std::size_t most);

template <typename Element, std::size_t count>
const Element& AnyOf(const Element (&elements)[count], Random& random) {
  return elements[random() % count];
}

// Zeros, usual nodes and limits of our axes, and numbers at which arithmetic fails; of either sign.
template <typename Number>
Number NotableNumber(Random& random) {
  using Limits = std::numeric_limits<Number>;
  constexpr Number kExtreme[] = {Limits::min(), Limits::denorm_min(), Limits::max(), Limits::infinity(),
                                 Limits::quiet_NaN()};
  constexpr Number kUsual[] = {0,     1e-7f, 1e-6f, 1e-3f, 0.1f, 0.25f, 0.4f, 1,   2,    3,     3.1416f, 7,    10,
                               12.5f, 20,    25,    45,    90,   91,    100,  150, 1000, 65536, 1e5f,    1e6f, 1e12f};
  const Number number = random() % 4 == 0 ? AnyOf(kExtreme, random) : AnyOf(kUsual, random);
  return random() % 4 == 0 ? -number : number;
}

}  // namespace albtpu::fuzz
