// Queries pulses in columns, for `QueryColumns` and each request of `StreamColumns`: the plan of a query, its columns
// and its answers.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "albtpu/v1/pulse.pb.h"
#include "albtpu/v1/uncertainty_service.pb.h"
#include "service/column_message.h"
#include "service/server/calls/sea_request.h"
#include "service/server/observe/metric_collectors.h"
#include "tables/query/column_query.h"
#include "tables/query/pulse_columns.h"

namespace albtpu::server {

// The options of a query, resolved: which table, and what to compute for each pulse.

struct QueryPlan {
  const ServedTable* source = nullptr;
  Query query;
  bool standard_errors = false;
  bool best_s44_order = false;

  bool asks_s44() const { return best_s44_order || query.s44_order.has_value(); }
};

// Fails as documented for `QueryOptions` and `SeaState`. `sea` is null if the request has none. The result refers to
// `sources`.
absl::StatusOr<QueryPlan> PlanQuery(const v1::QueryOptions& options, const v1::SeaState* sea, AnswerSources& sources);

// The same for a QueryPulsesRequest or a QueryColumnsRequest.
template <typename Request>
absl::StatusOr<QueryPlan> PlanQuery(const Request& request, AnswerSources& sources) {
  return PlanQuery(request.options(), request.has_sea() ? &request.sea() : nullptr, sources);
}

// Checks the columns of a request and makes them accessible without copying.

// A column of single-precision numbers in a message of a request.
struct RequestColumn {
  std::string_view message;  // "pulses"
  std::string_view name;
  const std::string* bytes;
  bool required;

  // The bytes of a std::string are aligned for floats, both inside the object, after pointer and size, and on the heap.
  std::span<const float> numbers() const {
    return {reinterpret_cast<const float*>(bytes->data()), bytes->size() / sizeof(float)};
  }
};

// The number of pulses: the length of the longest column. Fails as documented for `QueryColumns`.
absl::StatusOr<std::size_t> CountPulses(std::span<const RequestColumn> columns);

// The columns of the axes of a table of this kind, in the order of kAxes. The result refers to `columns`.
std::array<RequestColumn, kAxisCount> ColumnsOf(const v1::PulseColumns& columns, const TableSchema& schema);

// The numbers of the columns of the axes.
PulseColumns PulsesOf(std::span<const RequestColumn> columns, std::size_t count);

// The columns of a table of this kind. The result refers to the memory of `columns`. Fails as documented for
// `QueryColumns`.
absl::StatusOr<PulseColumns> ReadPulseColumns(const v1::PulseColumns& columns, const TableSchema& schema);

// Adds the fields of a QueryColumnsResponse to `response`, writes the answers directly into it, and counts them in
// `tally`. Fails as documented for `QueryColumns`.
absl::Status QueryColumns(AnswerSources& sources, const v1::QueryColumnsRequest& request, ColumnMessage& response,
                          OutcomeTally& tally);

}  // namespace albtpu::server
