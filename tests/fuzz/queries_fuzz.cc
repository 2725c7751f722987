// Arbitrary bytes as the request of a query are rejected with a reason, or answered: QueryColumns as the slow twin
// answers, QueryBudget with a number for each pulse that has the outcome INTERPOLATED, and with none for any other.
// No sea is compiled: sea_state_fuzz.cc is for those.
#include <google/protobuf/stubs/logging.h>
#include <grpcpp/support/proto_buffer_reader.h>

#include <cmath>
#include <cstring>
#include <map>
#include <string>

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

namespace albtpu::fuzz {
namespace {

using namespace albtpu::server;

// Three tables and their twins.
class Tables {
 public:
  Tables() : catalog_(MakeCatalog()), seas_(metrics_.seas, log_) {
    google::protobuf::SetLogHandler(nullptr);  // Of each input that is no message.
    for (const auto& entry : catalog_.entries()) twins_.try_emplace(entry.get(), entry->table);
  }
  const TableCatalog& catalog() const { return catalog_; }
  AnswerSources Sources() { return AnswerSources(catalog_, seas_, &waters_); }
  const Twin& TwinOf(const TableCatalog::Entry* entry) const { return twins_.at(entry); }

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
  WaterShares waters_{metrics_.waters, log_};
  std::map<const TableCatalog::Entry*, Twin> twins_;
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

void CheckAnswer(const Tables& tables, const v1::QueryColumnsRequest& request,
                 const v1::QueryColumnsResponse& response) {
  const v1::PulseColumns& columns = request.pulses();
  const auto count = static_cast<std::size_t>(response.pulse_count());
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

void CheckAnswer(const Tables&, const v1::QueryBudgetRequest&, const v1::QueryBudgetResponse& response) {
  const auto count = static_cast<std::size_t>(response.pulse_count());
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

template <typename Request, typename Response, auto kHandle>
void QueryTarget(std::string_view input) {
  static Tables tables;
  const grpc::Slice bytes(input.data(), input.size());
  const grpc::ByteBuffer message(&bytes, 1);
  grpc::ByteBuffer answer;
  OutcomeTally tally;
  AnswerSources sources = tables.Sources();
  const grpc::Status status = kHandle(sources, message, answer, tally);
  if (sources.wanted()) return;
  Request request;
  const bool is_request = Parse(message, request);
  ALBTPU_MUST(is_request || !status.ok());
  if (!status.ok()) {
    ALBTPU_MUST(status.error_code() == grpc::StatusCode::INVALID_ARGUMENT ||
                status.error_code() == grpc::StatusCode::NOT_FOUND);
    ALBTPU_MUST(!status.error_message().empty());
    return;
  }
  Response response;
  ALBTPU_MUST(Parse(answer, response));
  ALBTPU_MUST(answer.Length() <= kMaxMessageBytes);
  const auto count = static_cast<std::size_t>(response.pulse_count());
  ALBTPU_MUST(count >= 1 && count <= kMaxPulses && tally.pulses() == count);
  CheckAnswer(tables, request, response);
}

// Bytes of a column: usually more than the interpolator processes in one vector, sometimes more than one of its blocks.
constexpr std::size_t kUsualBytes = 96, kMostBytes = 2048;

void MutateColumn(Random& random, std::string& column) {
  switch (random() % 4) {
    case 0:  // Arbitrary bytes.
      column.resize(std::max(column.size(), kUsualBytes));
      column = MutateBytes(column.substr(0, column.size() / 2), column.size());
      return;
    case 1:  // Another length.
      column.resize(random() % 64 == 0 ? random() % kMostBytes
                                       : sizeof(float) * (random() % (kUsualBytes / sizeof(float))));
      return;
    default: {  // A notable value.
      if (column.size() < sizeof(float)) column.resize(sizeof(float));
      const std::size_t at = random() % (column.size() / sizeof(float)) * sizeof(float);
      const float number = NotableNumber<float>(random);
      std::memcpy(column.data() + at, &number, sizeof number);
    }
  }
}

std::string* AnyColumn(Random& random, v1::PulseColumns& pulses) {
  std::string* const columns[] = {pulses.mutable_wind_speed(), pulses.mutable_fetch(),     pulses.mutable_incidence(),
                                  pulses.mutable_azimuth(),    pulses.mutable_footprint(), pulses.mutable_depth()};
  return AnyOf(columns, random);
}

void MutateOptions(Random& random, v1::QueryColumnsRequest& request) {
  constexpr const char* kTables[] = {"", "survey", "tiny", "published", "survey/1", "absent", "/", "../tiny"};
  v1::QueryOptions& options = *request.mutable_options();
  switch (random() % 6) {
    case 0:
      return options.set_table(AnyOf(kTables, random));
    case 1:
      return options.set_coverage(static_cast<v1::Coverage>(random() % 5));
    case 2:
      return options.set_standard_errors(random() % 2 == 0);
    case 3:
      return options.set_best_s44_order(random() % 2 == 0);
    case 4:
      return options.set_s44_order(static_cast<v1::S44Order>(random() % 8));
    default:
      if (random() % 3 == 0) return request.clear_quantities();
      request.add_quantities(static_cast<v1::Quantity>(random() % 8));
  }
}

// Field by field, so that most requests stay valid messages.
std::string MutateColumns(std::string_view input, std::size_t, Random& random) {
  v1::QueryColumnsRequest request;
  const bool is_request = request.ParseFromArray(input.data(), static_cast<int>(input.size()));
  if (!is_request || random() % 8 == 0) return "";
  if (random() % 4 == 0)
    MutateOptions(random, request);
  else
    MutateColumn(random, *AnyColumn(random, *request.mutable_pulses()));
  return request.SerializeAsString();
}

}  // namespace

const std::vector<Target> kTargets = {
    {"budget", QueryTarget<v1::QueryBudgetRequest, v1::QueryBudgetResponse, HandleQueryBudget>},
    {"columns", QueryTarget<v1::QueryColumnsRequest, v1::QueryColumnsResponse, HandleQueryColumns>, MutateColumns}};

}  // namespace albtpu::fuzz
