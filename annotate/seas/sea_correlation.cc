#include "annotate/seas/sea_correlation.h"

#include <nlohmann/json.hpp>

#include "sea/angle.h"
#include "sea/correlation/correlated_pulses.h"
#include "sea/spectra/described_sea.h"

namespace albtpu::annotate {
namespace {

using nlohmann::ordered_json;

constexpr double kFootprint = 0.6;               // m
constexpr double kIncidences[] = {0, 20};        // degrees
constexpr double kSides[] = {0.5, 1, 2, 5, 10};  // m
struct Lag {
  double along, across, later;  // m, m, s
};
constexpr Lag kLags[] = {{0.5, 0, 0}, {0, 0.5, 0}, {1, 0, 0},   {0, 1, 0},   {2, 0, 0}, {0, 2, 0},
                         {5, 0, 0},   {0, 5, 0},   {0, 0, 0.1}, {0, 0, 0.5}, {0, 0, 2}};

void Add(ordered_json& json, const PulseCorrelation& found) {
  json["slope_along"] = found.slope_x;
  json["slope_across"] = found.slope_y;
  json["horizontal"] = found.horizontal;
  json["vertical"] = found.vertical;
  json["height"] = found.height;
}

}  // namespace

ordered_json CorrelationJson(const SeaTimeline& seas, std::size_t record) {
  const DescribedSea described = Describe(seas.record(record), seas.settings().description());
  ordered_json beams = ordered_json::array();
  for (const double incidence : kIncidences) {
    const CorrelatedPulses pulses(described.spectrum,
                                  {.incidence = RadiansOfDegrees(incidence), .footprint = kFootprint},
                                  {.water_depth = described.water_depth});
    ordered_json& json = beams.emplace_back();
    json["incidence"] = incidence;
    json["footprint"] = kFootprint;
    for (const double side : kSides) {
      ordered_json& cell = json["cells"].emplace_back();
      cell["side"] = side;
      Add(cell, pulses.InCell({.side = side}));
    }
    for (const Lag& lag : kLags) {
      ordered_json& pair = json["lags"].emplace_back();
      pair["along"] = lag.along;
      pair["across"] = lag.across;
      pair["seconds"] = lag.later;
      Add(pair, pulses.Between(lag.along, lag.across, lag.later));
    }
  }
  return beams;
}

}  // namespace albtpu::annotate
