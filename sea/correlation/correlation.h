// What the correlation of pulses is asked for, and its numbers.
#pragma once

#include <limits>

namespace albtpu {

// Which way waves travel. The even harmonics of a HarmonicSpectrum do not say it: a wave and the one that travels the
// opposite way look alike. It matters only between two pulses apart in both place and time.
enum class WaveTravel {
  // Towards `WaveMotion::towards`, as most wind waves do: with c the cosine of the angle to it, the spectrum is
  // multiplied by 1 + 2 c / (1 + c^2). This is the cosine-2S spreading with s = 2, whatever the even part: of the waves
  // along the axis all travel towards it, of those at 60 degrees 90 %, of those across it half.
  kOneWay,
  // Half of the waves each way, as in the spreading of Elfouhaily et al.: the covariance is the same for the opposite
  // vector between the pulses.
  kBothWays,
};

struct WaveMotion {
  WaveTravel travel = WaveTravel::kOneWay;
  double towards = 0;                                            // rad from x; 0 is downwind
  double water_depth = std::numeric_limits<double>::infinity();  // m, for the dispersion AngularFrequency()
};

// A square of the water, over which pulses of one pass are averaged. They see the sea at one instant.
struct SurfaceCell {
  double side;             // m, 0.01 to 50
  double orientation = 0;  // rad, of one side from x
};

// The covariance of what the waves do to two pulses, or the variance of what they do to the mean over a cell, divided
// by the variance of one pulse: 1 where both share all, 0 where they share nothing, negative where a wave lifts the one
// side and lowers the other. 0 over a sea without waves.
struct PulseCorrelation {
  double slope_x = 0, slope_y = 0;  // of the slopes along the two axes of the sea, averaged over the footprint
  double horizontal = 0;            // of the horizontal error of the reported point: of the sum of both components
  double vertical = 0;              // of its vertical error, of first and second order in slope together
  double vertical_first = 0, vertical_second = 0;  // of these parts. At nadir there is none of first order.
  double height = 0;                               // of the height of the water, averaged over the footprint
};

// The variance of the mean of `pulses` pulses, anywhere in a cell, over that of one.
inline double MeanOfPulses(double cell_correlation, double pulses) {
  return cell_correlation + (1 - cell_correlation) / pulses;
}

}  // namespace albtpu
