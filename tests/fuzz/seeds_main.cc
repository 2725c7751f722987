// albtpu_fuzz_seeds FOLDER
//
// Writes FOLDER/TARGET/NUMBER, the inputs with which fuzzing of each target begins. The builders of the tests make
// them, so they follow the formats.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "albtpu/v1/uncertainty_service.pb.h"
#include "service/client/wire.h"
#include "tables/file/seal.h"
#include "tables/file/table_encoder.h"
#include "tables/water/water_schema.h"
#include "tests/formats/las/las_builder.h"
#include "tests/formats/trajectories/flight_text.h"
#include "tests/fuzz/laz/laz_seeds.h"
#include "tests/fuzz/sea/sea_seeds.h"
#include "tests/service/known_seas.h"
#include "tests/tables/synthetic_table.h"

namespace {

using namespace albtpu;

std::vector<std::string> CampaignSeeds() {
  const std::string axes = R"([axes]
wind_speed = [3, 6]
fetch = [1000, inf]
incidence = [0, 20]
azimuth = [0, 90]
footprint = [0.1, 1]
depth = [0, 10]
)";
  return {"id = \"small\"\nversion = \"1\"\ntitle = \"Two seas\"\nseed = 7\n" + axes + "[effort]\nrealizations = 50\n",
          R"(id = "w"
kind = "water_column"
version = "1"
title = "Water"
[axes]
backscatter_fraction = [0.01, 0.03]
scattering_over_absorption = [2, 6]
incidence = [0, 15]
optical_depth = [0.1, 1.5]
field_of_view = [0.1, 3]
pulse_length = [0.01, 0.3]
[effort]
photons = 4000
pairs_per_photon = 2
)",
          "id = \"a\"\nversion = \"1\"\ntitle = \"b\"\n" + axes + R"([beam]
profile = "gaussian"
source_height = 4.0
[water]
refractive_index = 1.34
[sea]
spectrum = "elfouhaily"
corrected_above = 30
[effort]
realizations = 100
most_realizations = 1000
relative_error = 0.02
estimator = "plain"
rays = 1000
[interpolation]
nodes = "balanced"
checked_pulses = 4
)",
          "id = \"s\"\nversion = \"1\"\ntitle = \"t\"\n" + axes + "[sea]\nspreading = 2\n",
          "axes.wind_speed = [1, 2, nan]\naxes.fetch = [-inf, 1e400]\nid = 'x'\n"};
}

std::vector<std::string> CsvSeeds() {
  const std::string header = "wind_speed,fetch,incidence,azimuth,footprint,depth";
  return {header + "\n5,inf,12,40,0.5,8\n6,1e4,0,,0.25,0\n",
          "fetch,incidence,footprint,depth,name\r\n1000,12.5, 0.5 ,8,\"a \"\"b\"\", c\"\r\n\r\n,1,1,1,x\r\n",
          "\xEF\xBB\xBF\"depth\",\"footprint\",incidence\n\"1\",nan,-1e99\n3,0x10,4",
          header + ",note\n1,2,3,4,5,6,\"over\ntwo lines\"\n1,2,3,4,5,6,\n",
          "incidence,depth,beam_azimuth,wind_from,altitude,divergence\n12,8,100,250,400,1.5\n12,8,,250,1e39,-1\n",
          "incidence,depth,altitude,beam_azimuth,wind_from,azimuth\n12,8,400,1,2,3\n",
          "a;b;c\n1;2;3\n",
          "incidence,footprint,depth,thu\n1,2,3,4\n",
          "incidence,footprint,depth\n1,\"2\"x,3\n\"open"};
}

std::vector<std::string> LasSeeds() {
  std::vector<std::string> seeds;
  for (const auto& [version, format] : {std::pair(2, 0), {2, 3}, {3, 4}, {4, 1}, {4, 6}, {4, 10}}) {
    for (const std::size_t extra : {0, 6}) {
      testing::LasSpec spec;
      spec.version_minor = version;
      spec.point_format = format;
      spec.extra_bytes = extra;
      spec.points = {{1, 2, -5000, 26, 12}, {3, 4, 100, 2, -3}, {5, 6, -800, 30, 0}};
      if (extra > 0) {
        const std::string geo_keys("\1\0\1\0\0\0\1\0\x04\x0c\0\0\1\0\x29\x23", 16);  // 3076: metre
        spec.vlrs = {{"LASF_Projection", 34735, geo_keys},
                     {"LASF_Spec", 4, testing::ExtraBytesEntry(4, 0, "echo width")},
                     {"someone", 3, "last"}};
        spec.header_tail = "more";
        spec.gap = "between";
        if (version >= 3) spec.waveform_packet = "samples";
        if (version >= 4) spec.evlrs = {{"someone", 7, "behind"}, {"LASF_Projection", 2112, "UNIT[\"m\",1]"}};
      }
      seeds.push_back(BuildLas(spec));
    }
  }
  testing::LasSpec feet;
  feet.points = {{1, 2, -5000, 26, 12}};
  feet.vlrs = {{"LASF_Projection", 2112, "PROJCS[\"x\",UNIT[\"US survey foot\",0.304800609601219]]"}};
  seeds.push_back(BuildLas(feet));
  return seeds;
}

std::vector<std::string> LasHeadSeeds() {
  std::vector<std::string> seeds = LasSeeds();
  for (std::string& file : fuzz::LazFileSeeds()) seeds.push_back(std::move(file));
  return seeds;
}

std::string Column(const std::vector<float>& numbers) {
  return std::string(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(float));
}

v1::QueryColumnsRequest Request() {
  v1::QueryColumnsRequest request;
  v1::PulseColumns& pulses = *request.mutable_pulses();
  pulses.set_wind_speed(Column({4, 5, 9.5f}));
  pulses.set_fetch(Column({2000, std::numeric_limits<float>::infinity(), 1e4f}));
  pulses.set_incidence(Column({0, 12.5f, 24}));
  pulses.set_azimuth(Column({0, 200, -45}));
  pulses.set_footprint(Column({0.25f}));
  pulses.set_depth(Column({0, 7.5f, 19}));
  return request;
}

std::vector<std::string> ColumnSeeds() {
  std::vector<v1::QueryColumnsRequest> requests(5, Request());
  v1::QueryOptions& options = *requests[1].mutable_options();
  options.set_table("survey");
  options.set_coverage(v1::COVERAGE_P95);
  options.set_standard_errors(true);
  options.set_best_s44_order(true);
  options.set_s44_order(v1::S44_ORDER_1A);
  requests[2].mutable_pulses()->clear_azimuth();
  requests[2].mutable_pulses()->clear_fetch();
  requests[2].add_quantities(v1::QUANTITY_THU);
  requests[3].mutable_options()->set_table("tiny");
  requests[3].mutable_options()->set_coverage(v1::COVERAGE_P95);
  requests[4].mutable_options()->set_table("published");
  requests[4].mutable_pulses()->set_depth(Column({std::numeric_limits<float>::quiet_NaN()}));
  std::vector<std::string> seeds;
  for (const v1::QueryColumnsRequest& request : requests) seeds.push_back(request.SerializeAsString());
  return seeds;
}

std::vector<std::string> BudgetSeeds() {
  v1::QueryBudgetRequest request;
  *request.mutable_pulses() = Request().pulses();
  request.mutable_options()->set_located(v1::SURFACE_LOCATION_LOCAL);
  request.mutable_options()->mutable_errors()->set_scan(0.001);
  request.mutable_options()->mutable_errors()->mutable_position()->set_down(0.05);
  request.mutable_aircraft()->set_altitude(Column({400}));
  request.mutable_aircraft()->set_beam_azimuth(Column({0, 120, 240}));
  std::vector<v1::QueryBudgetRequest> requests(3, request);
  v1::BudgetOptions& options = *requests[1].mutable_options();
  options.set_table("published");
  options.set_coverage(v1::COVERAGE_P95);
  options.set_sea_axis(70);
  options.set_datum(0.08);
  options.mutable_lever_arm()->set_forward(0.3);
  for (int i = v1::BudgetQuantity_MIN + 1; i <= v1::BudgetQuantity_MAX; ++i)
    requests[1].add_quantities(static_cast<v1::BudgetQuantity>(i));
  v1::AircraftColumns& aircraft = *requests[2].mutable_aircraft();
  aircraft.set_roll(Column({-3, 0, 1e7f}));
  aircraft.set_heading_sigma(Column({0.01f, -1, 0}));
  aircraft.set_velocity_north(Column({70}));
  aircraft.set_wave_height(Column({0.25f}));
  std::vector<std::string> seeds;
  for (const v1::QueryBudgetRequest& seed : requests) seeds.push_back(seed.SerializeAsString());
  return seeds;
}

// Two nodes and one value on every axis.
Table SmallWaterTable() {
  Table::Axes axes;
  for (const AxisSchema& axis : kWaterColumn.axes) axes.push_back(*Axis::Create(axis, {0.25, 2}));
  Table::Variables variables;
  for (const QuantitySchema& quantity : kWaterColumn.quantities)
    variables.push_back(
        Variable{.values = std::vector<float>(ValueCount(axes, quantity), 0.5f), .standard_errors = {}});
  Provenance provenance;
  provenance.id = std::string("water");
  provenance.version = std::string("1.0");
  provenance.title = std::string("small");
  return *Table::Create(kWaterColumn, axes, variables, provenance);
}

std::vector<std::string> TableSeeds() {
  std::vector<std::string> seeds;
  for (const UncertaintyTable& table :
       {testing::TinyTable(), testing::TinyTable(Scale::kLog), testing::TinyTable(Scale::kLinear, kOneSea)})
    seeds.push_back(EncodeTable(table).value());
  seeds.push_back(EncodeTable(SmallWaterTable()).value());
  return seeds;
}

// Sealed files with arbitrary content, and files without a valid seal: the seal does not depend on the content.
std::vector<std::string> SealSeeds() {
  using seal::kSize;
  std::vector<std::string> seeds;
  for (const std::string content : {"x", "\x89HDF\r\n\x1a\n and so on"}) {
    std::string file = std::string(kSize, '\0') + content;
    seal::Apply(file);
    seeds.push_back(file);
    seeds.push_back(file.substr(0, kSize / 4));
    file[seal::kVersionOffset] = 2;
    seeds.push_back(file);
    seeds.push_back(content);
  }
  return seeds;
}

// Short flights, so that inputs are: 0.1 s is what the check of velocities needs.
testing::FlightSpec ShortFlight() {
  testing::FlightSpec spec;
  spec.lines = 7;
  spec.decimals = 7;
  return spec;
}

std::vector<std::string> SbetSeeds() {
  std::vector<std::string> seeds;
  testing::FlightSpec spec = ShortFlight();
  seeds.push_back(testing::SbetBytes(spec));
  seeds.push_back(seeds.back().substr(0, 300));
  spec.start = 604799.95;
  spec.change = [](testing::FlightLine& line) { line.time = std::fmod(line.time, 604800); };
  seeds.push_back(testing::SbetBytes(spec));
  spec.change = [](testing::FlightLine& line) { std::swap(line.latitude, line.longitude); };
  seeds.push_back(testing::SbetBytes(spec));
  spec.change = [](testing::FlightLine& line) { line.time = 2 * line.time - 313200; };
  spec.speed = 100;
  seeds.push_back(testing::SbetBytes(spec));
  return seeds;
}

std::vector<std::string> SmrmsgSeeds() {
  return {testing::SmrmsgBytes(100, 1), testing::SmrmsgBytes(313200, 6),
          testing::SmrmsgBytes(604798, 3) + testing::SmrmsgBytes(0, 3),
          testing::SmrmsgBytes(5, 2) + testing::SmrmsgBytes(90, 2), testing::SmrmsgBytes(5, 2).substr(0, 150)};
}

std::vector<std::string> AsciiTrajectorySeeds() {
  std::vector<std::string> seeds;
  testing::FlightSpec spec = ShortFlight();
  seeds.push_back(testing::FlightText(spec));
  spec.separator = ",";
  spec.header = "time,lon,lat,X,Y,Z,roll,pitch,heading,stdX,stdY,stdZ,stdroll,stdpitch,stdheading\n";
  seeds.push_back(testing::FlightText(spec));
  spec = ShortFlight();
  spec.separator = "\t";
  spec.columns = 20;
  spec.header =
      " TIME, DISTANCE, EASTING\n\n(time in Sec, distance in Meters, position in Meters, lat, long in "
      "Degrees, "
      "orientation angles and SD in Degrees, velocity in Meter/Sec, position SD in Meters)\n";
  seeds.push_back(testing::FlightText(spec));
  spec = ShortFlight();
  spec.start = 604799.95;
  spec.change = [](testing::FlightLine& line) { line.time = std::fmod(line.time, 604800); };
  seeds.push_back(testing::FlightText(spec));
  spec.change = [](testing::FlightLine& line) { std::swap(line.latitude, line.longitude); };
  seeds.push_back(testing::FlightText(spec));
  seeds.push_back("1 2 3\n");
  return seeds;
}

std::vector<std::string> WaterLevelSeeds() {
  return {"time,water_level\n2016-05-11T14:00:00Z,-23.02\n2016-05-11T14:06:00Z,-23.05\n2016-05-11 18:00Z,-23\n",
          "time,water_level\n313200,1\n313560.5,1.5\n400000,2\n",
          "\xEF\xBB\xBFstation,\"water_level\", time \r\nA,1,604500\r\n\r\nB,2e0,300\r\n",
          "time,water_level\n2016-12-31T23:59:59.5Z,1\n2017-01-01T00:00:00Z,2\n",
          "time,water_level\n1,x\n",
          "time,level\n"};
}

std::vector<std::string> SeaStateSeeds() {
  std::vector<std::string> seeds;
  for (const KnownSea& sea : testing::SeasOfAllForms()) seeds.push_back(client::ToWire(sea).SerializeAsString());
  return seeds;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "albtpu_fuzz_seeds: no folder; give the folder to write to\n";
    return 2;
  }
  std::map<std::string, std::vector<std::string>> seeds = {{"budget", BudgetSeeds()},
                                                           {"campaign", CampaignSeeds()},
                                                           {"columns", ColumnSeeds()},
                                                           {"csv", CsvSeeds()},
                                                           {"csv_file", CsvSeeds()},
                                                           {"las", LasSeeds()},
                                                           {"las_head", LasHeadSeeds()},
                                                           {"laz_chunk", fuzz::LazChunkSeeds()},
                                                           {"laz_file", fuzz::LazFileSeeds()},
                                                           {"laz_records", fuzz::LazRecordsSeeds()},
                                                           {"sea_state", SeaStateSeeds()},
                                                           {"seal", SealSeeds()},
                                                           {"table", TableSeeds()},
                                                           {"sbet", SbetSeeds()},
                                                           {"smrmsg", SmrmsgSeeds()},
                                                           {"ascii_trajectory", AsciiTrajectorySeeds()},
                                                           {"water_level", WaterLevelSeeds()}};
  seeds.merge(fuzz::SeaSeeds());
  for (const auto& [target, inputs] : seeds) {
    const std::filesystem::path folder = std::filesystem::path(argv[1]) / target;
    std::filesystem::create_directories(folder);
    for (std::size_t i = 0; i < inputs.size(); ++i)
      std::ofstream(folder / std::to_string(i), std::ios::binary) << inputs[i];
  }
  return 0;
}
