// The path of one beam over the curved Earth: to the water, into it, and to the seabed, in earth-centred coordinates.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tests/flights/aircraft.h"

namespace albtpu::testing {

inline constexpr double kIndexOfWater = 1.34;  // At 532 nm; the value that the programs assume.

// A coast in chart coordinates: a beach that slopes into the sea, with ripples of 0.3 m on it. Depth grows along the
// course of the first line.
struct Coast {
  double course = 0;       // rad
  double shoreline = 0;    // m along the course
  double deepest_at = 1;   // m along the course
  double deepest = 17.6;   // m there, without the ripples
  double water_level = 0;  // m above the ellipsoid

  // m above the ellipsoid.
  double HeightAt(const Eigen::Vector2d& east_north) const;
};

// Wind waves of the significant height `height` [m], travelling within 60 degrees of the direction `towards` [rad from
// north]. The peak is at 10 m (a period of 2.5 s); the shortest that tilt a footprint of half a metre as a whole are
// 1 m. The spectrum of elevation is k^-3 exp(-1.25 (k_p/k)^2) between (Phillips 1958; Pierson and Moskowitz 1964), so
// that Hs 0.3 m has a slope of 0.104 rms. Height 0: flat.
class WavySurface {
 public:
  WavySurface(double height, double towards, RandomNumbers& random);

  struct Local {
    double elevation = 0;                             // m
    Eigen::Vector2d slope = Eigen::Vector2d::Zero();  // towards east, north
  };
  Local At(const Eigen::Vector2d& east_north, double time) const;

 private:
  struct Wave {
    double amplitude;            // m
    Eigen::Vector2d wavenumber;  // rad/m, east and north
    double frequency, phase;     // rad/s, rad
  };
  std::vector<Wave> waves_;
};

struct Scene {
  const AreaChart& chart;
  const Coast& coast;
  const WavySurface& waves;
};

struct BeamPath {
  Eigen::Vector3d water_point;      // m, earth-centred
  Eigen::Vector3d water_direction;  // Unit vector of the refracted beam.
  double slant_range = 0;           // m, from the sensor to the water
  double incidence = 0;             // rad, from the vertical at the water point, whatever the slope of the waves
  double azimuth = 0;               // rad, of the beam at the water point, clockwise from true north
};

// Where the beam from `sensor` in the direction `beam` (unit vector, downwards) meets the water at `time` [s].
BeamPath PathToWater(const Scene& scene, const Eigen::Vector3d& sensor, const Eigen::Vector3d& beam, double time);

// Distance [m] from `begin` to the ground in the direction `beam`.
double DistanceToGround(const Scene& scene, const Eigen::Vector3d& begin, const Eigen::Vector3d& beam);

// Snell's law in vectors: the unit vector behind a surface with the upward unit vector `normal`, of a beam that comes
// from air in the direction of the unit vector `beam`.
Eigen::Vector3d Refract(const Eigen::Vector3d& beam, const Eigen::Vector3d& normal);

}  // namespace albtpu::testing
