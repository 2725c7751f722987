// interpolate_random_pulses TABLE.h5 COUNT
//
// Prints COUNT random pulses from the domain of the table and the answers of Interpolate() as CSV with 9 significant
// digits: the six coordinates, the six quantities and their six standard errors. Another program checks them.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>

#include "tables/file/table_io.h"
#include "tables/query/interpolation.h"

namespace albtpu {
namespace {

// Uniform on the scale of the axis, so that every cell of the table is visited.
float RandomCoordinate(const Axis& axis, std::mt19937& random) {
  std::uniform_real_distribution<double> fraction(0, 1);
  const double first = axis.nodes().front(), last = axis.nodes().back(), f = fraction(random);
  return static_cast<float>(axis.scale() == Scale::kLog ? first * std::pow(last / first, f)
                                                        : first + f * (last - first));
}

void PrintHeader() {
  for (AxisId axis : kAxes) std::printf("%s,", Describe(axis).name.data());
  for (Quantity quantity : kQuantities) std::printf("%s,", Describe(quantity).name.data());
  for (Quantity quantity : kQuantities) {
    std::printf("%s%s%c", Describe(quantity).name.data(), kStandardErrorSuffix.data(),
                quantity == kQuantities.back() ? '\n' : ',');
  }
}

void PrintRandomPulse(const UncertaintyTable& table, std::mt19937& random) {
  const auto coordinate = [&](AxisId axis) {
    const float x = RandomCoordinate(table.axis(axis), random);
    std::printf("%.9g,", x);
    return x;
  };
  Pulse pulse;
  pulse.wind_speed = coordinate(AxisId::kWindSpeed);
  pulse.fetch = coordinate(AxisId::kFetch);
  pulse.incidence = coordinate(AxisId::kIncidence);
  pulse.azimuth = coordinate(AxisId::kAzimuth);
  pulse.footprint = coordinate(AxisId::kFootprint);
  pulse.depth = coordinate(AxisId::kDepth);
  const PulseUncertainty result = Interpolate(table, pulse);
  for (float value : result.values) std::printf("%.9g,", value);
  for (std::size_t i = 0; i < kQuantityCount; ++i)
    std::printf("%.9g%c", result.standard_errors[i], i + 1 == kQuantityCount ? '\n' : ',');
}

int Run(const char* path, int count) {
  const absl::StatusOr<UncertaintyTable> table = ReadTable(path);
  if (!table.ok()) {
    std::fprintf(stderr, "interpolate_random_pulses: %s\n", table.status().ToString().c_str());
    return 1;
  }
  std::mt19937 random(1);
  PrintHeader();
  for (int i = 0; i < count; ++i) PrintRandomPulse(*table, random);
  return 0;
}

}  // namespace
}  // namespace albtpu

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "interpolate_random_pulses: bad usage: give TABLE.h5 and COUNT\n");
    return 2;
  }
  return albtpu::Run(argv[1], std::atoi(argv[2]));
}
