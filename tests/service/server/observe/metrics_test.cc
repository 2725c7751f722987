#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <prometheus/metric_family.h>

#include <map>
#include <set>

#include "service/server/observe/metrics_endpoint.h"
#include "service/server/observe/table_metrics.h"
#include "tests/service/server/served_tables.h"

namespace albtpu::server {
namespace {

using ::testing::HasSubstr;

const prometheus::MetricFamily& Family(const std::vector<prometheus::MetricFamily>& families,
                                       const std::string& name) {
  for (const prometheus::MetricFamily& family : families) {
    if (family.name == name) return family;
  }
  ADD_FAILURE() << "no metric " << name;
  std::abort();
}

// The metric with all of these labels.
prometheus::ClientMetric Metric(const prometheus::Collectable& source, const std::string& name,
                                const std::map<std::string, std::string>& labels) {
  const std::vector<prometheus::MetricFamily> families = source.Collect();
  for (const prometheus::ClientMetric& metric : Family(families, name).metric) {
    std::map<std::string, std::string> found;
    for (const auto& label : metric.label) found[label.name] = label.value;
    if (std::includes(found.begin(), found.end(), labels.begin(), labels.end())) return metric;
  }
  return {};
}

class Metrics : public ServedTables {
 protected:
  double Count(const std::string& name, const std::map<std::string, std::string>& labels) {
    return Metric(*metrics_.registry, name, labels).counter.value;
  }
  double Pulses(const std::string& outcome, const std::string& axis) {
    return Count("albtpu_pulses_total", {{"outcome", outcome}, {"axis", axis}});
  }
};

TEST_F(Metrics, CountPulsesByOutcomeAndAxis) {
  v1::QueryColumnsRequest columns;
  *columns.mutable_pulses() = WireColumns(5);
  columns.mutable_pulses()->set_depth(Column({1, 2, -1, NAN, 3000}));
  columns.mutable_pulses()->set_wind_speed(Column({5, 5, 5, 5, INFINITY}));
  v1::QueryColumnsResponse column_answers;
  ASSERT_TRUE(QueryColumns(columns, column_answers).ok());

  v1::QueryPulsesRequest rows;
  *rows.add_pulses() = WirePulse();
  *rows.add_pulses() = WirePulse();
  rows.mutable_pulses(0)->clear_azimuth();
  rows.mutable_pulses(1)->set_incidence(89);
  v1::QueryPulsesResponse row_answers;
  ASSERT_TRUE(QueryPulses(rows, row_answers).ok());

  EXPECT_EQ(Pulses("INTERPOLATED", ""), 3);
  EXPECT_EQ(Pulses("OUT_OF_DOMAIN", "depth"), 1);
  EXPECT_EQ(Pulses("OUT_OF_DOMAIN", "incidence"), 1);
  EXPECT_EQ(Pulses("INVALID", "depth"), 1);
  EXPECT_EQ(Pulses("INVALID", "wind_speed"), 1);
  EXPECT_EQ(Pulses("INVALID", "fetch"), 0);
}

TEST_F(Metrics, CountCallsByMethodAndCode) {
  v1::QueryPulsesRequest request;
  v1::QueryPulsesResponse response;
  *request.add_pulses() = WirePulse();
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(QueryPulses(request, response).ok());
  request.mutable_options()->set_table("nowhere");
  EXPECT_FALSE(QueryPulses(request, response).ok());
  v1::ListTablesResponse tables;
  ASSERT_TRUE(ListTables(tables).ok());

  const auto calls = [&](const char* method, const char* code) {
    return Count("albtpu_calls_total", {{"method", method}, {"code", code}});
  };
  EXPECT_EQ(calls("QueryPulses", "OK"), 3);
  EXPECT_EQ(calls("QueryPulses", "NOT_FOUND"), 1);
  EXPECT_EQ(calls("ListTables", "OK"), 1);
  EXPECT_EQ(calls("GetTable", "OK"), 0);
  EXPECT_EQ(Metric(*metrics_.registry, "albtpu_calls_under_way", {{"method", "QueryPulses"}}).gauge.value, 0);
}

// Prometheus sees no increase in a counter that appears at 1.
TEST_F(Metrics, StartTheCountersOfFaultsAtZero) {
  std::set<std::string> present;
  const std::vector<prometheus::MetricFamily> families = metrics_.registry->Collect();
  for (const prometheus::ClientMetric& metric : Family(families, "albtpu_calls_total").metric) {
    EXPECT_EQ(metric.counter.value, 0);
    std::map<std::string, std::string> labels;
    for (const auto& label : metric.label) labels[label.name] = label.value;
    present.insert(labels["method"] + " " + labels["code"]);
  }
  for (const std::string method : kMethodNames) {
    for (const char* code : {" INTERNAL", " UNKNOWN", " DATA_LOSS", " RESOURCE_EXHAUSTED"}) {
      EXPECT_EQ(present.count(method + code), 1u) << method << code;
    }
  }
}

TEST_F(Metrics, MeasureTheLengthAndTimeOfAnswers) {
  v1::QueryColumnsRequest request;
  v1::QueryColumnsResponse response;
  for (std::size_t count : {1, 100, 20000}) {
    *request.mutable_pulses() = WireColumns(count);
    ASSERT_TRUE(QueryColumns(request, response).ok());
  }
  const std::map<std::string, std::string> labels = {{"method", "QueryColumns"}};
  const auto pulses = Metric(*metrics_.registry, "albtpu_answer_pulses", labels).histogram;
  EXPECT_EQ(pulses.sample_count, 3u);
  EXPECT_EQ(pulses.sample_sum, 20101);
  EXPECT_EQ(pulses.bucket.front().cumulative_count, 1u);
  const auto seconds = Metric(*metrics_.registry, "albtpu_answer_seconds", labels).histogram;
  EXPECT_EQ(seconds.sample_count, 3u);
  EXPECT_GT(seconds.sample_sum, 0);
}

TEST_F(Metrics, CountEachAnswerOfAStreamAndTheCallOnce) {
  grpc::ClientContext context;
  const auto stream = stub_->StreamColumns(&context);
  v1::StreamColumnsRequest request;
  v1::StreamColumnsResponse response;
  *request.mutable_query()->mutable_pulses() = WireColumns(7);
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(stream->Write(request) && stream->Read(&response));
  EXPECT_EQ(Metric(*metrics_.registry, "albtpu_calls_under_way", {{"method", "StreamColumns"}}).gauge.value,
            1);
  stream->WritesDone();
  ASSERT_TRUE(stream->Finish().ok());
  EXPECT_EQ(Pulses("INTERPOLATED", ""), 28);
  EXPECT_EQ(Count("albtpu_calls_total", {{"method", "StreamColumns"}, {"code", "OK"}}), 1);
  EXPECT_EQ(Metric(*metrics_.registry, "albtpu_answer_pulses", {{"method", "StreamColumns"}})
                .histogram.sample_count,
            4u);
}

TEST_F(Metrics, NameTheTablesInUse) {
  const TableMetrics tables(*tables_);
  const auto info = Metric(tables, "albtpu_table_info", {{"name", "survey"}, {"digest", survey_.digest()}});
  EXPECT_EQ(info.gauge.value, 1);
  EXPECT_EQ(tables.Collect().front().metric.size(), 4u);
  EXPECT_EQ(Metric(tables, "albtpu_table_info", {{"name", "survey"}, {"default", "true"}}).gauge.value, 1);
}

TEST(ReloadMetrics, CountResultsAndKeepTheLast) {
  prometheus::Registry registry;
  ReloadMetrics metrics(registry);
  const auto last = [&] { return Metric(registry, "albtpu_last_reload_successful", {}).gauge.value; };
  const auto count = [&](const char* result) {
    return Metric(registry, "albtpu_reloads_total", {{"result", result}}).counter.value;
  };
  using Changes = std::vector<TableCatalog::Change>;
  EXPECT_EQ(last(), 1);
  metrics.Count(absl::DataLossError("truncated"));
  EXPECT_EQ(last(), 0);
  metrics.Count(Changes{{"a", TableCatalog::Change::Kind::kKept}});
  metrics.Count(
      Changes{{"a", TableCatalog::Change::Kind::kKept}, {"b", TableCatalog::Change::Kind::kRemoved}});
  EXPECT_EQ(last(), 1);
  EXPECT_EQ(count("refused"), 1);
  EXPECT_EQ(count("unchanged"), 1);
  EXPECT_EQ(count("loaded"), 1);
}

TEST(ProcessMetrics, DescribeThisProcess) {
  const ProcessMetrics process;
  const std::vector<prometheus::MetricFamily> families = process.Collect();
  EXPECT_GT(Family(families, "process_resident_memory_bytes").metric[0].gauge.value, 1e6);
  EXPECT_GT(Family(families, "process_virtual_memory_bytes").metric[0].gauge.value, 1e6);
  EXPECT_GE(Family(families, "process_cpu_seconds_total").metric[0].counter.value, 0);
  EXPECT_GE(Family(families, "process_open_fds").metric[0].gauge.value, 3);
  EXPECT_GE(Family(families, "process_max_fds").metric[0].gauge.value, 3);
  EXPECT_NEAR(Family(families, "process_start_time_seconds").metric[0].gauge.value,
              static_cast<double>(std::time(nullptr)), 60);
}

TEST(MetricsEndpoint, ReportsWhyItCannotListen) {
  const auto first = MetricsEndpoint::Start(OrDie(ListenAddress::Parse("127.0.0.1:0")), {});
  ASSERT_TRUE(first.ok()) << first.status();
  const auto second = MetricsEndpoint::Start(OrDie(ListenAddress::Parse((*first)->address())), {});
  EXPECT_EQ(second.status().code(), absl::StatusCode::kUnavailable);
  EXPECT_THAT(std::string(second.status().message()), HasSubstr("Address already in use"));
}

}  // namespace
}  // namespace albtpu::server
