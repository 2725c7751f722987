// The client against the real server, in one process.
#include "service/client/server_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <random>

#include "service/client/local_source.h"
#include "service/client/wire.h"
#include "service/server/server.h"
#include "tables/table_io.h"
#include "tests/service/client/temporary_folder.h"
#include "tests/tables/synthetic_table.h"

namespace albtpu::client {
namespace {

using albtpu::testing::SyntheticOptions;
using albtpu::testing::SyntheticTable;
using albtpu::testing::TemporaryFolder;
using ::testing::HasSubstr;

// A server with one table, `quick`.
class RunningServer {
 public:
  explicit RunningServer(const SyntheticOptions& options = {}, const std::string& listen = "127.0.0.1:0") {
    const absl::Status written =
        WriteTable(SyntheticTable(options), folder_ / "quick.h5", Existing::kReplace);
    EXPECT_TRUE(written.ok()) << written;
    catalog_.emplace(server::TableCatalog::Load(folder_ / "", "").value());
    server_ = server::Server::Start(*catalog_, server::ListenAddress::Parse(listen).value()).value();
  }
  const std::string& address() const { return server_->address(); }
  void Stop() { server_->Drain(); }

 private:
  TemporaryFolder folder_;
  std::optional<server::TableCatalog> catalog_;
  std::unique_ptr<server::Server> server_;
};

// Pulses within and without the table, with and without an azimuth, now and then not a number.
std::vector<Pulse> MixedPulses(std::size_t count) {
  std::mt19937 random(1);
  const auto draw = [&](float from, float to) {
    return from + (to - from) * static_cast<float>(random() >> 8) / static_cast<float>(1 << 24);
  };
  std::vector<Pulse> pulses(count);
  for (Pulse& pulse : pulses) {
    pulse.wind_speed = draw(2.5f, 10.5f);
    if (random() % 3 != 0) pulse.fetch = draw(900, 200000);
    pulse.incidence = draw(-1, 27);
    if (random() % 2 != 0) pulse.azimuth = draw(-400, 400);
    pulse.footprint = draw(0.2f, 2.1f);
    pulse.depth = random() % 50 == 0 ? std::numeric_limits<float>::quiet_NaN() : draw(-1, 21);
  }
  return pulses;
}

void ExpectSameBits(const PulseUncertainty& a, const PulseUncertainty& b) {
  EXPECT_EQ(a.outcome, b.outcome);
  EXPECT_EQ(a.axis, b.axis);
  EXPECT_EQ(a.azimuth_absent, b.azimuth_absent);
  if (a.outcome != Outcome::kInterpolated) return;
  EXPECT_EQ(std::memcmp(a.values.data(), b.values.data(), sizeof a.values), 0);
  EXPECT_EQ(std::memcmp(a.standard_errors.data(), b.standard_errors.data(), sizeof a.standard_errors), 0);
  EXPECT_EQ(a.radius_over_thu, b.radius_over_thu);
}

TEST(ServerSource, GivesTheBitsThatATableInThisProcessGives) {
  const RunningServer server;
  const auto remote = ServerSource::Open(server.address(), "", true);
  ASSERT_TRUE(remote.ok()) << remote.status();
  LocalSource local("", SyntheticTable());
  // More than one message of each kind.
  const std::vector<Pulse> pulses = MixedPulses(150000);
  std::vector<PulseUncertainty> remote_answers(pulses.size()), local_answers(pulses.size());
  ASSERT_TRUE((*remote)->Answer(pulses, remote_answers).ok());
  ASSERT_TRUE(local.Answer(pulses, local_answers).ok());
  for (std::size_t i = 0; i < pulses.size() && !::testing::Test::HasFailure(); ++i) {
    SCOPED_TRACE(i);
    ExpectSameBits(remote_answers[i], local_answers[i]);
  }
}

TEST(ServerSource, SendsWhatIsAlikeOnce) {
  const std::vector<Pulse> pulses(
      1000, {.wind_speed = 5, .incidence = 12, .azimuth = 30.0f, .footprint = 1, .depth = 3});
  albtpu::v1::PulseColumns columns;
  ToWire(pulses, columns);
  EXPECT_EQ(columns.wind_speed().size(), 4u);
  EXPECT_EQ(columns.azimuth().size(), 4u);
  EXPECT_EQ(columns.depth().size(), 4000u);

  const RunningServer server;
  const auto source = ServerSource::Open(server.address(), "quick", false).value();
  std::vector<PulseUncertainty> answers(pulses.size());
  ASSERT_TRUE(source->Answer(pulses, answers).ok());
  EXPECT_EQ(answers.back().values, Interpolate(SyntheticTable(), pulses[0]).values);
  EXPECT_TRUE(std::isnan(answers.back().standard_errors[0]));
}

TEST(ServerSource, AsksNothingForNoPulses) {
  const RunningServer server;
  const auto source = ServerSource::Open(server.address(), "", true).value();
  EXPECT_TRUE(source->Answer({}, {}).ok());
}

TEST(ServerSource, KnowsItsTableAsAFileDoes) {
  const RunningServer server;
  const TableSummary remote = ServerSource::Open(server.address(), "", false).value()->table();
  const TableSummary local = Summarize("quick", SyntheticTable());
  EXPECT_EQ(remote.name, local.name);
  EXPECT_EQ(remote.id, local.id);
  EXPECT_EQ(remote.version, local.version);
  EXPECT_EQ(remote.title, local.title);
  EXPECT_EQ(remote.digest, local.digest);
  EXPECT_EQ(remote.attributes, local.attributes);
  for (const AxisId axis : kAxes) {
    EXPECT_EQ(remote.axes[Index(axis)].first, local.axes[Index(axis)].first);
    EXPECT_EQ(remote.axes[Index(axis)].last, local.axes[Index(axis)].last);
    EXPECT_EQ(remote.axes[Index(axis)].nodes, local.axes[Index(axis)].nodes);
  }
  const std::vector<TableSummary> listed = ListServerTables(server.address()).value();
  ASSERT_EQ(listed.size(), 1u);
  EXPECT_TRUE(listed[0].is_default);
}

TEST(ServerSource, SaysWhatIsWrongWithTheServer) {
  RunningServer server;
  const absl::Status unknown = ServerSource::Open(server.address(), "no", false).status();
  EXPECT_EQ(unknown.code(), absl::StatusCode::kNotFound);
  EXPECT_THAT(std::string(unknown.message()), HasSubstr("'no'"));
  EXPECT_THAT(std::string(unknown.message()), HasSubstr("quick"));
  const std::string address = server.address();
  server.Stop();
  const absl::Status gone = ServerSource::Open(address, "", false).status();
  EXPECT_EQ(gone.code(), absl::StatusCode::kUnavailable);
  EXPECT_THAT(std::string(gone.message()), HasSubstr("start albtpu-serve"));
}

TEST(ServerSource, NoticesThatItsTableBecameAnother) {
  auto first = std::make_unique<RunningServer>();
  const std::string address = first->address();
  const auto source = ServerSource::Open(address, "", false).value();
  first->Stop();
  first.reset();
  const RunningServer second({.factor = 2}, address);
  const std::vector<Pulse> pulses = MixedPulses(1);
  std::vector<PulseUncertainty> answers(1);
  absl::Status status;
  // The channel may first have to find out that its connection is gone.
  do status = source->Answer(pulses, answers);
  while (absl::IsUnavailable(status));
  EXPECT_EQ(status.code(), absl::StatusCode::kAborted) << status;
  EXPECT_THAT(std::string(status.message()), HasSubstr("table quick changed from digest"));
}

// An answer for one pulse, as a server should give it.
albtpu::v1::QueryColumnsResponse GoodResponse() {
  albtpu::v1::QueryColumnsResponse response;
  response.set_coverage(albtpu::v1::COVERAGE_TWO_SIGMA);
  response.set_outcomes("\1");
  response.set_outcome_axes(std::string(1, '\0'));
  auto& columns = *response.mutable_sea_surface();
  for (std::string* column :
       {columns.mutable_refraction_along_wind(), columns.mutable_refraction_cross_wind(),
        columns.mutable_thu(), columns.mutable_tvu(), columns.mutable_bias_along_beam(),
        columns.mutable_bias_vertical()}) {
    *column = std::string(4, '\0');
  }
  return response;
}

TEST(Wire, RefusesAnswersThatBreakTheirRules) {
  PulseUncertainty answer;
  const auto read = [&](const albtpu::v1::QueryColumnsResponse& response, bool standard_errors = false) {
    return FromWire(response, standard_errors, {&answer, 1});
  };
  EXPECT_TRUE(read(GoodResponse()).ok());
  EXPECT_FALSE(read(GoodResponse(), true).ok());  // They are not there.
  auto response = GoodResponse();
  response.set_coverage(albtpu::v1::COVERAGE_P95);
  EXPECT_FALSE(read(response).ok());
  response = GoodResponse();
  response.set_outcomes("\1\1");
  EXPECT_FALSE(read(response).ok());
  response = GoodResponse();
  response.set_outcomes("\7");
  EXPECT_FALSE(read(response).ok());
  response = GoodResponse();
  response.mutable_sea_surface()->set_tvu("short");
  EXPECT_FALSE(read(response).ok());
}

}  // namespace
}  // namespace albtpu::client
