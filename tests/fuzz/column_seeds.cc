#include <cstring>
#include <limits>

#include "albtpu/v1/uncertainty_service.pb.h"
#include "tests/fuzz/seeds.h"

namespace albtpu::fuzz {
namespace {

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

}  // namespace

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

}  // namespace albtpu::fuzz
