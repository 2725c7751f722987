#include "formats/trajectories/sbet_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "formats/text/text.h"
#include "formats/trajectories/ascii_motion.h"
#include "formats/trajectories/sbet_diagnosis.h"
#include "formats/trajectories/trajectory_sigmas.h"
#include "status/status_macros.h"

namespace albtpu::formats {
namespace {

static_assert(std::endian::native == std::endian::little, "records are read as they lie in the file");

constexpr double kLowestHeight = -1000, kMaxHeight = 20000;  // m; wider than any airborne survey.

SbetRecord WithBytesReversed(const SbetRecord& record) {
  auto words = std::bit_cast<std::array<std::uint64_t, 17>>(record);
  for (std::uint64_t& word : words) word = __builtin_bswap64(word);
  return std::bit_cast<SbetRecord>(words);
}

bool IsFinite(const SbetRecord& record) {
  // The sum of products with 0 is 0 if all are finite, NaN otherwise: one comparison instead of 17.
  const auto numbers = std::bit_cast<std::array<double, 17>>(record);
  double sum = 0;
  for (const double number : numbers) sum += number * 0;
  return sum == 0;
}

bool IsOnGlobe(const SbetRecord& record) {
  return std::abs(record.latitude) <= std::numbers::pi / 2 && std::abs(record.longitude) <= 2 * std::numbers::pi;
}

bool IsPlausible(const SbetRecord& record) {
  return IsFinite(record) && IsOnGlobe(record) && record.time >= 0 && record.height >= kLowestHeight &&
         record.height <= kMaxHeight && std::abs(record.roll) < std::numbers::pi / 2 &&
         std::abs(record.pitch) < std::numbers::pi / 2;
}

// Whether the first two records follow each other when their bytes are reversed. Reversed numbers are otherwise huge or
// next to zero.
bool IsBigEndian(std::span<const SbetRecord> records) {
  const SbetRecord first = WithBytesReversed(records[0]), second = WithBytesReversed(records[1]);
  const double step = second.time - first.time;
  return IsPlausible(first) && IsPlausible(second) && step > 1e-6 && step < 1;
}

// The problem of a record that is not plausible.
std::string Implausibility(const SbetRecord& record) {
  if (!IsFinite(record)) return "has a number that is not finite";
  if (record.time < 0) return absl::StrFormat("has the time %.6g s, which is negative", record.time);
  if (std::abs(record.latitude) > std::numbers::pi / 2)
    return absl::StrFormat("has the latitude %.9g rad, beyond pi/2", record.latitude);
  if (std::abs(record.longitude) > 2 * std::numbers::pi)
    return absl::StrFormat("has the longitude %.9g rad, beyond 2 pi", record.longitude);
  if (std::abs(record.roll) >= std::numbers::pi / 2)
    return absl::StrFormat("has the roll %.9g rad, beyond pi/2", record.roll);
  if (std::abs(record.pitch) >= std::numbers::pi / 2)
    return absl::StrFormat("has the pitch %.9g rad, beyond pi/2", record.pitch);
  return absl::StrFormat("has the height %.6g m, not between %.0f and %.0f", record.height, kLowestHeight, kMaxHeight);
}

}  // namespace

SbetFile::SbetFile(std::string name, MappedFile file)
    : Trajectory(std::move(name), "SBET"),
      file_(std::move(file)),
      // A mapping begins at a page, so the records are aligned.
      records_(reinterpret_cast<const SbetRecord*>(file_.bytes().data()), file_.bytes().size() / sizeof(SbetRecord)),
      next_week_(records_.size()) {}

TrajectoryRecord SbetFile::Record(std::size_t record) const {
  TrajectoryRecord result = TrajectoryRecordOf(records_[record], frame_);
  result.time = TimeAt(record);
  if (frame_ == VelocityFrame::kNone) DeriveVelocity(record, result);
  return result;
}

// From the difference of the positions around it, over half of kDerivation to either side where there is no gap. In a
// turn of 5 m/s^2 that lasts, v'' is 0.4 m/s^3 at 60 m/s, and the error v'' t^2 / 24 is below 1 mm/s.
void SbetFile::DeriveVelocity(std::size_t record, TrajectoryRecord& result) const {
  constexpr double kDerivation = 0.1;  // s; noise of 1 mm of the positions is 0.014 m/s then.
  const auto is_near = [&](std::size_t from, std::size_t to) { return TimeAt(to) - TimeAt(from) <= kLongestStep; };
  std::size_t first = record, last = record;
  while (first > 0 && TimeAt(record) - TimeAt(first) < kDerivation / 2 && is_near(first - 1, first)) --first;
  while (last + 1 < size() && TimeAt(last) - TimeAt(record) < kDerivation / 2 && is_near(last, last + 1)) ++last;
  if (first == last) return;  // Between two gaps: not stated.
  TrajectoryRecord before = TrajectoryRecordOf(records_[first]), after = TrajectoryRecordOf(records_[last]);
  before.time = TimeAt(first);
  after.time = TimeAt(last);
  const VelocityPair velocity = CompareVelocities(before, after);
  result.velocity_north = velocity.north;
  result.velocity_east = velocity.east;
  result.velocity_up = velocity.up;
}

absl::StatusOr<std::unique_ptr<SbetFile>> SbetFile::Open(const std::filesystem::path& path, VelocityAxes axes) {
  ASSIGN_OR_RETURN(MappedFile mapped, MappedFile::Open(path, "an SBET"));
  return Parse(path.string(), std::move(mapped), axes);
}

absl::StatusOr<std::unique_ptr<SbetFile>> SbetFile::Parse(const std::string& name, MappedFile mapped,
                                                          VelocityAxes axes) {
  const std::size_t bytes = mapped.bytes().size();
  if (bytes % sizeof(SbetRecord) != 0) {
    return InvalidFile(name,
                       absl::StrCat("has ", bytes, " bytes, which is not a multiple of ", sizeof(SbetRecord),
                                    ", the size of an SBET record (",
                                    bytes > 0 && bytes % SmrmsgFile::kRecordSize == 0
                                        ? "its size fits an SMRMSG, an error file); give the SBET here, and "
                                          "error files by --trajectory-errors, or a complete copy if it was cut short"
                                        : "cut short, or another format); get a complete copy of the SBET"));
  }
  if (bytes < 2 * sizeof(SbetRecord)) {
    return InvalidFile(name, absl::StrCat("has ", bytes / sizeof(SbetRecord), bytes == 0 ? " records" : " record",
                                          ", but a trajectory needs 2 or more; get a complete copy of the SBET"));
  }
  std::unique_ptr<SbetFile> file(new SbetFile(name, std::move(mapped)));
  RETURN_IF_ERROR(file->CheckRecords(axes));
  return file;
}

namespace {

// s, up to which a difference of positions is compared with velocities of a file that is slower than kLongestStep
// throughout, to recognize their axes: a vessel's.
constexpr double kSlowStep = 1 + 1e-6;

}  // namespace

absl::Status SbetFile::CheckRecords(VelocityAxes axes) {
  std::vector<SbetPair> pairs;
  for (std::size_t i = 0; i < records_.size(); ++i) {
    const SbetRecord& record = records_[i];
    if (!IsPlausible(record)) {
      std::string cause;
      if (IsBigEndian(records_)) {
        cause = " (its numbers are big-endian); convert it to little-endian";
      } else if (i + 1 < records_.size() && IsFinite(record)) {
        for (const RecordPair& pair : SpreadPairs(*this))
          pairs.push_back({records_[pair.first], records_[pair.second]});
        const std::optional<std::string> found = VelocityCause(pairs);
        if (found.has_value()) cause = absl::StrCat(" (", *found, "); correct the fields");
      }
      if (cause.empty()) cause = " (a damaged file, or another format); get a sound copy of the SBET";
      return InvalidFile(name(),
                         absl::StrCat("record ", i + 1, " of ", records_.size(), " ", Implausibility(record), cause));
    }
    if (i == 0 || TimeAt(i) > TimeAt(i - 1)) continue;
    if (next_week_ == records_.size() && StartsNextWeek(records_[i - 1].time, record.time)) {
      next_week_ = i;
      continue;
    }
    return InvalidFile(name(),
                       absl::StrFormat("record %d of %d is at %.6f s, not after the one before it (%.6f s); times must "
                                       "increase: sort and merge the SBET again, or give its parts as separate files",
                                       i + 1, records_.size(), record.time, records_[i - 1].time));
  }
  const auto add = [&](double longest_step) {
    for (const RecordPair& pair : SpreadPairs(*this, longest_step)) {
      pairs.push_back({records_[pair.first], records_[pair.second]});
      pairs.back().second.time = TimeAt(pair.second);
      pairs.back().first.time = TimeAt(pair.first);
    }
  };
  add(kLongestStep);
  const bool is_slow = pairs.empty();
  if (is_slow) add(kSlowStep);
  const FoundFrame found = FindVelocityFrame(pairs, axes);
  frame_ = found.frame;
  if (!found.remark.empty()) set_remark(absl::StrCat(name(), ": ", found.remark));
  if (!is_slow) RETURN_IF_ERROR(CheckSbetMotion(name(), pairs, frame_));
  return CheckJumps(*this, [this](std::size_t i) {
    const SbetRecord& record = records_[i];
    return TrajectoryRecord{
        .time = TimeAt(i), .latitude = record.latitude, .longitude = record.longitude, .height = record.height};
  });
}

namespace {

constexpr double kArcMinute = std::numbers::pi / (180 * 60);  // rad; exact definition

struct Field {
  const char* name;
  const char* unit;
  double largest;  // Beyond it, the file has another format: no navigation system states such a large sigma.
};

constexpr std::array<Field, 10> kFields = {{{"time", "s", 1e10},
                                            {"sigma north", "m", 10000},
                                            {"sigma east", "m", 10000},
                                            {"sigma down", "m", 10000},
                                            {"sigma of the velocity north", "m/s", 1000},
                                            {"sigma of the velocity east", "m/s", 1000},
                                            {"sigma of the velocity down", "m/s", 1000},
                                            {"sigma of roll", "arc-minutes", 180 * 60},
                                            {"sigma of pitch", "arc-minutes", 180 * 60},
                                            {"sigma of heading", "arc-minutes", 180 * 60}}};

double Load(std::string_view bytes, std::size_t record, std::size_t field) {
  double number;
  std::memcpy(&number, bytes.data() + record * SmrmsgFile::kRecordSize + field * sizeof number, sizeof number);
  return number;
}

bool IsPlausible(double value, const Field& field) { return value >= 0 && value <= field.largest; }

}  // namespace

absl::StatusOr<SmrmsgFile> SmrmsgFile::Open(const std::filesystem::path& path) {
  ASSIGN_OR_RETURN(MappedFile mapped, MappedFile::Open(path, "an SMRMSG"));
  absl::StatusOr<SmrmsgFile> file = Parse(path.string(), mapped.bytes());
  if (file.ok()) file->file_ = std::move(mapped);  // The bytes stay where they are.
  return file;
}

absl::StatusOr<SmrmsgFile> SmrmsgFile::Parse(std::string name, std::string_view bytes) {
  SmrmsgFile file(std::move(name), bytes);
  RETURN_IF_ERROR(file.Check());
  return file;
}

bool SmrmsgFile::Recognizes(std::string_view bytes) {
  const std::size_t records = std::min<std::size_t>(bytes.size() / kRecordSize, 8);
  for (std::size_t record = 0; record < records; ++record) {
    for (std::size_t field = 0; field < kFields.size(); ++field)
      if (!IsPlausible(Load(bytes, record, field), kFields[field])) return false;
    if (record == 0) continue;
    const double before = Load(bytes, record - 1, 0), time = Load(bytes, record, 0);
    if (time <= before && !StartsNextWeek(before, time)) return false;
  }
  return records > 0;
}

double SmrmsgFile::Number(std::size_t record, std::size_t field) const { return Load(bytes_, record, field); }

absl::Status SmrmsgFile::CheckSigmas(std::size_t record) const {
  for (std::size_t field = 0; field < kFields.size(); ++field) {
    const double value = Number(record, field);
    if (IsPlausible(value, kFields[field])) continue;
    const bool is_number = std::isfinite(value);
    return absl::InvalidArgumentError(absl::StrCat(
        name_, " record ", record + 1, ", ", kFields[field].name, ": ",
        is_number ? absl::StrCat(value, " ", kFields[field].unit, " is ", value < 0 ? "negative" : "implausibly large")
                  : "not a finite number",
        "; give an SMRMSG, records of 10 little-endian doubles"));
  }
  return absl::OkStatus();
}

absl::Status SmrmsgFile::Check() {
  if (bytes_.empty()) return absl::InvalidArgumentError(absl::StrCat(name_, ": is empty; give an SMRMSG"));
  if (bytes_.size() % kRecordSize != 0) {
    return absl::InvalidArgumentError(absl::StrCat(
        name_, ": ", bytes_.size(), " bytes are not a multiple of ", kRecordSize, ", the size of an SMRMSG record (",
        bytes_.size() % sizeof(SbetRecord) == 0
            ? "its size fits an SBET, a trajectory); give the SMRMSG here, and trajectories by "
              "--trajectory"
            : "cut short, or another format); get a complete copy of the SMRMSG"));
  }
  for (std::size_t record = 0; record < size(); ++record) {
    if (const absl::Status status = CheckSigmas(record); !status.ok()) return status;
    if (record == 0) continue;
    const double before = Number(record - 1, 0), time = Number(record, 0);
    if (next_week_ == 0 && StartsNextWeek(before, time)) next_week_ = record;
    if (TimeAt(record) > TimeAt(record - 1)) continue;
    return absl::InvalidArgumentError(
        absl::StrFormat("%s record %d: time %.6f s follows %.6f s: times must increase; give an SMRMSG as it was "
                        "exported",
                        name_, record + 1, time, before));
  }
  SigmaColumns columns = {.angle = "arc minutes",
                          .radians = kArcMinute,
                          .if_unknown =
                              "leave the file out, and the errors of a good trajectory are taken, or state "
                              "them by [sigma] of a survey file"};
  for (std::size_t field = 0; field < columns.names.size(); ++field) columns.names[field] = kFields[field + 1].name;
  return CheckSigmaUnits(name_, columns, size(), [this](std::size_t record) { return SigmaOf(record); });
}

double SmrmsgFile::TimeAt(std::size_t record) const {
  return Number(record, 0) + (next_week_ > 0 && record >= next_week_ ? kSecondsPerWeek : 0);
}

TrajectorySigma SmrmsgFile::SigmaOf(std::size_t record) const {
  TrajectorySigma sigma;
  for (std::size_t i = 0; i < kSigmaFields.size(); ++i) {
    const bool is_angle = i >= 6;
    sigma.*kSigmaFields[i] = Number(record, i + 1) * (is_angle ? kArcMinute : 1);
  }
  return sigma;
}

std::optional<TrajectorySigma> SmrmsgFile::SigmaAt(double time) const {
  const std::size_t next = FirstRecordFrom(0, size(), time, [this](std::size_t i) { return TimeAt(i); });
  if (next == size()) return std::nullopt;
  const double after = TimeAt(next);
  if (after == time) return SigmaOf(next);
  if (next == 0) return std::nullopt;
  const double before = TimeAt(next - 1);
  if (!(after - before <= kLongestGap)) return std::nullopt;
  const double weight = (time - before) / (after - before);
  TrajectorySigma sigma = SigmaOf(next - 1);
  const TrajectorySigma second = SigmaOf(next);
  for (double TrajectorySigma::*const field : kSigmaFields) sigma.*field += weight * (second.*field - sigma.*field);
  return sigma;
}

}  // namespace albtpu::formats
