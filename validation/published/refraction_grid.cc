#include "validation/published/refraction_grid.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "sea/angle.h"
#include "sea/response/closed_form.h"

namespace albtpu {
namespace {

SeaCase SeaCaseAt(const GridOptions& options, double wind_speed) {
  SeaCase sea_case;
  sea_case.sea = {.waves = WindSea{.wind_speed_10m = wind_speed}, .height_scale = options.height_scale};
  for (const double incidence : options.incidences)
    sea_case.beams.push_back({.incidence = RadiansOfDegrees(incidence), .footprint = options.footprint});
  return sea_case;
}

LogRatio LogRatioOf(const RefractionGrid& ours, double factor, const PublishedAngles& paper, AngleAxis axis,
                    double PublishedAngles::Cell::*printed, bool PublishedAngles::Cell::*is_clean) {
  assert(ours.cells.size() == paper.cells.size());
  std::vector<double> log_ratios;
  for (std::size_t c = 0; c < paper.cells.size(); ++c)
    if (paper.cells[c].*is_clean)
      log_ratios.push_back(std::log(factor * (ours.cells[c].*axis).value / paper.cells[c].*printed));
  LogRatio result{0, 0, 0};
  for (const double log_ratio : log_ratios) {
    result.mean += log_ratio / static_cast<double>(log_ratios.size());
    result.rms += log_ratio * log_ratio / static_cast<double>(log_ratios.size());
    if (std::abs(log_ratio) > std::abs(result.greatest)) result.greatest = log_ratio;
  }
  result.rms = std::sqrt(result.rms);
  return result;
}

}  // namespace

RefractionGrid ClosedFormGrid(const GridOptions& options) {
  RefractionGrid grid{options, {}};
  for (const double wind_speed : options.wind_speeds) {
    const SeaCase sea_case = SeaCaseAt(options, wind_speed);
    const SeaState sea(sea_case.sea);
    for (const BeamOptions& beam : sea_case.beams) {
      const SmallSlopeUncertainty theory = ClosedForm(sea, beam, sea_case.refractive_index);
      grid.cells.push_back(
          {InDegrees({theory.refraction_along_wind, 0}), InDegrees({theory.refraction_cross_wind, 0})});
    }
  }
  return grid;
}

RefractionGrid SimulateGrid(const GridOptions& options, const SimulationSize& size, std::uint64_t seed) {
  const Effort effort{.realizations = size.surfaces,
                      .most_realizations = size.surfaces,
                      .relative_error = 0,
                      .estimator = size.estimator};
  RefractionGrid grid{options, {}};
  for (std::size_t w = 0; w < options.wind_speeds.size(); ++w) {
    SeaCase sea_case = SeaCaseAt(options, options.wind_speeds[w]);
    sea_case.rays = size.rays;
    // The cell of the random stream: footprint in mm and index of the wind.
    const auto cell = static_cast<std::uint32_t>(std::lround(1e3 * options.footprint) * 1000 + w);
    const SeaCaseResult result = Simulate(sea_case, effort, seed, cell);
    for (const BeamUncertainty& beam : result.beams)
      grid.cells.push_back({InDegrees(beam.refraction_along_wind), InDegrees(beam.refraction_cross_wind)});
  }
  return grid;
}

double LargestRelativeStandardError(const RefractionGrid& grid) {
  double greatest = 0;
  for (const RefractionGrid::Cell& cell : grid.cells)
    greatest = std::max(greatest, cell.along.standard_error / cell.along.value);
  return greatest;
}

RefractionGrid GridOf(const PublishedAngles& published) {
  RefractionGrid grid{{published.wind_speeds, published.incidences}, {}};
  for (const PublishedAngles::Cell& cell : published.cells) grid.cells.push_back({{cell.along, 0}, {cell.cross, 0}});
  return grid;
}

Estimate MeanAngle(const RefractionGrid& grid, AngleAxis axis) {
  Estimate mean;
  double variance = 0;
  const double winds = static_cast<double>(grid.options.wind_speeds.size());
  const double incidences = static_cast<double>(grid.options.incidences.size());
  for (std::size_t w = 0; w < grid.options.wind_speeds.size(); ++w) {
    double error = 0;
    for (std::size_t i = 0; i < grid.options.incidences.size(); ++i) {
      mean.value += (grid.At(w, i).*axis).value / (winds * incidences);
      error += (grid.At(w, i).*axis).standard_error / incidences;
    }
    variance += error * error / (winds * winds);
  }
  mean.standard_error = std::sqrt(variance);
  return mean;
}

std::vector<LineFit> FitAlongWindByIncidence(const RefractionGrid& grid) {
  std::vector<LineFit> fits;
  for (std::size_t i = 0; i < grid.options.incidences.size(); ++i) {
    std::vector<double> angles;
    for (std::size_t w = 0; w < grid.options.wind_speeds.size(); ++w) angles.push_back(grid.At(w, i).along.value);
    fits.push_back(FitLine(grid.options.wind_speeds, angles));
  }
  return fits;
}

double LowestRSquared(const RefractionGrid& grid) {
  double lowest = 1;
  for (const LineFit& fit : FitAlongWindByIncidence(grid)) lowest = std::min(lowest, fit.r_squared);
  return lowest;
}

AngleModel FitAngleModel(const RefractionGrid& grid, AngleAxis axis) {
  std::vector<AngleSample> samples;
  for (std::size_t w = 0; w < grid.options.wind_speeds.size(); ++w)
    for (std::size_t i = 0; i < grid.options.incidences.size(); ++i)
      samples.push_back({grid.options.wind_speeds[w], grid.options.incidences[i], (grid.At(w, i).*axis).value});
  return FitAngleModel(samples);
}

LogRatio AlongWindLogRatio(const RefractionGrid& ours, double factor, const PublishedAngles& paper) {
  return LogRatioOf(ours, factor, paper, kAlongWind, &PublishedAngles::Cell::along,
                    &PublishedAngles::Cell::along_is_clean);
}

LogRatio CrossWindLogRatio(const RefractionGrid& ours, double factor, const PublishedAngles& paper) {
  return LogRatioOf(ours, factor, paper, kCrossWind, &PublishedAngles::Cell::cross,
                    &PublishedAngles::Cell::cross_is_clean);
}

CaseCount AlongWindRisesWithWind(const RefractionGrid& grid) {
  CaseCount count;
  for (std::size_t w = 1; w < grid.options.wind_speeds.size(); ++w)
    for (std::size_t i = 0; i < grid.options.incidences.size(); ++i)
      count.Add(grid.At(w, i).along.value > grid.At(w - 1, i).along.value);
  return count;
}

CaseCount AlongWindRisesWithIncidence(const RefractionGrid& grid) {
  CaseCount count;
  for (std::size_t w = 0; w < grid.options.wind_speeds.size(); ++w)
    for (std::size_t i = 1; i < grid.options.incidences.size(); ++i)
      count.Add(grid.At(w, i).along.value > grid.At(w, i - 1).along.value);
  return count;
}

CaseCount AlongWindExceedsCrossWind(const RefractionGrid& grid) {
  CaseCount count;
  for (const RefractionGrid::Cell& cell : grid.cells) count.Add(cell.along.value > cell.cross.value);
  return count;
}

}  // namespace albtpu
