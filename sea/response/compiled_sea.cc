#include "sea/response/compiled_sea.h"

#include <cmath>
#include <utility>

namespace albtpu {

BeamGrid::BeamGrid(std::vector<double> incidences, std::vector<double> azimuths,
                   const std::vector<double>& footprints, BeamProfile profile)
    : incidences_(std::move(incidences)), azimuths_(std::move(azimuths)) {
  for (const double footprint : footprints) footprints_.emplace_back(profile, footprint);
}

CompiledSea::CompiledSea(const SeaResponse& sea, const BeamGrid& grid)
    : azimuths_(grid.azimuths().size()), footprints_(grid.footprints().size()) {
  for (const double incidence : grid.incidences()) {
    std::vector<BeamResponse> direction;
    for (const double azimuth : grid.azimuths()) {
      if (incidence == 0 && !direction.empty()) {  // at nadir all azimuths are the same beam
        for (BeamResponse& beam : direction) beam.azimuth << std::cos(azimuth), std::sin(azimuth);
      } else {
        direction = sea.AlongDirection(incidence, azimuth, grid.footprints());
      }
      beams_.insert(beams_.end(), direction.begin(), direction.end());
    }
  }
}

}  // namespace albtpu
