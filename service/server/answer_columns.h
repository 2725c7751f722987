// `QueryColumns` and each exchange of `StreamColumns`: columns in, columns out.
#pragma once

#include "absl/status/status.h"
#include "albtpu/v1/uncertainty_service.pb.h"
#include "service/server/table_catalog.h"

namespace albtpu::server {

// Fails as `QueryColumns` documents. Answers are written where they lie in the message.
absl::Status AnswerInColumns(const TableCatalog& catalog, const v1::QueryColumnsRequest& request,
                             v1::QueryColumnsResponse& response);

}  // namespace albtpu::server
