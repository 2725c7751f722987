#include "service/server/uncertainty_service.h"

#include <algorithm>

#include "service/server/answer_columns.h"
#include "service/server/limits.h"
#include "service/server/pulse_columns.h"
#include "service/server/pulse_rows.h"
#include "service/server/query.h"
#include "service/server/status.h"
#include "service/server/table_messages.h"
#include "service/server/wire_enums.h"

namespace albtpu::server {
namespace {

// Calls `answer(begin, end)` for the pulses in blocks, as long as the caller waits.
template <typename Answer>
absl::Status InBlocks(const grpc::ServerContext& context, std::size_t count, Answer answer) {
  for (std::size_t begin = 0; begin < count; begin += kPulsesBetweenCancellationChecks) {
    if (context.IsCancelled()) return absl::CancelledError("the caller has gone, or its deadline has passed");
    answer(begin, std::min(begin + kPulsesBetweenCancellationChecks, count));
  }
  return absl::OkStatus();
}

absl::Status AnswerRows(const grpc::ServerContext& context, const TableCatalog& catalog,
                        const v1::QueryPulsesRequest& request, v1::QueryPulsesResponse& response) {
  const absl::StatusOr<Query> query = ReadOptions(request.options(), catalog);
  if (!query.ok()) return query.status();
  const absl::Status status = CheckRows(*query, request);
  if (!status.ok()) return status;
  *response.mutable_table() = WriteReference(*query->source);
  response.set_coverage(ToWire(query->coverage));
  response.mutable_uncertainties()->Reserve(request.pulses_size());
  return InBlocks(context, request.pulses().size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      *response.add_uncertainties() = AnswerRow(*query, request.pulses(static_cast<int>(i)));
    }
  });
}

absl::Status AnswerInColumns(const grpc::ServerContext& context, const TableCatalog& catalog,
                             const v1::QueryColumnsRequest& request, v1::QueryColumnsResponse& response) {
  const absl::StatusOr<Query> query = ReadOptions(request.options(), catalog);
  if (!query.ok()) return query.status();
  const absl::StatusOr<QuantitySelection> selection = ReadQuantities(request);
  if (!selection.ok()) return selection.status();
  const absl::StatusOr<PulseColumns> pulses = PulseColumns::Read(request.pulses());
  if (!pulses.ok()) return pulses.status();
  *response.mutable_table() = WriteReference(*query->source);
  response.set_coverage(ToWire(query->coverage));
  AnswerColumns answer(*query, *selection, *pulses, response);
  return InBlocks(context, pulses->size(),
                  [&](std::size_t begin, std::size_t end) { answer.Fill(begin, end); });
}

}  // namespace

grpc::Status UncertaintyService::QueryPulses(grpc::ServerContext* context,
                                             const v1::QueryPulsesRequest* request,
                                             v1::QueryPulsesResponse* response) {
  return ToGrpcStatus(AnswerRows(*context, catalog_, *request, *response));
}

grpc::Status UncertaintyService::QueryColumns(grpc::ServerContext* context,
                                              const v1::QueryColumnsRequest* request,
                                              v1::QueryColumnsResponse* response) {
  return ToGrpcStatus(AnswerInColumns(*context, catalog_, *request, *response));
}

grpc::Status UncertaintyService::ListTables(grpc::ServerContext* /*context*/,
                                            const v1::ListTablesRequest* /*request*/,
                                            v1::ListTablesResponse* response) {
  for (const TableCatalog::Entry& entry : catalog_.entries()) *response->add_tables() = WriteSummary(entry);
  const absl::StatusOr<const TableCatalog::Entry*> default_entry = catalog_.Find("");
  if (default_entry.ok()) response->set_default_table((*default_entry)->name);
  return grpc::Status::OK;
}

grpc::Status UncertaintyService::GetTable(grpc::ServerContext* /*context*/,
                                          const v1::GetTableRequest* request,
                                          v1::GetTableResponse* response) {
  const absl::StatusOr<const TableCatalog::Entry*> entry = catalog_.Find(request->table());
  if (!entry.ok()) return ToGrpcStatus(entry.status());
  *response->mutable_table() = WriteTableMessage(**entry);
  return grpc::Status::OK;
}

}  // namespace albtpu::server
