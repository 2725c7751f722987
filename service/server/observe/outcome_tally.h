// How many pulses of an answer had which outcome.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "tables/schema.h"

namespace albtpu::server {

struct OutcomeTally {
  std::size_t interpolated = 0;
  // By the axis that is named.
  std::array<std::size_t, kAxisCount> out_of_domain = {};
  std::array<std::size_t, kAxisCount> invalid = {};

  std::size_t pulses() const;

  // Adds pulses by their columns on the wire: numbers of `Outcome` and of `Axis`.
  void Add(std::span<const std::uint8_t> outcomes, std::span<const std::uint8_t> outcome_axes);
};

}  // namespace albtpu::server
