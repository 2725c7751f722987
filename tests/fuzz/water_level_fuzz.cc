// Arbitrary text as a CSV file of water levels is rejected with a message that names the file, for either form of the
// times of points; or its times increase, its levels are finite, and columns of times give what single times give.
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "formats/trajectories/water_level_file.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/trajectory_promises.h"

namespace {

using namespace albtpu;
using namespace albtpu::formats;

void CheckSeries(const WaterLevelSeries& series) {
  ALBTPU_MUST(series.size() >= 2);
  const double start = series.start(), end = series.end();
  ALBTPU_MUST(std::isfinite(start) && std::isfinite(end) && start < end);
  ALBTPU_MUST(series.At(start).has_value() && series.At(end).has_value());
  ALBTPU_MUST(!series.At(std::nextafter(end, INFINITY)).has_value());
  std::vector<double> times = {NAN, INFINITY, -INFINITY, 0, start, end, start - 1, end + 1};
  for (int i = 0; i <= 12; ++i) times.push_back(start + (end - start) * ((i * 5) % 13) / 12.0);
  for (int i = 0; i <= 6; ++i) times.push_back(start + 600.0 * i);
  std::vector<double> levels(times.size());
  series.LevelsAt(times, levels);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const std::optional<double> level = series.At(times[i]);
    ALBTPU_MUST(level.has_value() == !std::isnan(levels[i]));
    if (level.has_value()) ALBTPU_MUST(*level == levels[i] && std::abs(*level) <= 1.0000001e5);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const PointTimeForm form = size % 2 == 0 ? PointTimeForm::kAdjustedStandard : PointTimeForm::kWeekSeconds;
  const absl::StatusOr<WaterLevelSeries> series = WaterLevelSeries::Parse("file", text, form);
  if (series.ok())
    CheckSeries(*series);
  else
    fuzz::MustExplain(series.status(), "file");
  return 0;
}
