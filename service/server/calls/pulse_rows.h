// `QueryPulses`: a message a pulse.
#pragma once

#include "absl/status/status.h"
#include "albtpu/v1/uncertainty_service.pb.h"
#include "service/server/observe/outcome_tally.h"
#include "service/server/tables/table_catalog.h"

namespace albtpu::server {

// Counts the answers in `tally`. Fails as `QueryPulses` documents. Rows are answered as columns of
// themselves, so that both agree bit by bit.
absl::Status AnswerInRows(const TableCatalog& catalog, const v1::QueryPulsesRequest& request,
                          v1::QueryPulsesResponse& response, OutcomeTally& tally);

}  // namespace albtpu::server
