#include "formats/trajectories/smrmsg_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <numbers>
#include <utility>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "formats/trajectories/gps_time.h"
#include "formats/trajectories/sbet_record.h"

namespace albtpu::formats {
namespace {

static_assert(std::endian::native == std::endian::little, "records are read as they lie in memory");

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
  std::memcpy(&number, bytes.data() + record * SmrmsgFile::kRecordSize + field * sizeof number,
              sizeof number);
  return number;
}

bool IsPlausible(double value, const Field& field) { return value >= 0 && value <= field.largest; }

double Blend(double a, double b, double weight) { return a + weight * (b - a); }

}  // namespace

absl::StatusOr<SmrmsgFile> SmrmsgFile::Open(const std::filesystem::path& path) {
  absl::StatusOr<MappedFile> mapped = MappedFile::Open(path, "an SMRMSG");
  if (!mapped.ok()) return mapped.status();
  absl::StatusOr<SmrmsgFile> file = Parse(path.string(), mapped->bytes());
  if (file.ok()) file->file_ = *std::move(mapped);  // The bytes stay where they are.
  return file;
}

absl::StatusOr<SmrmsgFile> SmrmsgFile::Parse(std::string name, std::string_view bytes) {
  SmrmsgFile file(std::move(name), bytes);
  const absl::Status status = file.Check();
  if (!status.ok()) return status;
  return file;
}

bool SmrmsgFile::Recognizes(std::string_view bytes) {
  const std::size_t records = std::min<std::size_t>(bytes.size() / kRecordSize, 8);
  for (std::size_t record = 0; record < records; ++record) {
    for (std::size_t field = 0; field < kFields.size(); ++field) {
      if (!IsPlausible(Load(bytes, record, field), kFields[field])) return false;
    }
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
    return absl::InvalidArgumentError(
        absl::StrCat(name_, " record ", record + 1, ", ", kFields[field].name, ": ",
                     is_number ? absl::StrCat(value, " ", kFields[field].unit, " is ",
                                              value < 0 ? "negative" : "implausibly large")
                               : "not a finite number",
                     "; give an SMRMSG, records of 10 little-endian doubles"));
  }
  return absl::OkStatus();
}

absl::Status SmrmsgFile::Check() {
  if (bytes_.empty()) {
    return absl::InvalidArgumentError(absl::StrCat(name_, ": is empty; give an SMRMSG"));
  }
  if (bytes_.size() % kRecordSize != 0) {
    return absl::InvalidArgumentError(
        absl::StrCat(name_, ": ", bytes_.size(), " bytes are not a multiple of ", kRecordSize,
                     ", the size of an SMRMSG record (",
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
    return absl::InvalidArgumentError(absl::StrFormat(
        "%s record %d: time %.6f s follows %.6f s: times must increase; give an SMRMSG as it was "
        "exported",
        name_, record + 1, time, before));
  }
  return absl::OkStatus();
}

double SmrmsgFile::TimeAt(std::size_t record) const {
  return Number(record, 0) + (next_week_ > 0 && record >= next_week_ ? kSecondsPerWeek : 0);
}

TrajectorySigma SmrmsgFile::SigmaOf(std::size_t record) const {
  return {.north = Number(record, 1),
          .east = Number(record, 2),
          .down = Number(record, 3),
          .velocity_north = Number(record, 4),
          .velocity_east = Number(record, 5),
          .velocity_down = Number(record, 6),
          .roll = Number(record, 7) * kArcMinute,
          .pitch = Number(record, 8) * kArcMinute,
          .heading = Number(record, 9) * kArcMinute};
}

std::optional<TrajectorySigma> SmrmsgFile::SigmaAt(double time) const {
  // The first record at or after `time`.
  std::size_t begin = 0, end = size();
  while (begin < end) {
    const std::size_t middle = begin + (end - begin) / 2;
    if (TimeAt(middle) < time) {
      begin = middle + 1;
    } else {
      end = middle;
    }
  }
  if (begin == size()) return std::nullopt;
  const double after = TimeAt(begin);
  if (after == time) return SigmaOf(begin);
  if (begin == 0) return std::nullopt;
  const double before = TimeAt(begin - 1);
  if (!(after - before <= kLongestGap)) return std::nullopt;
  const double weight = (time - before) / (after - before);
  const TrajectorySigma a = SigmaOf(begin - 1), b = SigmaOf(begin);
  return TrajectorySigma{.north = Blend(a.north, b.north, weight),
                         .east = Blend(a.east, b.east, weight),
                         .down = Blend(a.down, b.down, weight),
                         .velocity_north = Blend(a.velocity_north, b.velocity_north, weight),
                         .velocity_east = Blend(a.velocity_east, b.velocity_east, weight),
                         .velocity_down = Blend(a.velocity_down, b.velocity_down, weight),
                         .roll = Blend(a.roll, b.roll, weight),
                         .pitch = Blend(a.pitch, b.pitch, weight),
                         .heading = Blend(a.heading, b.heading, weight)};
}

}  // namespace albtpu::formats
