#include "service/server/calls/sea_correlation.h"

#include <cmath>
#include <string>

#include "absl/strings/str_cat.h"
#include "sea/angle.h"
#include "sea/correlation/correlated_pulses.h"
#include "service/server/ground/errors.h"
#include "service/server/ground/limits.h"

namespace albtpu::server {
namespace {

constexpr double kFarthest = 60;  // m, of two pulses

// Notes what is wrong.
class Checks {
 public:
  // sea.proto states the same ranges.
  void InRange(const std::string& path, double number, double lowest, double highest, const char* unit) {
    if (number >= lowest && number <= highest) return;
    Add(path, absl::StrCat(path, " is ", number, unit, " (expected ", lowest, " to ", highest, "); correct it"));
  }
  void AtMost(const std::string& path, int count, int most) {
    if (count > most)
      Add(path, absl::StrCat(path, " has ", count, " entries (", most, " at most); send several requests"));
  }
  absl::Status ToStatus() const { return violations_.ToStatus(); }

 private:
  void Add(const std::string& path, const std::string& text) {
    if (count_++ < kMaxSeaViolations) violations_.Add(path, text);
  }

  FieldViolations violations_;
  std::size_t count_ = 0;
};

absl::Status Check(const v1::CorrelationQuery& query) {
  Checks checks;
  checks.InRange("incidence", query.incidence(), 0, 30, " degrees");
  checks.InRange("azimuth", query.azimuth(), -360, 360, " degrees");
  checks.InRange("footprint", query.footprint(), 0.05, 10, " m");
  if (query.has_refractive_index()) checks.InRange("refractive_index", query.refractive_index(), 1.3, 1.4, "");
  checks.AtMost("separations", query.separations_size(), kMaxSeparations);
  checks.AtMost("cells", query.cells_size(), kMaxCells);
  for (int i = 0; i < query.separations_size(); ++i) {
    const v1::PulseSeparation& pair = query.separations(i);
    const std::string path = absl::StrCat("separations[", i, "]");
    checks.InRange(path, std::hypot(pair.x(), pair.y()), 0, kFarthest, " m away");
    checks.InRange(path + ".seconds", pair.seconds(), -60, 60, " s");
  }
  for (int i = 0; i < query.cells_size(); ++i) {
    const std::string path = absl::StrCat("cells[", i, "]");
    checks.InRange(path + ".side", query.cells(i).side(), 0.01, 50, " m");
    checks.InRange(path + ".orientation", query.cells(i).orientation(), -360, 360, " degrees");
  }
  return checks.ToStatus();
}

v1::PulseCorrelation ToWire(const PulseCorrelation& found) {
  v1::PulseCorrelation wire;
  wire.set_slope_x(found.slope_x);
  wire.set_slope_y(found.slope_y);
  wire.set_horizontal(found.horizontal);
  wire.set_vertical(found.vertical);
  wire.set_height(found.height);
  return wire;
}

}  // namespace

absl::StatusOr<v1::SeaCorrelation> CorrelateSea(const KnownSea& sea, const v1::CorrelationQuery& query) {
  if (const absl::Status status = Check(query); !status.ok()) return status;
  const DescribedSea described = Describe(sea);
  const CorrelatedPulses pulses(
      described.spectrum,
      {.incidence = RadiansOfDegrees(query.incidence()),
       .azimuth = RadiansOfDegrees(query.azimuth()),
       .footprint = query.footprint(),
       .gaussian = query.gaussian(),
       .refractive_index = query.has_refractive_index() ? query.refractive_index() : CorrelatedBeam().refractive_index},
      {.travel = query.waves_travel_both_ways() ? WaveTravel::kBothWays : WaveTravel::kOneWay,
       .water_depth = described.water_depth});
  v1::SeaCorrelation answer;
  for (const v1::PulseSeparation& pair : query.separations())
    *answer.add_separations() = ToWire(pulses.Between(pair.x(), pair.y(), pair.seconds()));
  for (const v1::SurfaceCell& cell : query.cells())
    *answer.add_cells() = ToWire(pulses.InCell({cell.side(), RadiansOfDegrees(cell.orientation())}));
  return answer;
}

}  // namespace albtpu::server
