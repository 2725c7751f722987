// The responses of all beams of a table to one sea.
#pragma once

#include <cstddef>
#include <vector>

#include "sea/response/sea_response.h"

namespace albtpu {

// The beams of a table: every incidence with every azimuth and footprint. Immutable; one serves all seas.
class BeamGrid {
 public:
  // Angles in rad, footprints in m. Azimuths span half a turn where the waves are not symmetric about the x axis.
  BeamGrid(std::vector<double> incidences, std::vector<double> azimuths,
           const std::vector<double>& footprints, BeamProfile profile);

  const std::vector<double>& incidences() const { return incidences_; }
  const std::vector<double>& azimuths() const { return azimuths_; }
  const std::vector<FootprintKernel>& footprints() const { return footprints_; }

 private:
  std::vector<double> incidences_, azimuths_;
  std::vector<FootprintKernel> footprints_;
};

// Immutable.
class CompiledSea {
 public:
  CompiledSea(const SeaResponse& sea, const BeamGrid& grid);

  // By the indices of the grid.
  const BeamResponse& At(std::size_t incidence, std::size_t azimuth, std::size_t footprint) const {
    return beams_[(incidence * azimuths_ + azimuth) * footprints_ + footprint];
  }

 private:
  std::size_t azimuths_, footprints_;
  std::vector<BeamResponse> beams_;
};

}  // namespace albtpu
