#include "formats/trajectories/sbet_file.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "formats/trajectories/sbet_diagnosis.h"
#include "formats/trajectories/smrmsg_file.h"
#include "formats/trajectories/velocity_check.h"

namespace albtpu::formats {
namespace {

static_assert(std::endian::native == std::endian::little, "records are read as they lie in the file");

constexpr double kPi = std::numbers::pi;
constexpr double kLowestHeight = -1000, kMaxHeight = 20000;  // m; wider than any airborne survey.

absl::Status Invalid(const std::string& name, const std::string& message) {
  return absl::InvalidArgumentError(absl::StrCat(name, ": ", message));
}

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
  return std::abs(record.latitude) <= kPi / 2 && std::abs(record.longitude) <= 2 * kPi;
}

bool IsPlausible(const SbetRecord& record) {
  return IsFinite(record) && IsOnGlobe(record) && record.time >= 0 && record.height >= kLowestHeight &&
         record.height <= kMaxHeight && std::abs(record.roll) < kPi / 2 && std::abs(record.pitch) < kPi / 2;
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
  if (std::abs(record.latitude) > kPi / 2) {
    return absl::StrFormat("has the latitude %.9g rad, beyond pi/2", record.latitude);
  }
  if (std::abs(record.longitude) > 2 * kPi) {
    return absl::StrFormat("has the longitude %.9g rad, beyond 2 pi", record.longitude);
  }
  if (std::abs(record.roll) >= kPi / 2)
    return absl::StrFormat("has the roll %.9g rad, beyond pi/2", record.roll);
  if (std::abs(record.pitch) >= kPi / 2) {
    return absl::StrFormat("has the pitch %.9g rad, beyond pi/2", record.pitch);
  }
  return absl::StrFormat("has the height %.6g m, not between %.0f and %.0f", record.height, kLowestHeight,
                         kMaxHeight);
}

}  // namespace

SbetFile::SbetFile(std::string name, MappedFile file)
    : Trajectory(std::move(name)),
      file_(std::move(file)),
      // A mapping begins at a page, so the records are aligned.
      records_(reinterpret_cast<const SbetRecord*>(file_.bytes().data()),
               file_.bytes().size() / sizeof(SbetRecord)),
      next_week_(records_.size()) {}

TrajectoryRecord SbetFile::Record(std::size_t record) const {
  TrajectoryRecord result = TrajectoryRecordOf(records_[record]);
  result.time = TimeAt(record);
  return result;
}

absl::StatusOr<std::unique_ptr<SbetFile>> SbetFile::Open(const std::filesystem::path& path) {
  absl::StatusOr<MappedFile> mapped = MappedFile::Open(path, "an SBET");
  if (!mapped.ok()) return mapped.status();
  return Parse(path.string(), *std::move(mapped));
}

absl::StatusOr<std::unique_ptr<SbetFile>> SbetFile::Parse(const std::string& name, MappedFile mapped) {
  const std::size_t bytes = mapped.bytes().size();
  if (bytes % sizeof(SbetRecord) != 0) {
    return Invalid(
        name, absl::StrCat("has ", bytes, " bytes, which is not a multiple of ", sizeof(SbetRecord),
                           ", the size of an SBET record (",
                           bytes > 0 && bytes % SmrmsgFile::kRecordSize == 0
                               ? "its size fits an SMRMSG, an error file); give the SBET here, and "
                                 "error files by --trajectory-errors, or a complete copy if it was cut short"
                               : "cut short, or another format); get a complete copy of the SBET"));
  }
  if (bytes < 2 * sizeof(SbetRecord)) {
    return Invalid(name, absl::StrCat("has ", bytes / sizeof(SbetRecord), bytes == 0 ? " records" : " record",
                                      ", but a trajectory needs 2 or more; get a complete copy of the SBET"));
  }
  std::unique_ptr<SbetFile> file(new SbetFile(name, std::move(mapped)));
  if (absl::Status status = file->CheckRecords(); !status.ok()) return status;
  return file;
}

absl::Status SbetFile::CheckRecords() {
  std::vector<SbetPair> pairs;
  for (std::size_t i = 0; i < records_.size(); ++i) {
    const SbetRecord& record = records_[i];
    if (!IsPlausible(record)) {
      std::string cause;
      if (IsBigEndian(records_)) {
        cause = " (its numbers are big-endian); convert it to little-endian";
      } else if (i + 1 < records_.size() && IsFinite(record)) {
        for (const RecordPair& pair : SpreadPairs(*this)) {
          pairs.push_back({records_[pair.first], records_[pair.second]});
        }
        const std::optional<std::string> found = VelocityCause(pairs);
        if (found.has_value()) cause = absl::StrCat(" (", *found, "); correct the fields");
      }
      if (cause.empty()) cause = " (a damaged file, or another format); get a sound copy of the SBET";
      return Invalid(name(), absl::StrCat("record ", i + 1, " of ", records_.size(), " ",
                                          Implausibility(record), cause));
    }
    if (i == 0 || TimeAt(i) > TimeAt(i - 1)) continue;
    if (next_week_ == records_.size() && StartsNextWeek(records_[i - 1].time, record.time)) {
      next_week_ = i;
      continue;
    }
    return Invalid(
        name(),
        absl::StrFormat("record %d of %d is at %.6f s, not after the one before it (%.6f s); times must "
                        "increase: sort and merge the SBET again, or give its parts as separate files",
                        i + 1, records_.size(), record.time, records_[i - 1].time));
  }
  for (const RecordPair& pair : SpreadPairs(*this)) {
    pairs.push_back({records_[pair.first], records_[pair.second]});
    pairs.back().second.time = TimeAt(pair.second);
    pairs.back().first.time = TimeAt(pair.first);
  }
  return CheckSbetMotion(name(), pairs);
}

}  // namespace albtpu::formats
