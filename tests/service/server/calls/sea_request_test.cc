#include "service/server/calls/sea_request.h"

#include <gmock/gmock.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "service/client/wire.h"
#include "service/server/ground/limits.h"
#include "tests/service/known_seas.h"
#include "tests/service/server/calls/wrong_fields.h"

namespace albtpu::server {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

std::vector<std::string> PathsIn(const v1::SeaState& state) { return WrongFields(ReadSea(state).status()); }

v1::SeaState Described() { return client::ToWire(testing::DescribedWaves()); }
v1::SeaState Measured() { return client::ToWire(testing::MeasuredWaves()); }
v1::SeaState Complete() { return client::ToWire(testing::CompleteSea()); }

TEST(SeaRequest, NamesAWrongNumberOfTheSea) {
  v1::SeaState state;
  state.set_wind_speed(-1);
  state.set_wind_from(kNoNumber);
  state.set_water_depth(0);
  state.set_tail_from(1e6);
  state.set_tail_rule(static_cast<v1::TailRule>(17));
  EXPECT_THAT(PathsIn(state), ElementsAre("wind_speed", "wind_from", "water_depth", "tail_from", "tail_rule"));
}

TEST(SeaRequest, NamesAWrongNumberOfAComponent) {
  v1::SeaState state = Described();
  EXPECT_THAT(PathsIn(state), SizeIs(0));
  v1::WaveComponent& second = *state.mutable_components()->mutable_components(1);
  second.set_significant_wave_height(-0.1);
  second.set_peak_period(0);
  second.set_gamma(kNoNumber);
  second.set_travels_towards(500);
  second.set_spread(2);
  EXPECT_THAT(PathsIn(state),
              ElementsAre("components.components[1].significant_wave_height", "components.components[1].peak_period",
                          "components.components[1].gamma", "components.components[1].travels_towards",
                          "components.components[1].spread"));
}

TEST(SeaRequest, TakesOneToSixteenComponents) {
  v1::SeaState state;
  state.mutable_components();
  EXPECT_THAT(PathsIn(state), ElementsAre("components.components"));
  while (state.components().components_size() <= static_cast<int>(kMaxSeaComponents))
    *state.mutable_components()->add_components() = Described().components().components(0);
  EXPECT_THAT(PathsIn(state), ElementsAre("components.components"));
  state.mutable_components()->mutable_components()->RemoveLast();
  EXPECT_THAT(PathsIn(state), SizeIs(0));
}

TEST(SeaRequest, NamesTheFirstWrongNumberOfAList) {
  const auto paths = [](const std::function<void(v1::FrequencySpectrum&)>& change) {
    v1::SeaState state = Measured();
    change(*state.mutable_frequency_spectrum());
    return PathsIn(state);
  };
  EXPECT_THAT(paths([](auto&) {}), SizeIs(0));
  EXPECT_THAT(paths([](auto& spectrum) { spectrum.set_frequencies(4, kNoNumber); }),
              ElementsAre("frequency_spectrum.frequencies[4]"));
  EXPECT_THAT(paths([](auto& spectrum) { spectrum.set_frequencies(4, spectrum.frequencies(3)); }),
              ElementsAre("frequency_spectrum.frequencies[4]"));
  EXPECT_THAT(paths([](auto& spectrum) {
                spectrum.set_densities(7, -1);
                spectrum.set_densities(9, -1);
              }),
              ElementsAre("frequency_spectrum.densities[7]"));
  EXPECT_THAT(paths([](auto& spectrum) { spectrum.mutable_densities()->RemoveLast(); }),
              ElementsAre("frequency_spectrum.densities"));
  EXPECT_THAT(paths([](auto& spectrum) { spectrum.set_cosines(3, 2 * spectrum.densities(3)); }),
              ElementsAre("frequency_spectrum.cosines[3]"));
  EXPECT_THAT(paths([](auto& spectrum) { spectrum.set_sines(3, kNoNumber); }),
              ElementsAre("frequency_spectrum.cosines[3]"));
  EXPECT_THAT(paths([](auto& spectrum) { spectrum.add_cosines(0); }),
              ElementsAre("frequency_spectrum.cosines", "frequency_spectrum.sines"));
  EXPECT_THAT(paths([](auto& spectrum) { spectrum.clear_sines(); }), ElementsAre("frequency_spectrum.sines"));
  EXPECT_THAT(paths([](auto& spectrum) { spectrum.clear_frequencies(); }),
              ElementsAre("frequency_spectrum.frequencies"));
  EXPECT_THAT(paths([](auto& spectrum) { spectrum.set_record_length(0); }),
              ElementsAre("frequency_spectrum.record_length"));
  EXPECT_THAT(paths([](auto& spectrum) { spectrum.set_trusted_up_to(-1); }),
              ElementsAre("frequency_spectrum.trusted_up_to"));
}

TEST(SeaRequest, TakesUpTo512SamplesOfSixHarmonics) {
  v1::SeaState state;
  v1::FrequencySpectrum& spectrum = *state.mutable_frequency_spectrum();
  for (std::size_t i = 0; i < kMaxSeaSamples; ++i) {
    spectrum.add_frequencies(0.01 + 0.001 * static_cast<double>(i));
    spectrum.add_densities(1e-3);
  }
  const auto set_harmonics = [&](std::size_t harmonics) {
    spectrum.mutable_cosines()->Resize(static_cast<int>(harmonics * kMaxSeaSamples), 0);
    spectrum.mutable_sines()->Resize(static_cast<int>(harmonics * kMaxSeaSamples), 0);
  };
  set_harmonics(6);
  EXPECT_THAT(PathsIn(state), SizeIs(0));
  set_harmonics(7);
  EXPECT_THAT(PathsIn(state), ElementsAre("frequency_spectrum.cosines"));
  spectrum.add_frequencies(50);
  EXPECT_THAT(PathsIn(state), ElementsAre("frequency_spectrum.frequencies"));
}

TEST(SeaRequest, NamesWhatIsWrongInACompleteSpectrum) {
  v1::SeaState state = Complete();
  EXPECT_THAT(PathsIn(state), SizeIs(0));
  state.mutable_wavenumber_spectrum()->set_cosines(2, 1.1);
  EXPECT_THAT(PathsIn(state), ElementsAre("wavenumber_spectrum.cosines[2]"));
  state.mutable_wavenumber_spectrum()->clear_cosines();
  state.mutable_wavenumber_spectrum()->clear_sines();
  EXPECT_THAT(PathsIn(state), ElementsAre("wavenumber_spectrum.cosines"));
}

TEST(SeaRequest, ListsAFewWrongFieldsOfMany) {
  v1::SeaState state;
  for (std::size_t i = 0; i < kMaxSeaComponents; ++i) state.mutable_components()->add_components();
  EXPECT_THAT(PathsIn(state), SizeIs(kMaxSeaViolations));
}

TEST(SeaRequest, HasTheSameKeyHoweverItIsEncoded) {
  const v1::SeaState state = Measured();
  v1::SeaState same;
  // Numbers one by one instead of packed; a field that this server does not know.
  std::string bytes = state.SerializeAsString();
  bytes += std::string("\x98\x06\x01", 3);  // Field 99, 1.
  ASSERT_TRUE(same.ParseFromString(bytes));
  EXPECT_NE(same.SerializeAsString(), state.SerializeAsString());
  EXPECT_EQ(KeyOf(same), KeyOf(state));
  same.set_wind_speed(1);
  EXPECT_NE(KeyOf(same), KeyOf(state));
}

}  // namespace
}  // namespace albtpu::server
