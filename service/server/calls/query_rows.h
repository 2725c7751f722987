// Queries pulses in rows, one message for each pulse, for `QueryPulses`.
#pragma once

#include "absl/status/status.h"
#include "albtpu/v1/uncertainty_service.pb.h"
#include "service/server/calls/answer_sources.h"
#include "service/server/observe/outcome_tally.h"

namespace albtpu::server {

// Counts the answers in `tally`. Rows are copied into columns and queried as those, so both give the same bits. Fails
// as documented for `QueryPulses`.
absl::Status QueryRows(AnswerSources& sources, const v1::QueryPulsesRequest& request,
                       v1::QueryPulsesResponse& response, OutcomeTally& tally);

}  // namespace albtpu::server
