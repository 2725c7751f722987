// Mutates inputs byte by byte, like libFuzzer but without coverage feedback.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace albtpu::fuzz {

class Mutator {
 public:
  // Equal inputs and seeds give equal mutations. `inputs` must not be empty.
  Mutator(std::vector<std::string> inputs, unsigned int seed);

  const std::string& AnyInput() { return inputs_[Below(inputs_.size())]; }

  // `input` with one to four changes, truncated to `most` bytes.
  std::string Mutate(std::string input, std::size_t most);

  unsigned int Number() { return static_cast<unsigned int>(random_()); }

 private:
  std::size_t Below(std::size_t end) { return random_() % end; }
  void ChangeOnce(std::string& input);

  const std::vector<std::string> inputs_;
  std::mt19937 random_;
};

}  // namespace albtpu::fuzz
