// Arbitrary bytes as an ASCII trajectory, an SBET, an SMRMSG or a CSV file of water levels are rejected with a message
// that begins with the name of the file, or keep what the headers of the readers promise.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "formats/files/file_access.h"
#include "formats/trajectories/ascii_motion.h"
#include "formats/trajectories/ascii_trajectory.h"
#include "formats/trajectories/sbet_file.h"
#include "formats/trajectories/water_level_file.h"
#include "tests/fuzz/fuzz_target.h"

namespace albtpu::fuzz {
namespace {

using namespace albtpu::formats;

constexpr char kName[] = "file";

// What trajectory.h promises of a trajectory that was opened.
void MustKeepPromises(const Trajectory& trajectory) {
  ALBTPU_MUST(trajectory.size() >= 2);
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    const TrajectoryRecord record = trajectory.Record(i);
    ALBTPU_MUST(std::isfinite(record.time) && record.time == trajectory.TimeAt(i));
    ALBTPU_MUST(i == 0 || record.time > trajectory.TimeAt(i - 1));
    ALBTPU_MUST(std::abs(record.latitude) <= std::numbers::pi / 2 && std::isfinite(record.longitude));
    ALBTPU_MUST(std::isfinite(record.height));
    ALBTPU_MUST(std::isfinite(record.roll) && std::isfinite(record.pitch) && std::isfinite(record.heading));
    const std::optional<TrajectorySigma> sigma = trajectory.SigmaAt(i);
    if (!sigma.has_value()) continue;
    for (const double value : {sigma->north, sigma->east, sigma->down, sigma->roll, sigma->pitch, sigma->heading})
      ALBTPU_MUST(value >= 0 && std::isfinite(value));
  }
}

// There is a record for each line of numbers.
void AsciiTrajectoryTarget(std::string_view text) {
  const auto trajectory = AsciiTrajectory::Parse(kName, text);
  if (!trajectory.ok()) return MustExplain(trajectory.status(), kName);
  ALBTPU_MUST(AsciiTrajectory::Recognizes(text));
  const std::size_t columns = (*trajectory)->columns();
  ALBTPU_MUST(columns == 15 || columns == 20);
  ALBTPU_MUST((*trajectory)->size() <= text.size() / (2 * columns) + 1);  // A digit and a separator for each number.
  MustKeepPromises(**trajectory);
  for (std::size_t i = 0; i < (*trajectory)->size(); ++i) {
    const TrajectoryRecord record = (*trajectory)->Record(i);
    ALBTPU_MUST(std::isfinite(record.velocity_north) == (columns == 20));
    const auto grid = (*trajectory)->GridPositionAt(i);
    ALBTPU_MUST(!grid.has_value() || (std::isfinite(grid->x) && std::isfinite(grid->y)));
  }
}

// Velocities agree with the positions.
void SbetTarget(std::string_view bytes) {
  const auto trajectory = SbetFile::Parse(kName, MappedFile::View(bytes));
  if (!trajectory.ok()) return MustExplain(trajectory.status(), kName);
  ALBTPU_MUST((*trajectory)->size() * sizeof(SbetRecord) == bytes.size());
  MustKeepPromises(**trajectory);
  const std::optional<double> difference = VelocityDifference(**trajectory);
  ALBTPU_MUST(!difference.has_value() || *difference <= kLargestVelocityDifference);
}

constexpr double TrajectorySigma::*kSigmas[] = {
    &TrajectorySigma::north,          &TrajectorySigma::east,          &TrajectorySigma::down,
    &TrajectorySigma::velocity_north, &TrajectorySigma::velocity_east, &TrajectorySigma::velocity_down,
    &TrajectorySigma::roll,           &TrajectorySigma::pitch,         &TrajectorySigma::heading};

// a + w (b - a) may leave [a, b] by its roundings, at most two units in the last place of the larger.
bool IsBetween(double value, double a, double b) {
  const double slack = 4 * std::numeric_limits<double>::epsilon() * std::max(a, b);
  return value >= std::min(a, b) - slack && value <= std::max(a, b) + slack;
}

void CheckBetween(const SmrmsgFile& file, std::size_t record) {
  const double before = file.TimeAt(record - 1), after = file.TimeAt(record);
  const double time = before + (after - before) / 3;
  const std::optional<TrajectorySigma> sigma = file.SigmaAt(time);
  if (time > before && time < after) ALBTPU_MUST(sigma.has_value() == (after - before <= SmrmsgFile::kLongestGap));
  if (!sigma.has_value()) return;
  const TrajectorySigma a = file.SigmaOf(record - 1), b = file.SigmaOf(record);
  for (const auto field : kSigmas) ALBTPU_MUST(IsBetween((*sigma).*field, a.*field, b.*field));
}

// Times increase, sigmas are finite and not negative, and those between two records lie between theirs.
void SmrmsgTarget(std::string_view bytes) {
  const bool recognized = SmrmsgFile::Recognizes(bytes);
  const absl::StatusOr<SmrmsgFile> file = SmrmsgFile::Parse(kName, bytes);
  if (!file.ok()) return MustExplain(file.status(), kName);
  ALBTPU_MUST(recognized && file->size() * SmrmsgFile::kRecordSize == bytes.size());
  for (std::size_t i = 0; i < file->size(); ++i) {
    const std::optional<TrajectorySigma> sigma = file->SigmaAt(file->TimeAt(i));
    ALBTPU_MUST(sigma.has_value());
    for (const auto field : kSigmas) {
      ALBTPU_MUST((*sigma).*field >= 0 && std::isfinite((*sigma).*field));
      ALBTPU_MUST((*sigma).*field == file->SigmaOf(i).*field);
    }
    if (i == 0) continue;
    ALBTPU_MUST(file->TimeAt(i) > file->TimeAt(i - 1));
    CheckBetween(*file, i);
  }
  const double start = file->TimeAt(0), end = file->TimeAt(file->size() - 1);
  ALBTPU_MUST(!file->SigmaAt(std::nextafter(start, -INFINITY)).has_value());
  ALBTPU_MUST(!file->SigmaAt(std::nextafter(end, INFINITY)).has_value());
}

// Of this project and of CO-OPS, for either form of the times of points: levels are finite, and columns of times give
// what single times give.
void WaterLevelTarget(std::string_view text) {
  const PointTimeForm form = text.size() % 2 == 0 ? PointTimeForm::kAdjustedStandard : PointTimeForm::kWeekSeconds;
  const LevelReference reference = {.datum = "MLLW", .offset = -20};
  const absl::StatusOr<WaterLevelSeries> read = ParseWaterLevels(kName, std::string(text), reference);
  if (!read.ok()) return MustExplain(read.status(), kName);
  const absl::StatusOr<WaterLevelSeries> series = read->In(form);
  if (!series.ok()) return MustExplain(series.status(), kName);
  ALBTPU_MUST(series->size() >= 2);
  const double start = series->start(), end = series->end();
  ALBTPU_MUST(std::isfinite(start) && std::isfinite(end) && start < end);
  ALBTPU_MUST(series->At(start).has_value() && series->At(end).has_value());
  ALBTPU_MUST(!series->At(std::nextafter(end, INFINITY)).has_value());
  std::vector<double> times = {NAN, INFINITY, -INFINITY, 0, start, end, start - 1, end + 1};
  for (int i = 0; i <= 12; ++i) times.push_back(start + (end - start) * ((i * 5) % 13) / 12.0);
  for (int i = 0; i <= 6; ++i) times.push_back(start + 600.0 * i);
  std::vector<double> levels(times.size());
  series->LevelsAt(times, levels);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const std::optional<double> level = series->At(times[i]);
    ALBTPU_MUST(level.has_value() == !std::isnan(levels[i]));
    if (level.has_value()) ALBTPU_MUST(*level == levels[i] && std::abs(*level) <= 1.00021e5);
  }
}

}  // namespace

const std::vector<Target> kTargets = {{"ascii_trajectory", AsciiTrajectoryTarget},
                                      {"sbet", SbetTarget},
                                      {"smrmsg", SmrmsgTarget},
                                      {"water_level", WaterLevelTarget}};

}  // namespace albtpu::fuzz
