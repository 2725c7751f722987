#include "service/server/observe/call_record.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "absl/strings/str_cat.h"

namespace albtpu::server {
namespace {

spdlog::level::level_enum LevelOf(grpc::StatusCode code) {
  switch (code) {
    case grpc::StatusCode::INTERNAL:
    case grpc::StatusCode::UNKNOWN:
    case grpc::StatusCode::DATA_LOSS:
      return spdlog::level::err;
    case grpc::StatusCode::RESOURCE_EXHAUSTED:
      return spdlog::level::warn;
    default:
      return spdlog::level::info;
  }
}

}  // namespace

CallRecord::CallRecord(const CallRecords& records, Method method, grpc::CallbackServerContext& context)
    : records_(records), method_(method), context_(context), request_id_(context) {
  records.metrics.CountBegin(method);
}

void CallRecord::CountAnswer(const OutcomeTally& tally, Clock::time_point asked) {
  ++answers_;
  pulses_ += tally.pulses();
  records_.metrics.CountAnswer(method_, tally, Clock::now() - asked);
}

void CallRecord::End(const grpc::Status& status) const {
  records_.metrics.CountEnd(method_, status.error_code());
  if (!status.ok()) context_.AddTrailingMetadata(RequestId::kMetadata, request_id_.text());
  if (!status.ok() || method_ == Method::kStreamColumns || method_ == Method::kReloadTables) {
    WriteLine(status);
  }
}

void CallRecord::WriteLine(const grpc::Status& status) const {
  const double seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
  LogFields fields = {{"method", Name(method_)},
                      {"code", CodeName(status.error_code())},
                      {"seconds", std::round(seconds * 1e6) / 1e6},
                      {"peer", context_.peer()}};
  if (method_ <= Method::kStreamColumns) {
    fields["answers"] = answers_;
    fields["pulses"] = pulses_;
  }
  const RequestScope scope(request_id_);
  const bool has_message = !status.error_message().empty();
  records_.log.Write(LevelOf(status.error_code()),
                     status.ok()
                         ? "call ended"
                         : absl::StrCat("call failed", has_message ? ": " : "", status.error_message()),
                     std::move(fields));
}

}  // namespace albtpu::server
