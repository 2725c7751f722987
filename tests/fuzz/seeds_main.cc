// albtpu_fuzz_seeds WRITTEN FOLDER
//
// Writes FOLDER/TARGET/NUMBER, the inputs with which fuzzing of each target begins. Those of foreign formats are the
// files WRITTEN/TARGET/NAME; those of our own are made by the builders of the tests, so they follow the formats.
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iostream>
#include <iterator>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "albtpu/v1/uncertainty_service.pb.h"
#include "service/client/wire.h"
#include "tables/file/seal.h"
#include "tables/file/table_encoder.h"
#include "tables/water/water_schema.h"
#include "tests/service/known_seas.h"
#include "tests/tables/synthetic_table.h"

namespace {

using namespace albtpu;

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

// Two nodes on every axis, and one value: flags, one less than the length, and the numbers of each list.
std::vector<std::string> ValueSeeds(const TableSchema& schema) {
  std::string seed;
  for (std::size_t i = 0; i < schema.axes.size(); ++i) seed += std::string("\0\1", 2) + Column({0.25f, 2});
  for (std::size_t i = 0; i < schema.quantities.size(); ++i) seed += std::string("\4\0", 2) + Column({0.5f});
  return {seed + '\0', seed + '\1'};
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

std::vector<std::string> SeaStateSeeds() {
  std::vector<std::string> seeds;
  for (const KnownSea& sea : testing::SeasOfAllForms()) seeds.push_back(client::ToWire(sea).SerializeAsString());
  return seeds;
}

std::vector<std::string> FilesIn(const std::filesystem::path& folder) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    std::ifstream file(entry.path(), std::ios::binary);
    files.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  return files;
}

std::map<std::string, std::vector<std::string>> AllSeeds(const std::filesystem::path& written) {
  std::map<std::string, std::vector<std::string>> seeds = {{"budget", BudgetSeeds()},
                                                           {"columns", ColumnSeeds()},
                                                           {"sea_state", SeaStateSeeds()},
                                                           {"seal", SealSeeds()},
                                                           {"table", TableSeeds()},
                                                           {"table_values", ValueSeeds(kSeaSurface)},
                                                           {"water_values", ValueSeeds(kWaterColumn)}};
  for (const auto& entry : std::filesystem::directory_iterator(written))
    seeds[entry.path().filename().string()] = FilesIn(entry.path());
  const auto add = [&](const char* target, std::initializer_list<const char*> others) {
    for (const char* const other : others)
      seeds[target].insert(seeds[target].end(), seeds[other].begin(), seeds[other].end());
  };
  add("csv_file", {"csv"});
  add("las_head", {"las", "laz_file"});
  add("sea_text", {"ndbc_bulk", "ndbc_spectra", "sea_csv", "swan_spectra", "ww3_points"});
  return seeds;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "albtpu_fuzz_seeds: no folders; give those to read from and to write to\n";
    return 2;
  }
  for (const auto& [target, inputs] : AllSeeds(argv[1])) {
    const std::filesystem::path folder = std::filesystem::path(argv[2]) / target;
    std::filesystem::create_directories(folder);
    for (std::size_t i = 0; i < inputs.size(); ++i)
      std::ofstream(folder / std::to_string(i), std::ios::binary) << inputs[i];
  }
  return 0;
}
