// `QueryColumns` and each exchange of `StreamColumns`: columns in, columns out.
#pragma once

#include "absl/status/status.h"
#include "albtpu/v1/uncertainty_service.pb.h"
#include "service/column_message.h"
#include "service/server/observe/outcome_tally.h"
#include "service/server/tables/table_catalog.h"

namespace albtpu::server {

// Adds the fields of a QueryColumnsResponse to `response`; answers are written where they lie in it, and
// counted in `tally`. Fails as `QueryColumns` documents.
absl::Status AnswerInColumns(const TableCatalog& catalog, const v1::QueryColumnsRequest& request,
                             ColumnMessage& response, OutcomeTally& tally);

}  // namespace albtpu::server
