#include "service/server/calls/water_request.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "service/client/wire.h"
#include "tests/budget/water/known_waters.h"
#include "tests/service/server/calls/wrong_fields.h"

namespace albtpu::server {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

std::vector<std::string> PathsIn(const v1::WaterState& state) { return WrongFields(ReadWater(state).status()); }

v1::WaterState Coastal() { return client::ToWire(testing::CoastalWater()); }

TEST(WaterRequest, ReadsWhatTheClientWrites) {
  for (const KnownWater& water : testing::WatersOfAllKinds()) {
    const v1::WaterState state = client::ToWire(water);
    const absl::StatusOr<KnownWater> read = ReadWater(state);
    ASSERT_TRUE(read.ok()) << read.status();
    EXPECT_EQ(client::ToWire(*read).SerializeAsString(), state.SerializeAsString());
  }
}

TEST(WaterRequest, NamesEachWrongNumber) {
  v1::WaterState state = Coastal();
  EXPECT_THAT(PathsIn(state), SizeIs(0));
  state.set_kd(0);
  state.set_kd_sigma(-1);
  state.set_omega0(1);
  state.set_omega0_sigma(std::numeric_limits<double>::quiet_NaN());
  state.set_backscatter_fraction(0.5);
  state.set_photons(0);
  state.set_temperature(41);
  state.set_salinity(-1);
  state.set_processed_with(2);
  state.set_field_of_view(0);
  state.set_pulse_length(21);
  EXPECT_THAT(PathsIn(state),
              ElementsAre("water.kd", "water.kd_sigma", "water.omega0", "water.omega0_sigma",
                          "water.backscatter_fraction", "water.photons", "water.temperature", "water.salinity",
                          "water.processed_with", "water.field_of_view", "water.pulse_length"));
  state = v1::WaterState();
  state.set_without_column(true);
  EXPECT_THAT(PathsIn(state), SizeIs(0));
  state.set_secchi(81);
  state.set_absorption(11);
  state.set_scattering(0);
  EXPECT_THAT(PathsIn(state), ElementsAre("water.secchi", "water.absorption", "water.scattering"));
}

TEST(WaterRequest, NamesANumberThatIsNoWord) {
  v1::WaterState state = Coastal();
  state.set_kd_kind(static_cast<v1::KdKind>(6));
  state.set_jerlov(static_cast<v1::JerlovType>(11));
  state.set_bias(static_cast<v1::BiasHandling>(-1));
  state.set_detector(static_cast<v1::EchoDetector>(4));
  EXPECT_THAT(PathsIn(state), ElementsAre("water.kd_kind", "water.jerlov", "water.bias", "water.detector"));
}

TEST(WaterRequest, NamesWhatIsMissing) {
  v1::WaterState state;
  state.set_secchi(5);
  EXPECT_THAT(PathsIn(state), ElementsAre("water.bias", "water.detector", "water.field_of_view", "water.pulse_length"));
  state.set_without_column(true);
  EXPECT_THAT(PathsIn(state), SizeIs(0));
  state.set_green_surface(true);
  EXPECT_THAT(PathsIn(state), ElementsAre("water.detector", "water.pulse_length"));
  state = Coastal();
  state.set_temperature(10);
  EXPECT_THAT(PathsIn(state), ElementsAre("water.salinity"));
  state.clear_temperature();
  state.set_salinity(10);
  EXPECT_THAT(PathsIn(state), ElementsAre("water.temperature"));
  state.clear_salinity();
  state.set_processed_with(1.33);
  EXPECT_THAT(PathsIn(state), ElementsAre("water.processed_with"));
}

TEST(WaterRequest, NamesWhatContradictsItself) {
  v1::WaterState state = Coastal();
  state.set_residual_fraction(0.1);
  EXPECT_THAT(PathsIn(state), ElementsAre("water.residual_fraction"));
  state.set_bias(v1::BIAS_HANDLING_VENDOR);
  EXPECT_THAT(PathsIn(state), SizeIs(0));
  state.set_bias(v1::BIAS_HANDLING_CALIBRATED);
  EXPECT_THAT(PathsIn(state), ElementsAre("water.residual_fraction", "water.calibration"));
  state.clear_residual_fraction();
  state.mutable_calibration()->set_depth(5);
  EXPECT_THAT(PathsIn(state), SizeIs(0));
  state.mutable_calibration()->set_offset(11);
  EXPECT_THAT(PathsIn(state), ElementsAre("water.calibration.offset"));
  state = Coastal();
  state.set_without_column(true);
  EXPECT_THAT(PathsIn(state), ElementsAre("water.bias"));
  state.clear_bias();
  EXPECT_THAT(PathsIn(state), SizeIs(0));  // The receiver may be described.
  state.set_residual_fraction(0.1);
  state.mutable_calibration();
  state.set_photons(100);
  EXPECT_THAT(PathsIn(state), ElementsAre("water.residual_fraction", "water.calibration", "water.photons"));
  EXPECT_THAT(ReadWater(state).status().message(), HasSubstr("has no effect with water.without_column"));
  state = Coastal();
  state.set_detector(v1::ECHO_DETECTOR_CENTROID);
  state.set_green_surface(true);
  EXPECT_THAT(PathsIn(state), ElementsAre("water.green_surface"));
}

TEST(WaterRequest, NamesOpticsThatContradictEachOtherAlsoWhereNoneAreNeeded) {
  v1::WaterState state;
  state.set_without_column(true);
  state.set_secchi(6);
  EXPECT_TRUE(ReadWater(state).ok());
  state.set_jerlov(v1::JERLOV_TYPE_II);
  EXPECT_THAT(PathsIn(state), ElementsAre("water"));
}

TEST(WaterRequest, NamesOpticsThatCannotBe) {
  v1::WaterState state = Coastal();
  state.set_secchi(5);
  EXPECT_THAT(PathsIn(state), ElementsAre("water"));
  state = Coastal();
  state.clear_kd();
  state.clear_kd_kind();
  EXPECT_THAT(PathsIn(state), ElementsAre("water"));
  state.set_secchi(25);
  state.set_omega0(0.98);
  EXPECT_THAT(PathsIn(state), ElementsAre("water.omega0"));
}

TEST(WaterRequest, HasOneKeyForEqualWaters) {
  std::vector<Sha256Digest> keys;
  for (const KnownWater& water : testing::WatersOfAllKinds()) keys.push_back(KeyOf(client::ToWire(water), "table"));
  v1::WaterState state = Coastal();
  state.GetReflection()->MutableUnknownFields(&state)->AddVarint(1000, 1);  // Of a newer client.
  EXPECT_EQ(KeyOf(state, "table"), KeyOf(Coastal(), "table"));
  EXPECT_NE(KeyOf(state, "another"), KeyOf(Coastal(), "table"));
  std::sort(keys.begin(), keys.end());
  EXPECT_EQ(std::unique(keys.begin(), keys.end()), keys.end());
}

}  // namespace
}  // namespace albtpu::server
