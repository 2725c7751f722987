// albtpu_simulated_flight OUT.las [VERSION_MINOR POINT_FORMAT [EXTRA_BYTES]]
//
// Writes the flight of simulated_flight.h; by default as LAS 1.4 with point format 6.
#include <cstdlib>
#include <fstream>
#include <iostream>

#include "tests/survey/las/simulated_flight.h"

int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "albtpu_simulated_flight: no output; give a file to write\n";
    return 2;
  }
  const int version_minor = argc > 2 ? std::atoi(argv[2]) : 4;
  const int point_format = argc > 3 ? std::atoi(argv[3]) : 6;
  albtpu::testing::LasSpec spec = albtpu::testing::SimulateFlight(version_minor, point_format);
  if (argc > 4) spec.extra_bytes = static_cast<std::size_t>(std::atoi(argv[4]));
  std::ofstream file(argv[1], std::ios::binary);
  file << albtpu::testing::BuildLas(spec) << std::flush;
  if (!file) std::cerr << "albtpu_simulated_flight: " << argv[1] << " cannot be written; give another file\n";
  return file ? 0 : 1;
}
