// Queries pulses in columns, for `QueryColumns` and each request of `StreamColumns`.
#pragma once

#include "absl/status/status.h"
#include "albtpu/v1/uncertainty_service.pb.h"
#include "service/column_message.h"
#include "service/server/calls/answer_sources.h"
#include "service/server/observe/outcome_tally.h"

namespace albtpu::server {

// Adds the fields of a QueryColumnsResponse to `response`, writes the answers directly into it, and counts them in
// `tally`. Fails as documented for `QueryColumns`.
absl::Status QueryColumns(AnswerSources& sources, const v1::QueryColumnsRequest& request,
                          ColumnMessage& response, OutcomeTally& tally);

}  // namespace albtpu::server
