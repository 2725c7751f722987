// A server on a free port with synthetic tables, and a client of it.
#pragma once

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <cstring>
#include <future>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "albtpu/v1/uncertainty_service.grpc.pb.h"
#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"
#include "service/server/observe/metrics.h"
#include "service/server/server.h"
#include "service/server/tables/table_catalog.h"
#include "tables/file/table_io.h"
#include "tables/query/interpolation.h"
#include "tests/tables/synthetic_table.h"
#include "tests/temporary_folder.h"

namespace albtpu::server {

template <typename Value>
Value OrDie(absl::StatusOr<Value> value) {
  if (!value.ok()) {
    ADD_FAILURE() << value.status();
    std::abort();
  }
  return *std::move(value);
}

inline void WriteOrDie(const UncertaintyTable& table, const std::filesystem::path& path) {
  std::filesystem::create_directories(path.parent_path());
  const absl::Status status = WriteTable(table, path, Existing::kKeep);
  if (!status.ok()) {
    ADD_FAILURE() << status;
    std::abort();
  }
}

inline std::shared_ptr<grpc::Channel> ChannelTo(const std::string& address) {
  grpc::ChannelArguments arguments;
  arguments.SetInt(GRPC_ARG_ENABLE_HTTP_PROXY, 0);  // A proxy from the environment cannot reach our loopback.
  return grpc::CreateCustomChannel(address, grpc::InsecureChannelCredentials(), arguments);
}

inline constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Serves the tables `survey` (synthetic), `published` (without biases and standard errors), `twice/1` and `twice/2`
// (all values times 2 and 3).
class ServedTables : public ::testing::Test {
 protected:
  // `water` is the file of the table of the water column, if the server has one.
  explicit ServedTables(const std::optional<std::filesystem::path>& water = std::nullopt)
      : survey_(testing::SyntheticTable()), published_(testing::SyntheticTable({.published = true})) {
    WriteOrDie(survey_, folder_ / "survey.h5");
    WriteOrDie(published_, folder_ / "published.h5");
    WriteOrDie(testing::SyntheticTable({.version = "first", .factor = 2}), folder_.path() / "twice" / "1.h5");
    WriteOrDie(testing::SyntheticTable({.version = "second", .factor = 3}), folder_.path() / "twice" / "2.h5");
    TableCatalog catalog = OrDie(TableCatalog::Load(folder_.path(), ""));
    if (water.has_value()) {
      EXPECT_TRUE(catalog.AddWater(*water).ok());
    }
    tables_.emplace(std::move(catalog));
    server_ = OrDie(Start("127.0.0.1:0"));
    channel_ = ChannelTo(server_->address());
    stub_ = v1::UncertaintyService::NewStub(channel_);
  }

  absl::StatusOr<std::unique_ptr<Server>> Start(const std::string& address,
                                                std::chrono::seconds max_stream_idle = kMaxStreamIdle) {
    return Server::Start(*tables_, {metrics_.calls, metrics_.access, metrics_.seas, metrics_.waters, log_},
                         OrDie(ListenAddress::Parse(address)), {}, max_stream_idle);
  }

  template <typename Method, typename Request, typename Response>
  grpc::Status Call(Method method, const Request& request, Response& response) {
    grpc::ClientContext context;
    context.set_wait_for_ready(true);
    context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(60));
    return (*stub_.*method)(&context, request, &response);
  }

  // The method that takes a request, and its response.
  static auto MethodOf(const v1::QueryPulsesRequest&) {
    return std::pair(&v1::UncertaintyService::Stub::QueryPulses, v1::QueryPulsesResponse());
  }
  static auto MethodOf(const v1::QueryColumnsRequest&) {
    return std::pair(&v1::UncertaintyService::Stub::QueryColumns, v1::QueryColumnsResponse());
  }
  static auto MethodOf(const v1::QueryBudgetRequest&) {
    return std::pair(&v1::UncertaintyService::Stub::QueryBudget, v1::QueryBudgetResponse());
  }
  static auto MethodOf(const v1::CompileSeaRequest&) {
    return std::pair(&v1::UncertaintyService::Stub::CompileSea, v1::CompileSeaResponse());
  }

  template <typename Request>
  grpc::Status StatusOf(const Request& request) {
    auto [method, response] = MethodOf(request);
    return Call(method, request, response);
  }
  template <typename Request>
  auto Ask(const Request& request) {
    auto [method, response] = MethodOf(request);
    const grpc::Status status = Call(method, request, response);
    EXPECT_TRUE(status.ok()) << status.error_message();
    return response;
  }

  void Reload() {
    std::promise<bool> reloaded;
    tables_->Reload([&](const LiveTables::ReloadResult& result) { reloaded.set_value(result.ok()); });
    EXPECT_TRUE(reloaded.get_future().get());
  }

  grpc::Status ListTables(v1::ListTablesResponse& response) {
    return Call(&v1::UncertaintyService::Stub::ListTables, v1::ListTablesRequest(), response);
  }
  grpc::Status GetTable(const std::string& name, v1::GetTableResponse& response) {
    v1::GetTableRequest request;
    request.set_table(name);
    return Call(&v1::UncertaintyService::Stub::GetTable, request, response);
  }

  testing::TemporaryFolder folder_;
  UncertaintyTable survey_;
  UncertaintyTable published_;
  ServerMetrics metrics_;
  CallLog log_;
  std::optional<LiveTables> tables_;
  std::unique_ptr<Server> server_;
  std::shared_ptr<grpc::Channel> channel_;
  std::unique_ptr<v1::UncertaintyService::Stub> stub_;
};

// A pulse within the domain of the synthetic tables, between their nodes.
inline v1::Pulse WirePulse() {
  v1::Pulse pulse;
  pulse.set_wind_speed(4.5f);
  pulse.set_fetch(5000);
  pulse.set_incidence(12);
  pulse.set_azimuth(40);
  pulse.set_footprint(0.7f);
  pulse.set_depth(3);
  return pulse;
}

inline Pulse TablesPulse() {
  return {.wind_speed = 4.5f, .fetch = 5000, .incidence = 12, .azimuth = 40, .footprint = 0.7f, .depth = 3};
}

inline std::string Column(const std::vector<float>& values) {
  std::string bytes(values.size() * sizeof(float), '\0');
  if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

inline std::vector<int> Bytes(const std::string& column) { return {column.begin(), column.end()}; }

inline std::vector<float> Floats(const std::string& column) {
  std::vector<float> values(column.size() / sizeof(float));
  if (!values.empty()) std::memcpy(values.data(), column.data(), column.size());
  return values;
}

// The first field that the details of an error name; "" if there is none.
inline std::string FieldOf(const grpc::Status& status) {
  google::rpc::Status details;
  google::rpc::BadRequest bad;
  const bool has_field = details.ParseFromString(status.error_details()) && details.details_size() == 1 &&
                         details.details(0).UnpackTo(&bad) && bad.field_violations_size() > 0;
  return has_field ? bad.field_violations(0).field() : "";
}

// The fields that pulses have, in columns.
inline v1::PulseColumns InColumns(const std::vector<v1::Pulse>& pulses) {
  v1::PulseColumns columns;
  for (int f = 0; f < v1::Pulse::descriptor()->field_count(); ++f) {
    const google::protobuf::FieldDescriptor* const field = v1::Pulse::descriptor()->field(f);
    std::vector<float> column;
    for (const v1::Pulse& pulse : pulses)
      if (pulse.GetReflection()->HasField(pulse, field))
        column.push_back(pulse.GetReflection()->GetFloat(pulse, field));
    columns.GetReflection()->SetString(&columns, columns.GetDescriptor()->FindFieldByName(field->name()),
                                       Column(column));
  }
  return columns;
}

// The same pulse as WirePulse(), `count` times.
inline v1::PulseColumns WireColumns(std::size_t count) { return InColumns(std::vector<v1::Pulse>(count, WirePulse())); }

}  // namespace albtpu::server
