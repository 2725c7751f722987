// Arbitrary bytes as the request of QueryColumns are rejected with a reason, or answered as the slow twin answers.
#include <grpcpp/support/proto_buffer_reader.h>

#include <map>
#include <string>
#include <utility>

#include "albtpu/v1/uncertainty_service.pb.h"
#include "service/server/calls/query_rows.h"
#include "service/server/ground/limits.h"
#include "service/server/observe/log.h"
#include "service/server/tables/wire_enums.h"
#include "tables/file/table_io.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/twin.h"
#include "tests/tables/synthetic_table.h"
#include "tests/temporary_folder.h"

namespace {

using namespace albtpu;
using namespace albtpu::server;

// Three tables and their twins, made once. No sea is compiled: sea_state_fuzz.cc is for those.
class Tables {
 public:
  Tables() : catalog_(MakeCatalog()), seas_(metrics_.seas, log_) {
    for (const auto& entry : catalog_.entries()) twins_.try_emplace(entry.get(), entry->table);
  }
  const TableCatalog& catalog() const { return catalog_; }
  AnswerSources Sources() { return AnswerSources(catalog_, seas_); }
  const fuzz::Twin& TwinOf(const TableCatalog::Entry* entry) const { return twins_.at(entry); }

 private:
  static TableCatalog MakeCatalog() {
    const testing::TemporaryFolder folder;
    const auto write = [&](const char* name, const UncertaintyTable& table) {
      ALBTPU_MUST(WriteTable(table, folder / name, Existing::kKeep).ok());
    };
    write("survey.h5", testing::SyntheticTable());
    write("tiny.h5", testing::TinyTable(Scale::kLog));
    write("published.h5", testing::SyntheticTable({.published = true}));
    absl::StatusOr<TableCatalog> catalog = TableCatalog::Load(folder.path(), "survey");
    ALBTPU_MUST(catalog.ok());
    return *std::move(catalog);
  }

  TableCatalog catalog_;
  ServerMetrics metrics_;
  CallLog log_;
  SeaTables seas_;
  std::map<const TableCatalog::Entry*, fuzz::Twin> twins_;
};

template <typename Message>
bool Parse(const grpc::ByteBuffer& bytes, Message& message) {
  grpc::ByteBuffer same = bytes;
  grpc::ProtoBufferReader reader(&same);
  return message.ParseFromZeroCopyStream(&reader);
}

std::span<const float> Floats(const std::string& column) {
  return {reinterpret_cast<const float*>(column.data()), column.size() / sizeof(float)};
}

// A column of an answer: one element for each pulse, or absent.
template <typename Number>
Number* ColumnOf(const std::string& bytes, std::size_t count) {
  if (bytes.empty()) return nullptr;
  ALBTPU_MUST(bytes.size() == count * sizeof(Number));
  return reinterpret_cast<Number*>(const_cast<char*>(bytes.data()));
}

std::array<float*, kQuantityCount> ColumnsOf(const v1::SeaSurfaceColumns& columns, std::size_t count) {
  return {ColumnOf<float>(columns.refraction_along_wind(), count),
          ColumnOf<float>(columns.refraction_cross_wind(), count),
          ColumnOf<float>(columns.thu(), count),
          ColumnOf<float>(columns.tvu(), count),
          ColumnOf<float>(columns.bias_along_beam(), count),
          ColumnOf<float>(columns.bias_vertical(), count)};
}

void CheckRefusal(const grpc::Status& status) {
  ALBTPU_MUST(status.error_code() == grpc::StatusCode::INVALID_ARGUMENT ||
              status.error_code() == grpc::StatusCode::NOT_FOUND);
  ALBTPU_MUST(!status.error_message().empty());
}

void CheckAnswer(const Tables& tables, const v1::QueryColumnsRequest& request,
                 const v1::QueryColumnsResponse& response) {
  const v1::PulseColumns& columns = request.pulses();
  const auto count = static_cast<std::size_t>(response.pulse_count());
  ALBTPU_MUST(count >= 1 && count <= kMaxPulses);
  PulseColumns pulses{.size = count, .axis = {}};
  pulses.axis = {Floats(columns.wind_speed()), Floats(columns.fetch()),     Floats(columns.incidence()),
                 Floats(columns.azimuth()),    Floats(columns.footprint()), Floats(columns.depth())};
  AnswerColumns answers;
  answers.outcomes = ColumnOf<std::uint8_t>(response.outcomes(), count);
  answers.outcome_axes = ColumnOf<std::uint8_t>(response.outcome_axes(), count);
  ALBTPU_MUST(answers.outcomes != nullptr && answers.outcome_axes != nullptr);
  answers.values = ColumnsOf(response.sea_surface(), count);
  answers.standard_errors = ColumnsOf(response.sea_surface_standard_error(), count);
  answers.best_s44_orders = ColumnOf<std::uint8_t>(response.s44().best_orders(), count);
  answers.remaining_thu = ColumnOf<float>(response.s44().remaining_thu(), count);
  answers.remaining_tvu = ColumnOf<float>(response.s44().remaining_tvu(), count);
  const absl::StatusOr<const TableCatalog::Entry*> entry = tables.catalog().Find(request.options().table());
  ALBTPU_MUST(entry.ok() && response.table().digest() == (*entry)->table.digest());
  const absl::StatusOr<Coverage> coverage = FromWire(response.coverage());
  ALBTPU_MUST(coverage.ok());
  const Query query{.coverage = *coverage, .s44_order = {}};
  tables.TwinOf(*entry).MustAgree(query, pulses, answers);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static Tables tables;
  const grpc::Slice bytes(data, size);
  const grpc::ByteBuffer message(&bytes, 1);
  grpc::ByteBuffer answer;
  OutcomeTally tally;
  AnswerSources sources = tables.Sources();
  const grpc::Status status = HandleQueryColumns(sources, message, answer, tally);
  if (sources.wanted()) return 0;
  v1::QueryColumnsRequest request;
  const bool is_request = Parse(message, request);
  ALBTPU_MUST(is_request || !status.ok());
  if (!status.ok()) {
    CheckRefusal(status);
    return 0;
  }
  v1::QueryColumnsResponse response;
  ALBTPU_MUST(Parse(answer, response));
  ALBTPU_MUST(answer.Length() <= kMaxMessageBytes);
  ALBTPU_MUST(tally.pulses() == static_cast<std::size_t>(response.pulse_count()));
  CheckAnswer(tables, request, response);
  return 0;
}
