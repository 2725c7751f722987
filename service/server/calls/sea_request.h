// The sea of a request: read, checked and named.
#pragma once

#include "absl/status/statusor.h"
#include "albtpu/v1/sea.pb.h"
#include "service/seas/known_sea.h"
#include "tables/digest.h"

namespace albtpu::server {

// INVALID_ARGUMENT with the paths of the wrong fields, relative to `state`: of a list only the first wrong number, and
// kMaxSeaViolations fields at most.
absl::StatusOr<KnownSea> ReadSea(const v1::SeaState& state);

// SHA-256 over the fields of `state` that this server knows. States with the same key are equal.
Sha256Digest KeyOf(const v1::SeaState& state);

}  // namespace albtpu::server
