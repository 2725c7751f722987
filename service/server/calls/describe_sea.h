// The table of a sea, for `CompileSea`.
#pragma once

#include "absl/status/status.h"
#include "albtpu/v1/uncertainty_service.pb.h"
#include "service/server/calls/answer_sources.h"

namespace albtpu::server {

// Fails as documented for `CompileSea`.
absl::Status DescribeSea(AnswerSources& sources, const v1::CompileSeaRequest& request,
                         v1::CompileSeaResponse& response);

}  // namespace albtpu::server
