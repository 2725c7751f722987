// Arbitrary bytes as the request of QueryBudget are rejected with a reason, or answered with a number for each pulse
// that has the outcome INTERPOLATED, and with none for any other.
#include <grpcpp/support/proto_buffer_reader.h>

#include <cmath>
#include <cstring>
#include <string>

#include "albtpu/v1/uncertainty_service.pb.h"
#include "service/server/calls/query_rows.h"
#include "service/server/ground/limits.h"
#include "service/server/observe/log.h"
#include "tables/file/table_io.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/tables/synthetic_table.h"
#include "tests/temporary_folder.h"

namespace {

using namespace albtpu;
using namespace albtpu::server;

// Two tables. No sea is compiled: sea_state_fuzz.cc is for those.
TableCatalog MakeCatalog() {
  const testing::TemporaryFolder folder;
  ALBTPU_MUST(WriteTable(testing::SyntheticTable(), folder / "survey.h5", Existing::kKeep).ok());
  ALBTPU_MUST(WriteTable(testing::SyntheticTable({.published = true}), folder / "published.h5", Existing::kKeep).ok());
  absl::StatusOr<TableCatalog> catalog = TableCatalog::Load(folder.path(), "survey");
  ALBTPU_MUST(catalog.ok());
  return *std::move(catalog);
}

// The rows of a column: `rows` of them, one after the other, or an absent column. Biases may be missing in a table.
void CheckColumn(const v1::QueryBudgetResponse& response, const std::string& column, std::size_t rows,
                 bool may_be_missing) {
  if (column.empty()) return;
  const auto count = static_cast<std::size_t>(response.pulse_count());
  ALBTPU_MUST(column.size() == rows * count * sizeof(float));
  for (std::size_t i = 0; i < rows * count; ++i) {
    float number;
    std::memcpy(&number, column.data() + i * sizeof number, sizeof number);
    const bool answered = response.outcomes()[i % count] == v1::OUTCOME_INTERPOLATED;
    ALBTPU_MUST(answered ? std::isfinite(number) || (may_be_missing && std::isnan(number)) : std::isnan(number));
  }
}

void CheckAnswer(const v1::QueryBudgetResponse& response) {
  const auto count = static_cast<std::size_t>(response.pulse_count());
  ALBTPU_MUST(count >= 1 && count <= kMaxPulses);
  ALBTPU_MUST(response.outcomes().size() == count && response.outcome_axes().size() == count);
  for (std::size_t i = 0; i < count; ++i) {
    const int outcome = response.outcomes()[i], axis = response.outcome_axes()[i];
    ALBTPU_MUST(v1::Outcome_IsValid(outcome) && v1::Axis_IsValid(axis));
    ALBTPU_MUST(outcome != v1::OUTCOME_INTERPOLATED || axis == v1::AXIS_UNSPECIFIED);
    ALBTPU_MUST(outcome != v1::OUTCOME_OUT_OF_DOMAIN || axis != v1::AXIS_UNSPECIFIED);
  }
  const v1::BudgetColumns& budget = response.budget();
  for (const std::string* column : {&budget.total_thu(), &budget.total_tvu(), &budget.thu_air(), &budget.tvu_air(),
                                    &budget.thu_sea(), &budget.tvu_sea()})
    CheckColumn(response, *column, 1, false);
  CheckColumn(response, budget.bias_along_beam(), 1, true);
  CheckColumn(response, budget.bias_vertical(), 1, true);
  for (const std::string* column : {&budget.covariance_total(), &budget.covariance_air(), &budget.covariance_sea(),
                                    &budget.covariance_pulse(), &budget.covariance_line(), &budget.covariance_survey()})
    CheckColumn(response, *column, 6, false);
  ALBTPU_MUST(budget.best_s44_orders().empty() || budget.best_s44_orders().size() == count);
  for (std::size_t i = 0; i < budget.best_s44_orders().size(); ++i) {
    const int order = budget.best_s44_orders()[i];
    ALBTPU_MUST(v1::S44Order_IsValid(order));
    ALBTPU_MUST(order == 0 || response.outcomes()[i] == v1::OUTCOME_INTERPOLATED);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const TableCatalog catalog = MakeCatalog();
  static ServerMetrics metrics;
  static CallLog log;
  static SeaTables seas(metrics.seas, log);
  const grpc::Slice bytes(data, size);
  const grpc::ByteBuffer message(&bytes, 1);
  grpc::ByteBuffer answer;
  OutcomeTally tally;
  AnswerSources sources(catalog, seas);
  const grpc::Status status = HandleQueryBudget(sources, message, answer, tally);
  if (sources.wanted()) return 0;
  if (!status.ok()) {
    ALBTPU_MUST(status.error_code() == grpc::StatusCode::INVALID_ARGUMENT ||
                status.error_code() == grpc::StatusCode::NOT_FOUND);
    ALBTPU_MUST(!status.error_message().empty());
    return 0;
  }
  ALBTPU_MUST(answer.Length() <= kMaxMessageBytes);
  grpc::ProtoBufferReader reader(&answer);
  v1::QueryBudgetResponse response;
  ALBTPU_MUST(response.ParseFromZeroCopyStream(&reader));
  ALBTPU_MUST(tally.pulses() == static_cast<std::size_t>(response.pulse_count()));
  CheckAnswer(response);
  return 0;
}
