#include "tests/fuzz/mutate.h"

#include <algorithm>
#include <cstring>

namespace albtpu::fuzz {
namespace {

// Values at which lengths, counts and offsets tend to fail.
constexpr std::uint32_t kBoundaryValues[] = {0,      1,      0x7f,       0x80,       0xff,
                                             0x7fff, 0xffff, 0x7fffffff, 0x80000000, 0xffffffff};

}  // namespace

Mutator::Mutator(std::vector<std::string> inputs, unsigned int seed)
    : inputs_(std::move(inputs)), random_(seed) {}

std::string Mutator::Mutate(std::string input, std::size_t most) {
  for (std::size_t i = 0, changes = 1 + Below(4); i < changes; ++i) ChangeOnce(input);
  input.resize(std::min(input.size(), most));
  return input;
}

void Mutator::ChangeOnce(std::string& input) {
  const std::size_t begin = Below(input.size() + 1),
                    size = Below(std::min<std::size_t>(input.size() - begin, 32) + 1);
  switch (Below(6)) {
    case 0:
      input.erase(begin, size);
      return;
    case 1:
      input.insert(begin, std::string(input, begin, size));
      return;
    case 2:
      input.insert(begin, 1 + Below(8), static_cast<char>(Below(256)));
      return;
    case 3: {  // A piece of another input.
      const std::string& other = inputs_[Below(inputs_.size())];
      input.replace(begin, size, other, Below(other.size() + 1), Below(64));
      return;
    }
    case 4: {
      const std::uint32_t number = kBoundaryValues[Below(std::size(kBoundaryValues))];
      const std::size_t bytes = std::min(input.size() - begin, std::size_t{1} << Below(3));
      std::memcpy(input.data() + begin, &number, bytes);
      return;
    }
    default:
      if (begin < input.size()) input[begin] = static_cast<char>(input[begin] ^ 1 << Below(8));
  }
}

}  // namespace albtpu::fuzz
