// The responses of a sea to beams of many directions, from those of few.
//
// The response of a beam is smooth in the horizontal vector of its direction. At an azimuth it is a power series in
// tan^2(incidence), and at an incidence a Fourier series in the azimuth with the period of half a turn, whose terms
// fall by some tan^2(incidence) / 4 beyond the harmonics of the slopes' covariance. Polynomials through Chebyshev's
// nodes in tan^2(incidence), and trigonometric polynomials through equidistant azimuths, therefore converge fast.
// beam_directions_test states their error.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "sea/response/sea_response.h"

namespace albtpu {

// Every incidence with every azimuth. Immutable; one serves all seas.
class BeamDirections {
 public:
  // Angles in rad, incidences from 0 on and not all 0.
  BeamDirections(const std::vector<double>& incidences, const std::vector<double>& azimuths);

  std::size_t size() const { return wanted_.size(); }

  // By (incidence, azimuth, footprint), the last fastest.
  std::vector<BeamResponse> ResponsesOf(const SeaResponse& sea, const std::vector<FootprintKernel>& footprints) const;

 private:
  struct Direction {
    double incidence, azimuth;
  };

  std::vector<Direction> wanted_, traced_;
  // The weight of each traced direction at each wanted one: of what is even in the direction, and of what is odd.
  Eigen::MatrixXd even_, odd_;
};

}  // namespace albtpu
