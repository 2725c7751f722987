// The water of a request: read, checked and named.
#pragma once

#include <string_view>

#include "absl/status/statusor.h"
#include "albtpu/v1/water.pb.h"
#include "budget/water/known_water.h"
#include "tables/digest.h"

namespace albtpu::server {

// INVALID_ARGUMENT with the paths of wrong and missing fields, which begin with `water`; of optics that contradict each
// other, `water` alone.
absl::StatusOr<KnownWater> ReadWater(const v1::WaterState& state);

// SHA-256 over the fields of `state` that this server knows, and `table`, which identifies the table that computes it.
// Waters with the same key are equal.
Sha256Digest KeyOf(const v1::WaterState& state, std::string_view table);

}  // namespace albtpu::server
