// Counts the pulses of an answer by outcome.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "tables/schema.h"

namespace albtpu::server {

struct OutcomeTally {
  std::size_t interpolated = 0;
  // By the axis that caused the outcome.
  std::array<std::size_t, kAxisCount> out_of_domain = {};
  std::array<std::size_t, kAxisCount> invalid = {};
  std::size_t invalid_aircraft = 0;  // Caused by a number of the aircraft.

  std::size_t pulses() const;

  // Adds pulses given by their columns on the wire: the numbers of `Outcome` and `Axis`.
  void Add(std::span<const std::uint8_t> outcomes, std::span<const std::uint8_t> outcome_axes);
};

}  // namespace albtpu::server
