// `QueryPulses`: a message a pulse.
#pragma once

#include "absl/status/status.h"
#include "albtpu/v1/uncertainty_service.pb.h"
#include "service/server/query.h"

namespace albtpu::server {

// InvalidArgument when there is no pulse, or more than limits.h allows.
absl::Status CheckRows(const Query& query, const v1::QueryPulsesRequest& request);

v1::PulseUncertainty AnswerRow(const Query& query, const v1::Pulse& pulse);

}  // namespace albtpu::server
