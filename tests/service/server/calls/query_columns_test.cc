#include <gmock/gmock.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "service/server/ground/limits.h"
#include "tests/service/server/served_tables.h"

namespace albtpu::server {
namespace {

using ::testing::Each;
using ::testing::IsEmpty;
using ::testing::SizeIs;

class QueryColumns : public ServedTables {
 protected:
  static v1::QueryColumnsRequest Request(const v1::PulseColumns& pulses, const v1::QueryOptions& options = {}) {
    v1::QueryColumnsRequest request;
    *request.mutable_options() = options;
    *request.mutable_pulses() = pulses;
    return request;
  }
};

// A number in a row and in a column: the same bits, or absent in both.
void ExpectSame(bool present, float row, float column) {
  if (present) {
    EXPECT_EQ(std::bit_cast<std::uint32_t>(row), std::bit_cast<std::uint32_t>(column));
  } else
    EXPECT_TRUE(std::isnan(column));
}

void ExpectSame(const v1::SeaSurface& row, const v1::SeaSurfaceColumns& columns, int i) {
  for (int f = 0; f < row.GetDescriptor()->field_count(); ++f) {
    const google::protobuf::FieldDescriptor* const field = row.GetDescriptor()->field(f);
    ASSERT_EQ(columns.GetDescriptor()->field(f)->name(), field->name());
    ExpectSame(row.GetReflection()->HasField(row, field), row.GetReflection()->GetFloat(row, field),
               Floats(columns.GetReflection()->GetString(columns, columns.GetDescriptor()->field(f)))[i]);
  }
}

void ExpectSame(const v1::QueryPulsesResponse& rows, const v1::QueryColumnsResponse& columns) {
  EXPECT_EQ(rows.table().SerializeAsString(), columns.table().SerializeAsString());
  EXPECT_EQ(rows.coverage(), columns.coverage());
  ASSERT_EQ(rows.uncertainties_size(), columns.pulse_count());
  for (int i = 0; i < rows.uncertainties_size(); ++i) {
    const v1::PulseUncertainty& row = rows.uncertainties(i);
    EXPECT_EQ(row.outcome(), Bytes(columns.outcomes())[i]);
    EXPECT_EQ(row.axis(), Bytes(columns.outcome_axes())[i]);
    EXPECT_EQ(row.azimuth_absent(), columns.azimuth_absent());
    ExpectSame(row.sea_surface(), columns.sea_surface(), i);
    ExpectSame(row.sea_surface_standard_error(), columns.sea_surface_standard_error(), i);
    EXPECT_EQ(row.s44().best_order(), Bytes(columns.s44().best_orders())[i]);
    ExpectSame(row.s44().has_remaining_thu(), row.s44().remaining_thu(), Floats(columns.s44().remaining_thu())[i]);
    ExpectSame(row.s44().has_remaining_tvu(), row.s44().remaining_tvu(), Floats(columns.s44().remaining_tvu())[i]);
  }
}

// Pulses within and around the domain, some of them not finite.
std::vector<v1::Pulse> RandomPulses(std::size_t count, bool with_azimuth) {
  std::mt19937 random(1);
  const auto draw = [&](float from, float to) {
    const unsigned special = random() % 40;
    return special == 0 ? kNaN : special == 1 ? kInfinity : std::uniform_real_distribution<float>(from, to)(random);
  };
  std::vector<v1::Pulse> pulses(count);
  for (v1::Pulse& pulse : pulses) {
    pulse.set_wind_speed(draw(2.8f, 10.2f));
    pulse.set_fetch(draw(900, 2e5));
    pulse.set_incidence(draw(-0.5f, 25.5f));
    if (with_azimuth) pulse.set_azimuth(draw(-360, 720));
    pulse.set_footprint(draw(0.24f, 2.1f));
    pulse.set_depth(draw(-0.3f, 20.3f));
  }
  return pulses;
}

TEST_F(QueryColumns, GivesTheSameBitsAsQueryPulses) {
  for (const char* table : {"survey", "published"}) {
    for (v1::Coverage coverage : {v1::COVERAGE_UNSPECIFIED, v1::COVERAGE_TWO_SIGMA, v1::COVERAGE_P95}) {
      for (bool with_azimuth : {true, false}) {
        v1::QueryOptions options;
        options.set_table(table);
        options.set_coverage(coverage);
        options.set_standard_errors(true);
        options.set_best_s44_order(true);
        options.set_s44_order(v1::S44_ORDER_EXCLUSIVE);
        const std::vector<v1::Pulse> pulses = RandomPulses(500, with_azimuth);
        v1::QueryPulsesRequest request;
        *request.mutable_options() = options;
        request.mutable_pulses()->Add(pulses.begin(), pulses.end());
        ExpectSame(Ask(request), Ask(Request(InColumns(pulses), options)));
      }
    }
  }
}

TEST_F(QueryColumns, AnswersOnlyWhatIsRequested) {
  v1::QueryColumnsRequest request = Request(WireColumns(3));
  request.add_quantities(v1::QUANTITY_TVU);
  request.add_quantities(v1::QUANTITY_THU);
  request.add_quantities(v1::QUANTITY_TVU);
  const v1::QueryColumnsResponse answer = Ask(request);
  EXPECT_THAT(Floats(answer.sea_surface().thu()), SizeIs(3));
  EXPECT_THAT(Floats(answer.sea_surface().tvu()), SizeIs(3));
  EXPECT_THAT(answer.sea_surface().refraction_along_wind(), IsEmpty());
  EXPECT_THAT(answer.sea_surface().bias_vertical(), IsEmpty());
  EXPECT_FALSE(answer.has_sea_surface_standard_error());
  EXPECT_FALSE(answer.has_s44());

  request.mutable_options()->set_standard_errors(true);
  request.mutable_options()->set_best_s44_order(true);
  const v1::QueryColumnsResponse more = Ask(request);
  EXPECT_THAT(Floats(more.sea_surface_standard_error().tvu()), SizeIs(3));
  EXPECT_THAT(more.sea_surface_standard_error().refraction_cross_wind(), IsEmpty());
  EXPECT_THAT(more.s44().best_orders(), SizeIs(3));
  EXPECT_THAT(more.s44().remaining_thu(), IsEmpty());
}

TEST_F(QueryColumns, AcceptsOneNumberForAllPulses) {
  v1::PulseColumns columns = WireColumns(5);
  const std::string expected = Ask(Request(columns)).SerializeAsString();
  columns.set_wind_speed(Column({4.5f}));
  columns.set_fetch(Column({5000}));
  columns.set_azimuth(Column({40}));
  EXPECT_EQ(Ask(Request(columns)).SerializeAsString(), expected);
  EXPECT_EQ(Ask(Request(WireColumns(1))).pulse_count(), 1);
}

TEST_F(QueryColumns, TreatsAnEmptyFetchAsAFullyDevelopedSea) {
  v1::PulseColumns columns = WireColumns(2);
  columns.set_fetch(Column({kInfinity}));
  const std::string expected = Ask(Request(columns)).SerializeAsString();
  columns.clear_fetch();
  EXPECT_EQ(Ask(Request(columns)).SerializeAsString(), expected);
}

// The digest does not cover the index, so that the table that was scaled before the reload has the same one.
TEST_F(QueryColumns, ScalesTheTableThatWasReloadedWithAnotherIndexAlone) {
  constexpr double kAsked = 1.36;  // That of neither table.
  v1::QueryOptions options;
  options.set_table("survey");
  options.set_refractive_index(kAsked);
  const auto answer = [&] { return Ask(Request(WireColumns(1), options)); };
  const v1::QueryColumnsResponse before = answer();
  testing::TableParts parts = testing::PartsOf(survey_);
  parts.provenance.attributes["refractive_index"] = 1.3;
  const UncertaintyTable next = OrDie(parts.Create());
  ASSERT_TRUE(WriteTable(next, folder_ / "survey.h5", Existing::kReplace).ok());
  Reload();
  const v1::QueryColumnsResponse after = answer();
  EXPECT_EQ(after.table().digest(), before.table().digest());
  const auto thu = [&](const UncertaintyTable& table) {
    return Interpolate(AtIndex(table, kAsked), TablesPulse())[Quantity::kThu];
  };
  EXPECT_FLOAT_EQ(Floats(before.sea_surface().thu())[0], thu(survey_));
  EXPECT_FLOAT_EQ(Floats(after.sea_surface().thu())[0], thu(next));
  EXPECT_NE(thu(survey_), thu(next));
}

TEST_F(QueryColumns, KeepsTheLargestAnswerBelowTheDefaultLimitOfClients) {
  v1::QueryOptions options;
  options.set_standard_errors(true);
  options.set_best_s44_order(true);
  options.set_s44_order(v1::S44_ORDER_2);
  v1::PulseColumns columns = WireColumns(kMaxPulses);
  const v1::QueryColumnsResponse answer = Ask(Request(columns, options));
  EXPECT_EQ(answer.pulse_count(), static_cast<int>(kMaxPulses));
  EXPECT_THAT(Bytes(answer.outcomes()), Each(static_cast<int>(v1::OUTCOME_INTERPOLATED)));
  EXPECT_LT(answer.ByteSizeLong(), kMaxMessageBytes);
}

TEST_F(QueryColumns, RejectsAMessageAboveTheSizeLimit) {
  EXPECT_EQ(StatusOf(Request(WireColumns(400000))).error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
}

}  // namespace
}  // namespace albtpu::server
