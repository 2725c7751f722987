// One beam over one piece of sea: what all tracers and all realizations of the benchmarks are given alike.
#pragma once

#include <array>
#include <cstdint>
#include <iterator>
#include <vector>

#include "generator/kernels/packet_tracer.h"
#include "generator/kernels/ray_bundle.h"
#include "generator/math/random_stream.h"
#include "generator/surface/beam.h"
#include "generator/surface/cross_fade.h"
#include "generator/surface/height_field.h"
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

// The depths [m] at which a realization wants centroid and path.
inline constexpr double kDepths[] = {1, 2, 5, 10, 20};

// Heights in single precision about the centre of the beam, row-major, ix slow: every peer gets these
// numbers.
struct FloatWindow {
  std::vector<float> heights;  // m
  int points;                  // along a side, odd
  float spacing;               // m
  HeightView View() const { return {heights.data(), points, points, spacing}; }
  HeightField InDouble() const { return {{heights.begin(), heights.end()}, points, spacing}; }
};

// The rays of a collimated beam in single precision along a Morton curve, so that neighbours meet
// neighbouring cells: the order in which peers are fastest.
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
  const std::vector<Ray>& rays() const { return rays_; }  // as the beam gives them
  const RayBundle& bundle() const { return bundle_; }     // for ours
  const FloatRays& sorted() const { return sorted_; }     // for others
  std::vector<Ray> SortedRays() const;                    // as in sorted()

  // Points along the side of a window, odd: one that holds every ray with a margin for the shift by waves;
  // the patch.
  int footprint_points() const { return footprint_points_; }
  int whole_points() const { return options_.size - 1; }

  static NormalStream Stream(std::uint32_t realization);
  // The surface of one realization about patch point 0, by the double transform.
  FloatWindow Draw(std::uint32_t realization, int points) const;

 private:
  CaseOptions options_;
  SeaState sea_;
  CrossFade share_;
  WavePatchModel patch_;
  Beam beam_;
  int footprint_points_;
  std::vector<Ray> rays_;
  RayBundle bundle_;
  FloatRays sorted_;
};

// Of what peers compute, that which all of them do, over heights above the mean of all meetings as in
// TracedBeam.
struct BeamMeans {
  double tangent_x, tangent_y, secant;
  double height_tangent_x, height_tangent_y, height_secant;  // m
  int lost = 0;                                              // rays that found no surface; not in the means
};
BeamMeans MeansOf(const TracedBeam& traced);

// The greatest difference of any two means, heights in units of `footprint`.
double Difference(const BeamMeans& a, const BeamMeans& b, double footprint);

// Where the centroid of the beam is below the mean of its meetings with the surface, and its mean path there,
// m.
struct SpotAtDepth {
  double x, y, path;
};
using Spots = std::array<SpotAtDepth, std::size(kDepths)>;
Spots SpotsOf(const BeamMeans& means);  // linear in depth

}  // namespace albtpu::bench
