// The simulations for Table 3 and Figures 8 and 9, at the conditions of the paper's Table 1 on the fully developed
// sea, and the tables of their results beside the paper's.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "validation/published/published_angles.h"
#include "validation/published/refraction_grid.h"
#include "validation/report/study.h"

namespace albtpu {

inline const std::vector<double> kPaperDiameters = {0.25, 0.5, 1, 2, 4};  // m, Table 1

struct PaperMonteCarloSize {
  SimulationSize plain;  // for every diameter, by tracing alone
  SimulationSize fine;   // at 0.25 m
};
// Unless `quick`, the plain run has the paper's size and method: 500 surfaces, 10,000 rays, tracing alone (section
// 2.1.2).
PaperMonteCarloSize SizeOfPaperMonteCarlo(bool quick);

struct PaperMonteCarlo {
  PublishedAngles paper;            // Table 3
  RefractionGrid closed_form;       // at 0.25 m, like the next two
  RefractionGrid fine, fine_sqrt2;  // unscaled, and with all heights times sqrt 2
  std::vector<RefractionGrid> by_diameter,
      closed_form_by_diameter;  // the plain run, one for each of kPaperDiameters
  std::string plain_name;       // "plain Monte Carlo, 500 surfaces"
};
PaperMonteCarlo RunPaperMonteCarlo(PublishedAngles table_3, const PaperMonteCarloSize& size, std::uint64_t seed);

// Table 3, Figures 8 and 9 and Eq. 27-28 beside our numbers.
DataTable Table3(const PaperMonteCarlo& runs);
DataTable LinesInWind(const PaperMonteCarlo& runs);
DataTable AngleModels(const PaperMonteCarlo& runs);  // Eq. 27 and 28
DataTable Figure8(const PaperMonteCarlo& runs);
DataTable Figure9(const PaperMonteCarlo& runs);

}  // namespace albtpu
