// beam_case_surface SIZE INCIDENCE FOLDER
//
// Writes the case of the benchmarks with SIZE points and INCIDENCE degrees into FOLDER, for peers in other languages:
// power.f64 (of the modes, SIZE x (SIZE / 2 + 1)), heights.f32 (of one surface of SIZE - 1 points along a side about
// the centre of the beam), rays.f64 (where they cross z = 0). Prints a JSON object: points, spacing, the direction of
// the rays, the refractive index, depths, and the centroid and path at each depth by the scalar walk.
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "generator/math/fft.h"
#include "sea/response/closed_form.h"
#include "tests/bench/monte_carlo/beam_case.h"

namespace {

template <typename T>
bool Write(const std::vector<T>& values, const std::string& path) {
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(values.size() * sizeof(T)));
  return file.good();
}

}  // namespace

int main(int argc, char** argv) {
  using namespace albtpu;
  if (argc != 4) {
    std::cerr << "usage: beam_case_surface SIZE INCIDENCE FOLDER\n";
    return 2;
  }
  const int size = std::atoi(argv[1]);
  const std::string folder = argv[3];
  const bench::BeamCase beam_case({.size = size, .incidence = std::atof(argv[2]) * 0.017453292519943295});
  const bench::FloatSurface surface = beam_case.Draw(1, beam_case.whole_points());

  std::vector<double> power, rays;
  for (int row = 0; row < size; ++row)
    for (int j = 0; j <= size / 2; ++j) power.push_back(beam_case.ModePower(SignedIndex(row, size), j));
  for (const Ray& ray : beam_case.rays()) rays.insert(rays.end(), {ray.at_zero.x(), ray.at_zero.y()});
  if (!Write(power, folder + "/power.f64") || !Write(surface.heights, folder + "/heights.f32") ||
      !Write(rays, folder + "/rays.f64")) {
    std::cerr << "beam_case_surface: cannot write into " << folder << "\n";
    return 1;
  }

  const Eigen::Vector3d direction = beam_case.rays().front().direction;
  nlohmann::json report = {{"size", size},
                           {"points", surface.points},
                           {"spacing", surface.spacing},
                           {"direction", {direction.x(), direction.y(), direction.z()}},
                           {"refractive_index", kRefractiveIndex},
                           {"depths", bench::kDepths}};
  const TracedBeam traced = Trace(beam_case.rays(), surface.InDouble(), kRefractiveIndex);
  for (const bench::SpotAtDepth& spot : bench::SpotsOf(bench::MeansOf(traced)))
    report["spots"].push_back({spot.x, spot.y, spot.path});
  std::cout << report.dump(2) << "\n";
}
