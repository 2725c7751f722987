// The runs behind Table 3 and Figures 8 and 9: the conditions of the paper's Table 1 on the fully developed
// sea.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "validation/published/published_angles.h"
#include "validation/published/refraction_grid.h"

namespace albtpu {

inline const std::vector<double> kPaperDiameters = {0.25, 0.5, 1, 2, 4};  // m, Table 1

struct PaperMonteCarloSize {
  SimulationSize plain;  // of every diameter, by tracing alone
  SimulationSize fine;   // at 0.25 m
};
// If not quick, the plain run has the paper's size: 500 surfaces and 10,000 rays, by tracing alone as
// the paper does it (section 2.1.2).
PaperMonteCarloSize SizeOfPaperMonteCarlo(bool quick);

struct PaperMonteCarlo {
  PublishedAngles paper;            // Table 3
  RefractionGrid closed_form;       // at 0.25 m, as the next two
  RefractionGrid fine, fine_sqrt2;  // as it is, and with all heights times sqrt 2
  std::vector<RefractionGrid> by_diameter,
      closed_form_by_diameter;  // the plain run, as kPaperDiameters
  std::string plain_name;       // "plain Monte Carlo, 500 surfaces"
};
PaperMonteCarlo RunPaperMonteCarlo(PublishedAngles table_3, const PaperMonteCarloSize& size,
                                   std::uint64_t seed);

}  // namespace albtpu
