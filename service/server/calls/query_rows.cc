#include "service/server/calls/query_rows.h"

#include <grpcpp/support/proto_buffer_reader.h>

#include <array>
#include <cmath>
#include <exception>
#include <limits>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "absl/strings/str_cat.h"
#include "service/column_message.h"
#include "service/seas/sea_summary.h"
#include "service/server/calls/query_budget.h"
#include "service/server/calls/query_columns.h"
#include "service/server/calls/sea_correlation.h"
#include "service/server/ground/errors.h"
#include "service/server/ground/limits.h"
#include "service/server/tables/wire_enums.h"
#include "status/status_macros.h"
#include "tables/file/table_encoder.h"

namespace albtpu::server {
namespace {

// A missing coordinate becomes NaN, which makes the pulse invalid.
constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();

using Rows = google::protobuf::RepeatedPtrField<v1::Pulse>;
using Values = std::array<float, kQuantityCount>;

absl::Status CheckCount(const QueryPlan& plan, const Rows& rows) {
  const auto count = static_cast<std::size_t>(rows.size());
  if (count == 0) return FieldViolation("pulses", "there are no pulses: send at least one");
  const std::size_t limit = plan.standard_errors ? kMaxPulsesWithStandardErrors : kMaxPulses;
  if (count <= limit) return absl::OkStatus();
  return FieldViolation(
      "pulses", absl::StrCat("there are ", count, " pulses: a message takes ", limit,
                             plan.standard_errors ? " with standard errors at most; send several or use QueryColumns"
                                                  : " at most; send several messages"));
}

v1::SeaSurface WriteSeaSurface(const Values& values) {
  using Setter = void (v1::SeaSurface::*)(float);
  constexpr std::array<Setter, kQuantityCount> kSetters = {&v1::SeaSurface::set_refraction_along_wind,
                                                           &v1::SeaSurface::set_refraction_cross_wind,
                                                           &v1::SeaSurface::set_thu,
                                                           &v1::SeaSurface::set_tvu,
                                                           &v1::SeaSurface::set_bias_along_beam,
                                                           &v1::SeaSurface::set_bias_vertical};
  v1::SeaSurface sea_surface;
  for (std::size_t i = 0; i < kQuantityCount; ++i)
    if (!std::isnan(values[i])) (sea_surface.*kSetters[i])(values[i]);
  return sea_surface;
}

// The rows with an azimuth, or those without one, and their answers, copied into columns.
class RowColumns {
 public:
  RowColumns(const QueryPlan& plan, const Rows& rows, bool with_azimuth) : plan_(plan) {
    for (int i = 0; i < rows.size(); ++i)
      if (rows[i].has_azimuth() == with_azimuth) Add(i, rows[i]);
  }

  // Queries the pulses and writes each answer to the place of its row.
  void Query(v1::QueryPulsesResponse& response, OutcomeTally& tally) {
    if (places_.empty()) return;
    PulseColumns pulses{.size = places_.size(), .axis = {}};
    for (std::size_t i = 0; i < kAxisCount; ++i) pulses.axis[i] = axes_[i];
    if (plan_.source->sea) pulses = OnOneSea(pulses);
    InterpolateOnAllCores(plan_.source->interpolator, plan_.query, pulses, AllocateAnswers());
    tally.Add(outcomes_, outcome_axes_);
    for (std::size_t i = 0; i < places_.size(); ++i) Write(i, *response.mutable_uncertainties(places_[i]));
  }

 private:
  void Add(int place, const v1::Pulse& row) {
    places_.push_back(place);
    const auto add = [&](AxisId axis, float value) { axes_[Index(axis)].push_back(value); };
    add(AxisId::kWindSpeed, row.has_wind_speed() ? row.wind_speed() : kMissing);
    add(AxisId::kFetch, row.has_fetch() ? row.fetch() : std::numeric_limits<float>::infinity());
    add(AxisId::kIncidence, row.has_incidence() ? row.incidence() : kMissing);
    if (row.has_azimuth()) add(AxisId::kAzimuth, row.azimuth());
    add(AxisId::kFootprint, row.has_footprint() ? row.footprint() : kMissing);
    add(AxisId::kDepth, row.has_depth() ? row.depth() : kMissing);
  }

  AnswerColumns AllocateAnswers() {
    const std::size_t count = places_.size();
    const auto allocate = [&](auto& column) {
      column.resize(count);
      return column.data();
    };
    AnswerColumns answers;
    answers.outcomes = allocate(outcomes_);
    answers.outcome_axes = allocate(outcome_axes_);
    for (std::size_t q = 0; q < kQuantityCount; ++q) {
      answers.values[q] = allocate(values_[q]);
      if (plan_.standard_errors) answers.standard_errors[q] = allocate(standard_errors_[q]);
    }
    if (plan_.best_s44_order) answers.best_s44_orders = allocate(best_orders_);
    if (plan_.query.s44_order.has_value()) {
      answers.remaining_thu = allocate(remaining_thu_);
      answers.remaining_tvu = allocate(remaining_tvu_);
    }
    return answers;
  }

  void Write(std::size_t i, v1::PulseUncertainty& row) const {
    row.set_outcome(static_cast<v1::Outcome>(outcomes_[i]));
    row.set_axis(static_cast<v1::Axis>(outcome_axes_[i]));
    row.set_azimuth_absent(axes_[Index(AxisId::kAzimuth)].empty());
    if (row.outcome() != v1::OUTCOME_INTERPOLATED) return;
    *row.mutable_sea_surface() = WriteSeaSurface(At(values_, i));
    if (plan_.standard_errors) *row.mutable_sea_surface_standard_error() = WriteSeaSurface(At(standard_errors_, i));
    if (plan_.asks_s44()) WriteS44(i, *row.mutable_s44());
  }

  void WriteS44(std::size_t i, v1::S44& s44) const {
    if (plan_.best_s44_order) s44.set_best_order(static_cast<v1::S44Order>(best_orders_[i]));
    if (!plan_.query.s44_order.has_value()) return;
    if (!std::isnan(remaining_thu_[i])) s44.set_remaining_thu(remaining_thu_[i]);
    if (!std::isnan(remaining_tvu_[i])) s44.set_remaining_tvu(remaining_tvu_[i]);
  }

  using QuantityColumns = std::array<std::vector<float>, kQuantityCount>;

  static Values At(const QuantityColumns& columns, std::size_t i) {
    Values values;
    for (std::size_t q = 0; q < kQuantityCount; ++q) values[q] = columns[q][i];
    return values;
  }

  const QueryPlan& plan_;
  std::vector<int> places_;
  std::array<std::vector<float>, kAxisCount> axes_;
  std::vector<std::uint8_t> outcomes_, outcome_axes_, best_orders_;
  QuantityColumns values_, standard_errors_;
  std::vector<float> remaining_thu_, remaining_tvu_;
};

template <typename Message>
bool Parse(const grpc::ByteBuffer& bytes, Message& message) {
  grpc::ByteBuffer shared = bytes;  // Shares the bytes. The reader requires a buffer that is not const.
  grpc::ProtoBufferReader reader(&shared);
  return reader.status().ok() && message.ParseFromZeroCopyStream(&reader);
}

grpc::ByteBuffer ByteBufferOf(const ColumnMessage& message) { return message.Finish(); }
grpc::ByteBuffer ByteBufferOf(const google::protobuf::Message& message) {
  ColumnMessage bytes;
  bytes.Add(message);
  return ByteBufferOf(bytes);
}

// Calls `query` with the parsed request and the answers that it fills, and writes these to `response`.
template <typename Request, typename Answers, typename Query>
grpc::Status HandleParsed(const grpc::ByteBuffer& bytes, grpc::ByteBuffer& response, Query query) try {
  Request request;
  if (!Parse(bytes, request)) {
    return ToGrpcStatus(absl::InvalidArgumentError(
        absl::StrCat("the message is not a valid ", request.GetTypeName(), " (its bytes do not parse)")));
  }
  Answers answers;
  const absl::Status status = query(request, answers);
  if (status.ok()) response = ByteBufferOf(answers);
  return ToGrpcStatus(status);
} catch (const std::exception& error) {
  return ToGrpcStatus(absl::InternalError(error.what()));
}

}  // namespace

absl::Status QueryRows(AnswerSources& sources, const v1::QueryPulsesRequest& request, v1::QueryPulsesResponse& response,
                       OutcomeTally& tally) {
  ASSIGN_OR_RETURN(const QueryPlan plan, PlanQuery(request, sources));
  RETURN_IF_ERROR(CheckCount(plan, request.pulses()));
  *response.mutable_table() = WriteReference(*plan.source);
  response.set_coverage(ToWire(plan.query.coverage));
  if (plan.source->sea) *response.mutable_sea() = WriteSea(*plan.source->sea);
  response.set_refractive_index(plan.source->refractive_index);
  response.mutable_uncertainties()->Reserve(request.pulses_size());
  for (int i = 0; i < request.pulses_size(); ++i) response.add_uncertainties();
  for (bool with_azimuth : {true, false}) RowColumns(plan, request.pulses(), with_azimuth).Query(response, tally);
  return absl::OkStatus();
}

grpc::Status HandleQueryPulses(AnswerSources& sources, const grpc::ByteBuffer& request, grpc::ByteBuffer& response,
                               OutcomeTally& tally) {
  return HandleParsed<v1::QueryPulsesRequest, v1::QueryPulsesResponse>(
      request, response, [&](const auto& asked, auto& answers) { return QueryRows(sources, asked, answers, tally); });
}

grpc::Status HandleQueryColumns(AnswerSources& sources, const grpc::ByteBuffer& request, grpc::ByteBuffer& response,
                                OutcomeTally& tally) {
  return HandleParsed<v1::QueryColumnsRequest, ColumnMessage>(request, response, [&](const auto& asked, auto& answers) {
    return QueryColumns(sources, asked, answers, tally);
  });
}

grpc::Status HandleQueryBudget(AnswerSources& sources, const grpc::ByteBuffer& request, grpc::ByteBuffer& response,
                               OutcomeTally& tally) {
  return HandleParsed<v1::QueryBudgetRequest, ColumnMessage>(
      request, response, [&](const auto& asked, auto& answers) { return QueryBudget(sources, asked, answers, tally); });
}

grpc::Status HandleListTables(AnswerSources& sources, const grpc::ByteBuffer& request, grpc::ByteBuffer& response,
                              OutcomeTally& /*tally*/) {
  return HandleParsed<v1::ListTablesRequest, v1::ListTablesResponse>(
      request, response, [&](const auto& /*asked*/, auto& answers) {
        for (const auto& entry : sources.catalog().entries()) *answers.add_tables() = WriteSummary(*entry);
        const absl::StatusOr<const TableCatalog::Entry*> default_entry = sources.catalog().Find("");
        if (default_entry.ok()) answers.set_default_table((*default_entry)->name);
        return absl::OkStatus();
      });
}

grpc::Status HandleGetTable(AnswerSources& sources, const grpc::ByteBuffer& request, grpc::ByteBuffer& response,
                            OutcomeTally& /*tally*/) {
  return HandleParsed<v1::GetTableRequest, v1::GetTableResponse>(
      request, response, [&](const auto& asked, auto& answers) {
        const absl::StatusOr<const TableCatalog::Entry*> entry = sources.catalog().Find(asked.table());
        if (entry.ok()) *answers.mutable_table() = WriteTableMessage(**entry);
        return entry.status();
      });
}

grpc::Status HandleCompileSea(AnswerSources& sources, const grpc::ByteBuffer& request, grpc::ByteBuffer& response,
                              OutcomeTally& /*tally*/) {
  return HandleParsed<v1::CompileSeaRequest, v1::CompileSeaResponse>(
      request, response, [&](const auto& asked, auto& answers) { return DescribeSea(sources, asked, answers); });
}

grpc::Status HandleStreamColumns(AnswerSources& sources, const grpc::ByteBuffer& request, grpc::ByteBuffer& response,
                                 OutcomeTally& tally) {
  return HandleParsed<v1::StreamColumnsRequest, ColumnMessage>(
      request, response, [&](const auto& asked, auto& answers) {
        absl::Status status = Within("query", QueryColumns(sources, asked.query(), answers, tally));
        answers.Nest(v1::StreamColumnsResponse::kAnswerFieldNumber, 0);
        return status;
      });
}

absl::Status DescribeSea(AnswerSources& sources, const v1::CompileSeaRequest& request,
                         v1::CompileSeaResponse& response) {
  if (!request.has_sea())
    return FieldViolation("sea", "sea is missing (its table is what is asked for); send a SeaState");
  ASSIGN_OR_RETURN(const double index,
                   ReadIndex(request.has_refractive_index(), request.refractive_index(), "refractive_index"));
  ASSIGN_OR_RETURN(const ServedTable* table, sources.Find(request.sea(), index));
  *response.mutable_table() = WriteTableMessage(*table);
  if (request.has_correlation()) {
    ASSIGN_OR_RETURN(const KnownSea sea, ReadSea(request.sea()));
    absl::StatusOr<v1::SeaCorrelation> correlation = CorrelateSea(sea, request.correlation());
    if (!correlation.ok()) return Within("correlation", correlation.status());
    *response.mutable_correlation() = *std::move(correlation);
  }
  if (!request.with_file()) return absl::OkStatus();
  ASSIGN_OR_RETURN(std::string file, EncodeTable(table->table));
  response.set_file(std::move(file));
  return absl::OkStatus();
}

}  // namespace albtpu::server
