#include "generator/campaign/unit.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/generator/campaign/two_seas.h"

namespace albtpu {
namespace {

using ::testing::HasSubstr;

const UnitOrigin kOrigin = {"c0ffee", "0.1.0 (1a2b3c4d5e6f)", "x86-64-v3"};
constexpr UnitId kUnit = {UnitKind::kSeaCase, 12};

std::string Sealed() { return SealUnit(kUnit, kOrigin, "what was computed"); }

std::string Refusal(UnitId unit, const UnitOrigin& origin, const std::string& bytes) {
  return std::string(OpenUnit(unit, origin, bytes).status().message());
}

// Expects equal bits, also of zeros and NaN.
void ExpectSame(double a, double b) { EXPECT_EQ(std::bit_cast<std::uint64_t>(a), std::bit_cast<std::uint64_t>(b)); }

void ExpectSame(const Estimate& a, const Estimate& b) {
  ExpectSame(a.value, b.value);
  ExpectSame(a.standard_error, b.standard_error);
}

TEST(Unit, IsNamedByItsKindAndIndex) {
  EXPECT_EQ(Name(kUnit), "encounter-00012");
  EXPECT_EQ(Name({UnitKind::kPulse, 3}), "pulse-00003");
}

TEST(Unit, IsEachSeaCaseAndCheckedPulseOfTheCampaign) {
  const Campaign campaign = TwoSeas();
  const std::vector<UnitId> units = UnitsOf(campaign);
  ASSERT_EQ(units.size(), 8 + campaign.checked_pulses);
  EXPECT_EQ(units[7], (UnitId{UnitKind::kSeaCase, 7}));
  EXPECT_EQ(units[8], (UnitId{UnitKind::kPulse, 0}));
  EXPECT_EQ(units.back(), (UnitId{UnitKind::kPulse, campaign.checked_pulses - 1}));
}

TEST(Unit, OpensToTheSealedContent) {
  const std::string bytes = Sealed();
  const absl::StatusOr<std::string_view> content = OpenUnit(kUnit, kOrigin, bytes);
  EXPECT_EQ(*content, "what was computed");
}

TEST(Unit, IsRefusedWhenAnyByteHasChanged) {
  for (std::size_t i = 0; i < Sealed().size(); ++i) {
    std::string bytes = Sealed();
    bytes[i] ^= 0x10;
    EXPECT_EQ(OpenUnit(kUnit, kOrigin, bytes).status().code(), absl::StatusCode::kDataLoss) << i;
  }
}

TEST(Unit, IsRefusedWhenTruncatedAnywhere) {
  for (std::size_t size = 0; size < Sealed().size(); ++size)
    EXPECT_EQ(OpenUnit(kUnit, kOrigin, Sealed().substr(0, size)).status().code(), absl::StatusCode::kDataLoss);
}

TEST(Unit, IsRefusedWhenItsOriginDiffers) {
  UnitOrigin other = kOrigin;
  other.campaign = "decaf";
  EXPECT_THAT(Refusal(kUnit, other, Sealed()), HasSubstr("another campaign"));
  other = kOrigin;
  other.program = "0.2.0 (1a2b3c4d5e6f)";
  EXPECT_THAT(Refusal(kUnit, other, Sealed()), HasSubstr("0.1.0 (1a2b3c4d5e6f), this is 0.2.0"));
  other = kOrigin;
  other.instruction_set = "x86-64-v4";
  EXPECT_THAT(Refusal(kUnit, other, Sealed()), HasSubstr("set x86-64-v3, this one has x86-64-v4"));
}

TEST(Unit, IsRefusedUnderTheNameOfAnother) {
  EXPECT_THAT(Refusal({UnitKind::kSeaCase, 13}, kOrigin, Sealed()), HasSubstr("holds the unit encounter 12"));
}

TEST(Unit, HasTheOriginOfItsCampaign) {
  Campaign campaign = TwoSeas();
  const UnitOrigin origin = OriginOf(campaign);
  EXPECT_EQ(origin.campaign.size(), 64u);
  EXPECT_EQ(OriginOf(campaign).campaign, origin.campaign);
  campaign.text += "\n";
  EXPECT_NE(OriginOf(campaign).campaign, origin.campaign);
}

TEST(UnitContent, RestoresAResultToTheLastBit) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  SeaCaseResult result;
  result.beams.resize(2);
  result.beams[1].refraction_along_wind = {1.0 / 3, std::numeric_limits<double>::denorm_min()};
  result.beams[1].refraction_cross_wind = {-0.0, std::nan("")};
  result.beams[1].thu = {{std::numbers::pi, 1e-300}, {2, 3}};
  result.beams[1].tvu = {{kInfinity, -kInfinity}};
  result.beams[0].bias_vertical = {{-4, 5}};
  result.realizations = 250;
  result.converged = false;
  result.rays = 10000;
  result.patch_length = 0.1;
  result.resolved_slope_fraction = std::nextafter(1.0, 2.0);

  const absl::StatusOr<SeaCaseResult> read = DecodeResult(EncodeResult(result));
  ASSERT_EQ(read->beams.size(), 2u);
  ExpectSame(read->beams[1].refraction_along_wind, result.beams[1].refraction_along_wind);
  ExpectSame(read->beams[1].refraction_cross_wind, result.beams[1].refraction_cross_wind);
  ASSERT_EQ(read->beams[1].thu.size(), 2u);
  ExpectSame(read->beams[1].thu[0], result.beams[1].thu[0]);
  ExpectSame(read->beams[1].thu[1], result.beams[1].thu[1]);
  ASSERT_EQ(read->beams[1].tvu.size(), 1u);
  ExpectSame(read->beams[1].tvu[0], result.beams[1].tvu[0]);
  ASSERT_EQ(read->beams[0].bias_vertical.size(), 1u);
  ExpectSame(read->beams[0].bias_vertical[0], result.beams[0].bias_vertical[0]);
  EXPECT_EQ(read->realizations, 250);
  EXPECT_FALSE(read->converged);
  EXPECT_EQ(read->rays, 10000);
  ExpectSame(read->patch_length, 0.1);
  ExpectSame(read->resolved_slope_fraction, result.resolved_slope_fraction);
}

TEST(UnitContent, RestoresEstimatesToTheLastBit) {
  const std::vector<Estimate> estimates = {{1.0 / 3, 1e-300}, {-0.0, std::nan("")}};
  const absl::StatusOr<std::vector<Estimate>> read = DecodeEstimates(EncodeEstimates(estimates));
  ASSERT_EQ(read->size(), 2u);
  ExpectSame((*read)[0], estimates[0]);
  ExpectSame((*read)[1], estimates[1]);
}

TEST(UnitContent, IsRefusedWithAnotherLength) {
  SeaCaseResult result;
  result.beams.resize(1);
  result.beams[0].thu.resize(3);
  const std::string bytes = EncodeResult(result);
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_FALSE(DecodeResult(bytes.substr(0, size)).ok()) << size;
  EXPECT_FALSE(DecodeResult(bytes + "more").ok());
}

TEST(ByteStream, RefusesASizeLargerThanTheBytes) {
  ByteWriter writer;
  writer(std::numeric_limits<std::uint64_t>::max(), 1.0);
  const std::string bytes = std::move(writer).Take();
  std::vector<double> list;
  ByteReader lists(bytes);
  lists(list);
  EXPECT_TRUE(list.empty());
  EXPECT_FALSE(lists.ReadAll());
  std::string_view text;
  ByteReader texts(bytes);
  texts(text);
  EXPECT_FALSE(texts.ReadAll());
}

TEST(ByteStream, KeepsTheSignOfIntegers) {
  ByteWriter writer;
  writer(-3, true);
  const std::string bytes = std::move(writer).Take();
  int number = 0;
  bool flag = false;
  ByteReader reader(bytes);
  reader(number, flag);
  EXPECT_EQ(number, -3);
  EXPECT_TRUE(flag);
  EXPECT_TRUE(reader.ReadAll());
}

}  // namespace
}  // namespace albtpu
