// 2 sigma refraction angles over winds and incidences, as in Table 3, by the closed form and by Monte Carlo. The beam
// points downwind and the sea is fully developed.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "generator/math/statistics.h"
#include "generator/monte_carlo/monte_carlo.h"
#include "validation/published/published_angles.h"
#include "validation/published/published_tables.h"

namespace albtpu {

struct GridOptions {
  std::vector<double> wind_speeds;  // m/s
  std::vector<double> incidences;   // degree, in air
  double footprint = 0.25;          // m, of a uniform collimated beam
  double height_scale = 1;          // of all waves
};

struct RefractionGrid {
  struct Cell {
    Estimate along, cross;  // degree; the closed form has no standard error
  };

  GridOptions options;
  std::vector<Cell> cells;  // incidence varies fastest

  const Cell& At(std::size_t wind_speed, std::size_t incidence) const {
    return cells[wind_speed * options.incidences.size() + incidence];
  }
};

// Of a cell, along or across the wind.
using AngleAxis = Estimate RefractionGrid::Cell::*;
inline constexpr AngleAxis kAlongWind = &RefractionGrid::Cell::along, kCrossWind = &RefractionGrid::Cell::cross;

RefractionGrid ClosedFormGrid(const GridOptions& options);

struct SimulationSize {
  int surfaces;
  std::optional<int> rays;  // chosen from the sea and the footprint if absent
  Estimator estimator = Estimator::kControlVariate;
};

// All incidences of a wind see the same surfaces. Each wind and footprint has independent surfaces, which do not
// depend on `height_scale`.
RefractionGrid SimulateGrid(const GridOptions& options, const SimulationSize& size, std::uint64_t seed);

// Of the along-wind angles.
double LargestRelativeStandardError(const RefractionGrid& grid);

// The paper's Table 3 as a grid, without standard errors.
RefractionGrid GridOf(const PublishedAngles& published);

// The mean over all winds and incidences, as in Figure 9. The incidences of a wind share their surfaces, so their
// errors are taken as fully correlated.
Estimate MeanAngle(const RefractionGrid& grid, AngleAxis axis);

// Lines through the along-wind angles over wind, one for each incidence.
std::vector<LineFit> FitAlongWindByIncidence(const RefractionGrid& grid);
double LowestRSquared(const RefractionGrid& grid);  // of these lines

AngleModel FitAngleModel(const RefractionGrid& grid, AngleAxis axis);

// The distribution of ln(factor * ours / paper) over the clean cells of a published table.
struct LogRatio {
  double mean, rms, greatest;  // the largest in magnitude
};
LogRatio AlongWindLogRatio(const RefractionGrid& ours, double factor, const PublishedAngles& paper);
LogRatio CrossWindLogRatio(const RefractionGrid& ours, double factor, const PublishedAngles& paper);

// The number of cases in which a statement holds, and of all cases.
struct CaseCount {
  int holds = 0, all = 0;

  void Add(bool case_holds) {
    holds += case_holds;
    ++all;
  }
};
CaseCount AlongWindRisesWithWind(const RefractionGrid& grid);  // from each node to the next
CaseCount AlongWindRisesWithIncidence(const RefractionGrid& grid);
CaseCount AlongWindExceedsCrossWind(const RefractionGrid& grid);

}  // namespace albtpu
