// interpolation_case_files FOLDER MEGABYTES scan|random PULSES
//
// Writes the input of the interpolation benchmarks and the answers of our interpolator, for peers in other languages:
// little-endian single-precision numbers in files named after axes and quantities, such as nodes/wind_speed,
// pulses/wind_speed (a single number where all pulses have the same value), values/thu and answers/thu.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <span>
#include <string>
#include <vector>

#include "tables/query/column_query.h"
#include "tests/bench/interpolation/interpolation_case.h"

namespace albtpu::bench {
namespace {

void Write(const std::filesystem::path& folder, std::string_view name, std::span<const float> numbers) {
  std::filesystem::create_directories(folder);
  std::ofstream file(folder / name, std::ios::binary);
  file.write(reinterpret_cast<const char*>(numbers.data()), static_cast<std::streamsize>(numbers.size_bytes()));
}

void WriteCase(const std::filesystem::path& folder, int megabytes, Order order, std::size_t count) {
  const UncertaintyTable table = TableOf(megabytes);
  const PulseBatch pulses(table, order, count);
  for (AxisId axis : kAxes) {
    const std::vector<double>& nodes = table.axis(axis).nodes();
    Write(folder / "nodes", Describe(axis).name, std::vector<float>(nodes.begin(), nodes.end()));
    Write(folder / "pulses", Describe(axis).name, pulses.columns()[axis]);
  }
  const ColumnInterpolator interpolator(table);
  for (Quantity quantity : {Quantity::kThu, Quantity::kTvu, Quantity::kBiasAlongBeam, Quantity::kBiasVertical}) {
    std::vector<float> answer(count);
    AnswerColumns answers;
    answers.values[Index(quantity)] = answer.data();
    interpolator.Interpolate({}, pulses.columns(), 0, count, answers);
    Write(folder / "values", Describe(quantity).name, table.variable(quantity)->values);
    Write(folder / "answers", Describe(quantity).name, answer);
  }
}

}  // namespace
}  // namespace albtpu::bench

int main(int argc, char** argv) {
  const std::string order = argc == 5 ? argv[3] : "";
  if (order != "scan" && order != "random") {
    std::cerr << "interpolation_case_files: wrong arguments; give FOLDER MEGABYTES scan|random PULSES\n";
    return 2;
  }
  using albtpu::bench::Order;
  albtpu::bench::WriteCase(argv[1], std::atoi(argv[2]), order == "scan" ? Order::kScan : Order::kRandom,
                           std::strtoul(argv[4], nullptr, 10));
}
