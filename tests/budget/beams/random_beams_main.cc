// albtpu_random_beams COUNT INDEX FILE
//
// Writes random points and the beams to them, for programs in other languages that compute the same bits: columns of
// COUNT little-endian doubles, one after the other, in the order of PointColumns and BeamColumns.
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <limits>
#include <numbers>
#include <random>
#include <span>
#include <vector>

#include "budget/beams/beam_columns.h"

namespace albtpu {
namespace {

using Column = std::vector<double>;

// One point in ten has something extreme.
void DrawPoints(std::span<Column> columns, std::size_t count) {
  std::mt19937_64 random(7);
  const auto draw = [&random](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < count; ++i) {
    double height = draw(30, 1000), depth = draw(-20, 70), direction = draw(0, 2 * std::numbers::pi);
    double distance = height * std::tan(draw(0, 1.2)), convergence = draw(-0.1, 0.1);
    const std::size_t kind = i % 90;
    if (kind == 0) distance = 0;
    if (kind == 10) depth = 0;
    if (kind == 20) depth = draw(0, 1e-9);
    if (kind == 30) height = draw(1e-3, 1);
    if (kind == 40) depth = draw(1e3, 1e6);
    if (kind == 50) depth = -2 * height;
    if (kind == 60) height = -height;
    if (kind == 70) depth = nan;
    if (kind == 80) direction = 0, convergence = -1e-20;
    const double point[] = {distance * std::sin(direction), distance * std::cos(direction), height, depth, convergence};
    for (std::size_t k = 0; k < 5; ++k) columns[k].push_back(point[k]);
  }
}

bool WriteBeams(std::size_t count, double index, const char* path) {
  std::vector<Column> points(5), beams(4, Column(count));
  DrawPoints(points, count);
  ComputeBeams({points[0], points[1], points[2], points[3], points[4]}, index,
               {beams[0], beams[1], beams[2], beams[3]});
  std::ofstream file(path, std::ios::binary);
  const auto write = [&file](const Column& column) {
    file.write(reinterpret_cast<const char*>(column.data()),
               static_cast<std::streamsize>(column.size() * sizeof(double)));
  };
  for (const Column& column : points) write(column);
  for (const Column& column : beams) write(column);
  return static_cast<bool>(file.flush());
}

}  // namespace
}  // namespace albtpu

int main(int argc, char** argv) {
  if (argc != 4) {
    std::cerr << "usage: albtpu_random_beams COUNT INDEX FILE\n";
    return 2;
  }
  return albtpu::WriteBeams(std::strtoull(argv[1], nullptr, 10), std::strtod(argv[2], nullptr), argv[3]) ? 0 : 1;
}
