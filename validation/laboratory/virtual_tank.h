// The laboratory of Birkebak et al. (2018), section 2.2: a laser above a wave tank, waves that evolve in it, and
// photodiodes under its water.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "generator/math/fft.h"
#include "generator/math/random_stream.h"
#include "generator/math/statistics.h"
#include "generator/surface/beam.h"
#include "generator/surface/ray_tracer.h"
#include "sea/response/closed_form.h"
#include "sea/sea_state.h"

namespace albtpu {

// A patch of sea that evolves in time: random waves that travel by the dispersion of wave_staff.h.

// One realization of a periodic square patch. Immutable.
//
// The waves with the wavenumbers k and -k travel in opposite directions and are independent. With complex
// amplitudes a(k) of power 2 Psi(k) dkx dky, where Psi is directional, the elevation is the real part of the sum of
// a(k) exp(i (k . x - omega t)). At any instant this is a frozen surface with the spectrum SeaState::Psi.
class EvolvingPatch {
 public:
  // `length` [m] is that of a side, `size` the number of points along it, even. Modes at half the sampling wavenumber
  // are zero.
  EvolvingPatch(const SeaState& sea, double length, int size, const NormalStream& stream);

  // Elevations [m] at the points (ix, iy), iy varying fastest, `time` [s] after the start.
  std::vector<double> HeightsAt(double time) const;

 private:
  struct Mode {  // of the half plane of wavenumbers that is stored
    double angular_frequency;
    std::complex<double> forward, backward;  // half of a(k), and of the conjugate of a(-k)
  };

  InverseFft transform_;
  std::vector<Mode> modes_;
};

// The detector of the laboratory: a square array of photodiodes under water, and the centroid of their signals.
//
// Source: Birkebak et al. (2018), section 2.2. The paper does not state the aperture: 1 cm is assumed.

struct PhotodiodeArrayOptions {
  int per_side = 6;
  double pitch = 0.05;     // m, centre to centre
  double aperture = 0.01;  // m, diameter of the round window of one photodiode, at most the pitch
};

// Immutable. Rows and columns are along x and y.
class PhotodiodeArray {
 public:
  PhotodiodeArray(const PhotodiodeArrayOptions& options, const Eigen::Vector2d& centre);

  // The centroid of the samples, sum(x I) / sum(I), where the intensity I of a photodiode is the number of spots
  // within its aperture. (Eq. 20 and 21 are read as M10 / M00 and M01 / M00: as printed, the denominator is a signed
  // sum that can vanish.) None if no photodiode is lit.
  std::optional<Eigen::Vector2d> Centroid(const std::vector<Eigen::Vector2d>& spots) const;

 private:
  PhotodiodeArrayOptions options_;
  Eigen::Vector2d corner_;  // the centre of the photodiode with the smallest x and y
};

// The points where the refracted rays cross the plane `depth` [m] below the mean surface. Rays, water and spots are
// in the same coordinates. Every ray carries the same power.
std::vector<Eigen::Vector2d> SpotsAtDepth(const std::vector<Ray>& rays, const HeightField& water,
                                          double refractive_index, double depth);

// The sea that the paper fitted to its tank, of Apel's spectrum, scaled to a significant wave height [m].
inline constexpr double kTankFetch = 30;          // m, of the spectrum in Fig. 7
inline constexpr double kTankWaveHeight = 0.009;  // m, Table 2 at 6.5 to 8.5 m from the fan
SeaState TankSea(double wind_speed_10m, double significant_wave_height);
double UnscaledTankWaveHeight(double wind_speed_10m);  // m, of the spectrum before scaling

// The elevations of the water in one frame: a periodic square patch, iy varying fastest.
using WaterOfFrame = std::function<std::vector<double>(int frame)>;

struct TankGrid {
  double length = 1.024;  // m, side of the patch
  int size = 512;         // points along it, even; 2 mm apart
};

// Frames of independent waves.
WaterOfFrame IndependentFrames(const SeaState& sea, const TankGrid& grid, std::uint64_t seed, std::uint32_t cell);
// Frames of one sea that evolves in time, at `rate` [Hz].
WaterOfFrame SuccessiveFrames(const SeaState& sea, const TankGrid& grid, double rate, std::uint64_t seed,
                              std::uint32_t cell);

// A uniform beam, 0.25 m wide on the water, from a point 4 m above it. (60 mrad make 0.24 m.)
inline BeamOptions LaboratoryBeam(double incidence) {  // rad
  return {.incidence = incidence, .footprint = 0.25, .source_height = 4};
}

struct TankExperiment {
  std::vector<BeamOptions> beams = std::vector<BeamOptions>(1, LaboratoryBeam(0));
  std::vector<PhotodiodeArrayOptions> arrays =  // all in the same light
      std::vector<PhotodiodeArrayOptions>(1);
  double depth = 0.25;  // m, of the arrays below the mean surface
  int rays = 40000;
  double refractive_index = kRefractiveIndex;
  TankGrid grid;
  int frames = 400;  // 20 s at 20 Hz
};

// Eq. 18 and 19 as printed, atan(shift of a centroid from still water / depth): rad, one value for each frame. Frames
// in which no photodiode is lit are left out.
struct CentroidAngles {
  Eigen::ArrayXd along_wind, cross_wind;
};

// 2 sigma in degrees, as in tables; the standard errors hold for independent frames.
struct CentroidScatter {
  Estimate along_wind, cross_wind;
};
CentroidScatter ScatterOf(const CentroidAngles& angles);

struct TankReading {                   // of one beam
  CentroidAngles full_beam;            // of the centroid of all its light
  std::vector<CentroidAngles> arrays;  // of the centroid of each array's samples
};

// The arrays are centred where the axis of the beam would arrive through still water. Runs on all threads of the
// current TBB arena.
std::vector<TankReading> ObserveTank(const TankExperiment& experiment, const WaterOfFrame& water);

// The spots of the first beam in one frame: the pattern of light that its arrays sample.
std::vector<Eigen::Vector2d> LightOfFrame(const TankExperiment& experiment, const std::vector<double>& water);

}  // namespace albtpu
