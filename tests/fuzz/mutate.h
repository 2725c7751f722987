// New inputs out of old ones, byte by byte: what libFuzzer does, without its knowledge of what an input reached.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace albtpu::fuzz {

class Mutator {
 public:
  // The same inputs and seed give the same changes. There must be an input.
  Mutator(std::vector<std::string> inputs, unsigned int seed);

  const std::string& AnyInput() { return inputs_[Below(inputs_.size())]; }

  // `input` with one to four changes, at most `most` bytes of it.
  std::string Mutate(std::string input, std::size_t most);

  unsigned int Number() { return static_cast<unsigned int>(random_()); }

 private:
  std::size_t Below(std::size_t end) { return random_() % end; }
  void ChangeOnce(std::string& input);

  const std::vector<std::string> inputs_;
  std::mt19937 random_;
};

}  // namespace albtpu::fuzz
