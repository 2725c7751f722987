#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string>

#include "config/sensors/sensor.h"
#include "tests/temporary_folder.h"

namespace albtpu::config {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::StartsWith;

// The sensors in a folder are those that are installed while this lives.
class InstalledIn {
 public:
  explicit InstalledIn(const std::filesystem::path& folder) { setenv("ALBTPU_SENSORS", folder.c_str(), 1); }
  ~InstalledIn() { unsetenv("ALBTPU_SENSORS"); }
  InstalledIn(const InstalledIn&) = delete;
  InstalledIn& operator=(const InstalledIn&) = delete;
};

std::string ErrorOfName(const std::string& name) {
  const absl::StatusOr<Sensor> sensor = FindSensor(name);
  EXPECT_FALSE(sensor.ok()) << name;
  return std::string(sensor.status().message());
}

TEST(ShippedSensors, CanAllBeRead) {
  const InstalledIn shipped(SHIPPED_SENSORS);
  const absl::StatusOr<std::vector<Sensor>> sensors = ListSensors();
  ASSERT_TRUE(sensors.ok()) << sensors.status();
  std::vector<std::string> names;
  for (const Sensor& sensor : *sensors) names.push_back(sensor.name);
  EXPECT_GE(names.size(), 14u);
  EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
  for (const char* name : {"riegl-vq-880-g", "riegl-vq-840-g", "leica-chiroptera-4x", "leica-hawkeye-4x-deep",
                           "teledyne-czmil-nova", "fugro-ramms", "usgs-eaarl-b"})
    EXPECT_THAT(names, Contains(name));
}

// A source names what to look up: letters, and more than a word.
TEST(ShippedSensors, HaveASourceForEachNumber) {
  const InstalledIn shipped(SHIPPED_SENSORS);
  const auto names_a_source = ::testing::ContainsRegex("[A-Za-z]+ .*[A-Za-z]");
  const std::vector<Sensor> sensors = ListSensors().value();
  for (const Sensor& sensor : sensors) {
    for (std::size_t i = 0; i < kErrorSourceCount; ++i) {
      if (!sensor.errors.stated[i]) continue;
      EXPECT_THAT(sensor.origins[i], names_a_source) << sensor.name;
    }
    if (sensor.divergence.has_value()) {
      EXPECT_THAT(sensor.divergence->source, names_a_source) << sensor.name;
    }
    if (sensor.surface_channel.has_value()) {
      EXPECT_THAT(sensor.surface_channel->source, names_a_source) << sensor.name;
    }
    EXPECT_LT(UnknownOf(sensor).size(), 10u) << sensor.name << " has no number";
  }
}

// lidar_sensors.json of cBLUE 4.2.
TEST(ShippedSensors, RepeatTheNumbersOfCblue) {
  const InstalledIn shipped(SHIPPED_SENSORS);
  const struct {
    const char* name;
    double scan, range;
  } rows[] = {{"riegl-vq-880-g", 0.02, 0.025},         {"leica-chiroptera-4x", 0.025, 0.020},
              {"leica-chiroptera-5", 0.025, 0.020},    {"leica-hawkeye-4x-deep", 0.025, 0.020},
              {"leica-hawkeye-5-deep", 0.025, 0.020},  {"arete-pills", 0.015, 0.033},
              {"fugro-ramms", 0.015, 0.033},           {"teledyne-czmil", 0.00392, 0.025},
              {"teledyne-czmil-nova", 0.00392, 0.025}, {"teledyne-czmil-supernova", 0.00392, 0.025}};
  for (const auto& row : rows) {
    const Sensor sensor = FindSensor(row.name).value();
    EXPECT_EQ(sensor.errors.values.scan, row.scan) << row.name;
    EXPECT_EQ(sensor.errors.values.bottom_range, row.range) << row.name;
  }
}

TEST(FindSensor, TakesANameOrAPath) {
  const albtpu::testing::TemporaryFolder folder;
  const std::filesystem::path path = folder / "mine.toml";
  std::ofstream(path) << "title = 'Mine'\n";
  {
    const InstalledIn installed(path.parent_path());
    EXPECT_EQ(FindSensor("mine").value().title, "Mine");
    EXPECT_EQ(ErrorOfName("mime"), "'mime' is no sensor; did you mean mine?");
    EXPECT_EQ(ErrorOfName("riegl-vq-880-g"), "'riegl-vq-880-g' is no sensor; there are mine");
    EXPECT_THAT(ErrorOfName("a\nb"), StartsWith("'a?b' is no sensor"));
    EXPECT_THAT(ErrorOfName(""), StartsWith("'' is no sensor"));
    EXPECT_THAT(ErrorOfName("mine.toml"), StartsWith("mine.toml: does not exist"));
  }
  EXPECT_EQ(FindSensor(path.string()).value().name, "mine");
  EXPECT_THAT(ErrorOfName("no/such"), StartsWith("no/such: does not exist"));
}

TEST(FindSensor, SaysWhereItLooked) {
  const albtpu::testing::TemporaryFolder folder;
  const InstalledIn installed(folder / "absent");
  EXPECT_TRUE(ListSensors().value().empty());
  EXPECT_THAT(ErrorOfName("mine"), HasSubstr((folder / "absent").string()));
  EXPECT_THAT(ErrorOfName("mine"), HasSubstr("ALBTPU_SENSORS"));
}

TEST(ListSensors, NamesTheFileThatIsWrong) {
  const albtpu::testing::TemporaryFolder folder;
  const std::filesystem::path path = folder / "mine.toml";
  std::ofstream(path) << "title = 'Mine'\n[scan]\nvalue = 1\nunit = 'degree'\n";
  const InstalledIn installed(path.parent_path());
  EXPECT_EQ(ListSensors().status().message(),
            path.string() + ": line 2: [scan] source is missing; give where the number is from");
}

TEST(SensorsDirectory, IsBesideTheProgramUnlessToldOtherwise) {
  unsetenv("ALBTPU_SENSORS");
  EXPECT_THAT(SensorsDirectory().string(), ::testing::EndsWith("share/albtpu/sensors"));
  const InstalledIn installed("/elsewhere");
  EXPECT_EQ(SensorsDirectory(), "/elsewhere");
}

}  // namespace
}  // namespace albtpu::config
