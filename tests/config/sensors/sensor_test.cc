#include "config/sensors/sensor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/temporary_folder.h"

namespace albtpu::config {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr char kWholeSensor[] = R"(title = "Green Scanner 3"
[scan]
value = 0.02
unit = "degree"
source = "its data sheet"
[attitude]
value = [0.0025, 0.0025, 0.005]
unit = "degree"
source = "the manual of its IMU"
[divergence]
value = 1
least = 0.7
greatest = 2
unit = "mrad"
source = "measured"
[surface_channel]
value = "green"
source = "its data sheet"
)";

std::string ErrorOfSensor(const std::string& text) {
  const absl::StatusOr<Sensor> sensor = ParseSensor(text);
  EXPECT_FALSE(sensor.ok()) << text;
  return std::string(sensor.status().message());
}

// The number `key` of a sensor, from line 2 on.
std::string Number(const std::string& key, const std::string& value, const std::string& unit,
                   const std::string& more = "") {
  return "title = \"a\"\n[" + key + "]\nvalue = " + value + "\nunit = \"" + unit + "\"\nsource = \"b\"\n" + more;
}

TEST(Sensor, HasNumbersWithTheirSources) {
  const absl::StatusOr<Sensor> sensor = ParseSensor(kWholeSensor);
  ASSERT_TRUE(sensor.ok()) << sensor.status();
  EXPECT_EQ(sensor->title, "Green Scanner 3");
  EXPECT_EQ(sensor->errors.values.scan, 0.02);
  EXPECT_EQ(sensor->origins[Index(&AirErrors::scan)], "its data sheet");
  EXPECT_THAT(sensor->errors.values.attitude, ElementsAre(0.0025, 0.0025, 0.005));
  EXPECT_EQ(sensor->origins[Index(&AirErrors::attitude)], "the manual of its IMU");
  EXPECT_EQ(sensor->divergence.value().value, 1);
  EXPECT_EQ(sensor->divergence.value().least, 0.7);
  EXPECT_EQ(sensor->divergence.value().greatest, 2);
  EXPECT_EQ(sensor->divergence.value().source, "measured");
  EXPECT_EQ(sensor->surface_channel.value().value, "green");
  EXPECT_EQ(sensor->surface_channel.value().source, "its data sheet");
}

TEST(Sensor, LacksWhatNoSourceGives) {
  const Sensor sensor = ParseSensor(kWholeSensor).value();
  EXPECT_TRUE(sensor.errors.Has(&AirErrors::scan));
  EXPECT_FALSE(sensor.errors.Has(&AirErrors::boresight));
  EXPECT_THAT(UnknownOf(sensor), ElementsAre("position", "boresight", "lever_arm", "time", "range_offset",
                                             "bottom_range", "surface_range"));
  EXPECT_EQ(UnknownOf(ParseSensor("title = 'a'\n").value()).size(), 10u);
}

TEST(Sensor, ReadsEachNumberIntoItsOwnPlace) {
  for (std::size_t i = 0; i < kErrorSourceCount; ++i) {
    const ErrorSource& source = kErrorSources[i];
    const std::string text =
        Number(std::string(source.name), source.size() == 1 ? "0.0625" : "[1, 2, 3.5]", std::string(source.unit));
    if (!source.of_sensor) {
      EXPECT_THAT(ErrorOfSensor(text), HasSubstr("is no key of a sensor file"));
      continue;
    }
    const Sensor sensor = ParseSensor(text).value();
    for (std::size_t k = 0; k < kErrorSourceCount; ++k) EXPECT_EQ(sensor.errors.stated[k], k == i);
    if (source.size() == 1) {
      EXPECT_THAT(source.In(sensor.errors.values), ElementsAre(0.0625)) << source.name;
    } else
      EXPECT_THAT(source.In(sensor.errors.values), ElementsAre(1, 2, 3.5)) << source.name;
  }
}

TEST(Sensor, NeedsTheSourceAndTheUnitOfEachNumber) {
  EXPECT_EQ(ErrorOfSensor("title = 'a'\n[scan]\nvalue = 1\nunit = 'degree'\n"),
            "line 2: [scan] source is missing; give where the number is from");
  EXPECT_EQ(ErrorOfSensor("title = 'a'\n[scan]\nvalue = 1\nsource = 'b'\n"),
            "line 2: [scan] unit is missing; give \"degree\"");
  EXPECT_EQ(ErrorOfSensor("title = 'a'\n[scan]\nunit = 'degree'\nsource = 'b'\n"),
            "line 2: [scan] value is missing; give the number");
  EXPECT_EQ(ErrorOfSensor("[scan]\nvalue = 1\nunit = 'degree'\nsource = 'b'\n"),
            "line 1: title is missing; give what people call the sensor");
  EXPECT_THAT(ErrorOfSensor("title = 'a'\n[attitude]\nvalue = [1, 1, 1]\nunit = 'degree'\n"),
              StartsWith("line 2: [attitude] source is missing"));
  EXPECT_THAT(ErrorOfSensor("title = 'a'\n[divergence]\nvalue = 1\nunit = 'mrad'\n"),
              StartsWith("line 2: [divergence] source is missing"));
  for (const char* blank : {"''", "' '", "5", "true", "['b']"}) {
    EXPECT_THAT(ErrorOfSensor("title = 'a'\n[scan]\nvalue = 1\nunit = 'degree'\nsource = " + std::string(blank) + "\n"),
                StartsWith("line 5: 'scan.source' is "))
        << blank;
  }
}

TEST(Sensor, SaysWhichLaserCanLocateTheSurface) {
  EXPECT_FALSE(ParseSensor("title = 'a'\n")->surface_channel.has_value());
  EXPECT_EQ(ParseSensor("title = 'a'\n[surface_channel]\nvalue = 'infrared'\nsource = 'b'\n")->surface_channel->value,
            "infrared");
  EXPECT_THAT(ErrorOfSensor("title = 'a'\n[surface_channel]\nvalue = 'red'\nsource = 'b'\n"),
              StartsWith("line 3: 'surface_channel.value' is 'red' (expected green, infrared)"));
  EXPECT_EQ(ErrorOfSensor("title = 'a'\n[surface_channel]\nvalue = 'green'\n"),
            "line 2: [surface_channel] source is missing; give where this is from");
  EXPECT_EQ(ErrorOfSensor("title = 'a'\n[surface_channel]\nsource = 'b'\n"),
            "line 2: [surface_channel] value is missing; give \"green\" or \"infrared\"");
}

TEST(Sensor, RefusesEachWrongNumber) {
  const std::vector<std::string> wrong = {"-0.1", "0", "0.0", "nan", "inf", "1e9", "'1'", "true", "[1]", "{}"};
  const std::vector<std::string> wrong_triples = {"1",           "[]",          "[1, 1]",    "[1, 1, 1, 1]",
                                                  "[1, 1, -1]",  "[1, nan, 1]", "[1, 1, 0]", "[inf, 1, 1]",
                                                  "['1', 1, 1]", "[1, 1, 1e9]"};
  for (const ErrorSource& source : kErrorSources) {
    if (!source.of_sensor) continue;
    const std::string key(source.name);
    for (const std::string& value : source.size() == 1 ? wrong : wrong_triples) {
      const std::string error = ErrorOfSensor(Number(key, value, std::string(source.unit)));
      EXPECT_THAT(error, StartsWith("line 3: '" + key + ".value' ")) << value;
      EXPECT_THAT(error, HasSubstr("; ")) << value;
    }
  }
  EXPECT_EQ(ErrorOfSensor(Number("scan", "0", "degree")),
            "line 3: 'scan.value' is 0 (no instrument is exact); leave out a number that no source gives");
}

TEST(Sensor, RefusesAnotherUnit) {
  EXPECT_THAT(ErrorOfSensor(Number("scan", "1", "rad")),
              StartsWith("line 4: 'scan.unit' is 'rad' (expected degree); "));
  EXPECT_THAT(ErrorOfSensor(Number("bottom_range", "1", "cm")), HasSubstr("(expected m)"));
  EXPECT_THAT(ErrorOfSensor(Number("divergence", "1", "degree")), HasSubstr("(expected mrad)"));
  EXPECT_THAT(ErrorOfSensor(Number("time", "1", "ms")), HasSubstr("(expected s)"));
}

// 0.0025 degree is 4.4e-5 rad, 7 mrad 0.007 rad.
TEST(Sensor, RefusesRadians) {
  EXPECT_THAT(ErrorOfSensor(Number("scan", "4.4e-5", "degree")), HasSubstr("looks like radians"));
  EXPECT_THAT(ErrorOfSensor(Number("attitude", "[0.1, 4.4e-5, 0.1]", "degree")), HasSubstr("looks like radians"));
  EXPECT_THAT(ErrorOfSensor(Number("divergence", "0.007", "mrad")), HasSubstr("(expected 0.02 to 100 mrad)"));
  EXPECT_TRUE(ParseSensor(Number("scan", "0.001", "degree")).ok());
  EXPECT_TRUE(ParseSensor(Number("time", "1e-6", "s")).ok());
}

TEST(Sensor, HasTheDivergenceWithinItsLimits) {
  for (const char* limits : {"least = 0.5\n", "greatest = 3\n"})
    EXPECT_THAT(ErrorOfSensor(Number("divergence", "1", "mrad", limits)), HasSubstr("has one of least and greatest"));
  for (const char* limits : {"least = 2\ngreatest = 3\n", "least = 0.1\ngreatest = 0.9\n",
                             "least = 3\ngreatest = 0.5\n", "least = 1\ngreatest = 1\n"})
    EXPECT_THAT(ErrorOfSensor(Number("divergence", "1", "mrad", limits)), HasSubstr("give them in order"));
  EXPECT_TRUE(ParseSensor(Number("divergence", "1", "mrad", "least = 1\ngreatest = 6\n")).ok());
  EXPECT_TRUE(ParseSensor(Number("divergence", "7.5", "mrad")).ok());
}

TEST(Sensor, NamesTheKeyThatIsMeant) {
  EXPECT_EQ(ErrorOfSensor("title = 'a'\n[scann]\nvalue = 1\n"),
            "line 2: 'scann' is no key of a sensor file; did you mean scan?");
  EXPECT_EQ(ErrorOfSensor("title = 'a'\n[scan]\nvalu = 1\nunit = 'degree'\nsource = 'b'\n"),
            "line 3: 'scan.valu' is no key of a sensor file; did you mean value?");
  EXPECT_THAT(ErrorOfSensor(Number("scan", "1", "degree", "least = 0.5\n")),
              StartsWith("line 6: 'scan.least' is no key"));
  EXPECT_THAT(ErrorOfSensor("title = 'a'\nunknown = ['scan']\n"), StartsWith("line 2: 'unknown' is no key"));
  EXPECT_THAT(ErrorOfSensor("title = 'a'\nscan = 0.02\n"), HasSubstr("begin it with [scan]"));
  EXPECT_THAT(ErrorOfSensor("title = 5\n"), StartsWith("line 1: 'title' is 5"));
  EXPECT_THAT(ErrorOfSensor("title = \n"), StartsWith("line 1: is not TOML ("));
  EXPECT_THAT(ErrorOfSensor(std::string(40000, ' ')), HasSubstr("give the TOML that describes the sensor"));
}

TEST(ReadSensor, NamesTheFile) {
  const albtpu::testing::TemporaryFolder folder;
  const std::filesystem::path path = folder / "mine.toml";
  EXPECT_THAT(std::string(ReadSensor(path).status().message()), StartsWith(path.string() + ": does not exist"));
  std::ofstream(path) << "title = 5\n";
  EXPECT_THAT(std::string(ReadSensor(path).status().message()), StartsWith(path.string() + ": line 1: 'title'"));
  std::ofstream(path) << kWholeSensor;
  EXPECT_EQ(ReadSensor(path).value().name, "mine");
  EXPECT_EQ(ReadSensor(path).value().path, path.string());
}

}  // namespace
}  // namespace albtpu::config
