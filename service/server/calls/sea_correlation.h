// What neighbouring pulses share of the sea of a request.
#pragma once

#include "absl/status/statusor.h"
#include "albtpu/v1/sea.pb.h"
#include "service/seas/known_sea.h"

namespace albtpu::server {

// INVALID_ARGUMENT with the paths of the wrong fields, relative to `query`: kMaxSeaViolations at most.
absl::StatusOr<v1::SeaCorrelation> CorrelateSea(const KnownSea& sea, const v1::CorrelationQuery& query);

}  // namespace albtpu::server
