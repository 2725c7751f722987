// How many pulses had which outcome.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "tables/interpolation.h"

namespace albtpu::client {

class OutcomeCounts {
 public:
  void Add(const PulseUncertainty& uncertainty);

  std::uint64_t total() const { return total_; }
  std::uint64_t interpolated() const { return interpolated_; }

  // "56382 pulses: 56000 interpolated, 382 OUT_OF_DOMAIN:depth", and how many had no azimuth, if any.
  std::string Text() const;

 private:
  std::uint64_t total_ = 0;
  std::uint64_t interpolated_ = 0;
  std::uint64_t without_azimuth_ = 0;
  std::map<std::string, std::uint64_t> others_;  // By OutcomeText.
};

}  // namespace albtpu::client
