// One beam over one piece of sea: the common input of all tracers and realizations of the benchmarks.
#pragma once

#include <array>
#include <cstdint>
#include <iterator>
#include <vector>

#include "generator/kernels/packet_tracer.h"
#include "generator/kernels/ray_bundle.h"
#include "generator/math/random_stream.h"
#include "generator/surface/beam.h"
#include "generator/surface/ray_tracer.h"
#include "generator/surface/wave_patch.h"
#include "sea/sea_state.h"

namespace albtpu::bench {

struct CaseOptions {
  int size = 512;               // points along a side of the periodic patch
  double patch_per_beam = 2.5;  // side of the patch, in widths of the beam on the water
  double wind_speed = 10;       // m/s, fully developed
  double incidence = 0;         // rad
  double azimuth = 0.6;         // rad: along neither axis of the grid
  double footprint = 0.5;       // m
  int rays = 10000;
  BeamOptions BeamOf() const { return {.incidence = incidence, .azimuth = azimuth, .footprint = footprint}; }
};

// The depths [m] at which a realization computes centroid and path.
inline constexpr double kDepths[] = {1, 2, 5, 10, 20};

// Heights in single precision about the centre of the beam, row-major, ix slow. Every peer gets these numbers.
struct FloatSurface {
  std::vector<float> heights;  // m
  int points;                  // along a side, odd
  float spacing;               // m
  HeightView View() const { return {heights.data(), points, points, spacing}; }
  HeightField InDouble() const { return {{heights.begin(), heights.end()}, points, spacing}; }
};

// The rays of a collimated beam in single precision along a Morton curve, so that successive rays meet neighbouring
// cells: the order in which the peers are fastest.
struct FloatRays {
  std::vector<float> x, y;    // m, where they cross z = 0
  Eigen::Vector3d direction;  // unit vector, downward
};

// Immutable.
class BeamCase {
 public:
  explicit BeamCase(const CaseOptions& options);

  const CaseOptions& options() const { return options_; }
  const WavePatchModel& patch() const { return patch_; }
  // The expected |amplitude|^2 of the patch's mode (i, j), m^2.
  double ModePower(int i, int j) const;
  const Beam& beam() const { return beam_; }
  const std::vector<Ray>& rays() const { return rays_; }  // in the order of the beam
  const RayBundle& bundle() const { return bundle_; }     // for our tracer
  const FloatRays& sorted() const { return sorted_; }     // for the peers
  std::vector<Ray> SortedRays() const;                    // as in sorted()

  // Odd numbers of points along the side of a surface: one that holds every ray with a margin for the shift by waves,
  // and the whole patch.
  int footprint_points() const { return footprint_points_; }
  int whole_points() const { return options_.size - 1; }

  static NormalStream Stream(std::uint32_t realization);
  // The surface of one realization about patch point 0, by the double transform.
  FloatSurface Draw(std::uint32_t realization, int points) const;

 private:
  CaseOptions options_;
  WavePatchModel patch_;
  Beam beam_;
  int footprint_points_;
  std::vector<Ray> rays_;
  RayBundle bundle_;
  FloatRays sorted_;
};

// The means that every peer computes, as in TracedBeam, with heights above the mean of all intersections.
struct BeamMeans {
  double tangent_x, tangent_y, secant;
  double height_tangent_x, height_tangent_y, height_secant;  // m
  int lost = 0;                                              // rays that found no surface; not in the means
};
BeamMeans MeansOf(const TracedBeam& traced);

// The greatest difference between corresponding means, with heights in units of `footprint`.
double Difference(const BeamMeans& a, const BeamMeans& b, double footprint);

// The centroid of the beam relative to the mean of its intersections with the surface, and its mean path length, m.
struct SpotAtDepth {
  double x, y, path;
};
using Spots = std::array<SpotAtDepth, std::size(kDepths)>;
Spots SpotsOf(const BeamMeans& means);  // linear in depth

}  // namespace albtpu::bench
