#include "formats/las/las_points.h"

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>
#include <numeric>
#include <span>
#include <utility>

#include "absl/strings/str_cat.h"
#include "status/status_macros.h"

namespace albtpu::formats {

PointTimes PointTimesOf(const LasHeader& header, const TimeSpan& span, std::uint64_t count) {
  return {.span = span,
          .form = header.adjusted_gps_time ? PointTimeForm::kAdjustedStandard : PointTimeForm::kWeekSeconds,
          .created = GpsTimeOfDay(header.creation_year, header.creation_day),
          .count = count};
}

void LasClassCounts::Merge(const LasClassCounts& other) {
  for (std::size_t i = 0; i < counts_.size(); ++i) counts_[i] += other.counts_[i];
}

std::uint64_t LasClassCounts::points() const {
  return std::accumulate(counts_.begin(), counts_.end(), std::uint64_t{0});
}

std::string LasClassCounts::Text() const {
  std::string text;
  for (int i = 0; i < kClassCount; ++i) {
    if (counts_[i] == 0) continue;
    absl::StrAppend(&text, text.empty() ? "" : ", ", "class ", i, ": ", counts_[i], " points");
  }
  return text;
}

nlohmann::ordered_json LasClassCounts::Json() const {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (int i = 0; i < kClassCount; ++i)
    if (counts_[i] > 0) json[std::to_string(i)] = counts_[i];
  return json;
}

absl::StatusOr<LasPointRuns> LasPointRuns::Open(const LasReader& reader, std::size_t before, std::size_t after,
                                                laz::WantedFields wanted) {
  LasPointRuns runs(reader, before, after);
  if (reader.kind() == LasKind::kLas) return runs;
  absl::StatusOr<std::unique_ptr<laz::LazPoints>> laz =
      laz::LazPoints::Open(reader.bytes(), reader.extent(), 0, wanted);
  if (!laz.ok()) return reader.Named(laz.status());
  runs.laz_ = *std::move(laz);
  return runs;
}

absl::StatusOr<bool> LasPointRuns::Next(std::uint64_t most, LasRun& run) {
  const LasHeader& header = reader_.header();
  const std::uint64_t left = header.point_count - next_;
  if (left == 0) return false;
  run.first = next_;
  run.own = std::min(most, left);
  run.before = std::min<std::uint64_t>(before_, next_);
  const std::uint64_t begin = next_ - run.before;
  const std::uint64_t end = next_ + run.own + std::min<std::uint64_t>(after_, left - run.own);
  run.records.resize((end - begin) * header.record_length);
  next_ += run.own;
  RETURN_IF_ERROR(laz_ != nullptr ? ReadLaz(begin, end, run)
                                  : reader_.ReadAt(header.offset_to_points + begin * header.record_length,
                                                   std::span<char>(run.records)));
  return true;
}

absl::Status LasPointRuns::ReadLaz(std::uint64_t begin, std::uint64_t end, LasRun& run) {
  const std::size_t length = reader_.header().record_length;
  // `last_` begins at `begin` and ends at the last decoded point.
  std::memcpy(run.records.data(), last_.data(), last_.size());
  const absl::Status status = laz_->Read(std::span<char>(run.records).subspan(last_.size()));
  if (!status.ok()) return reader_.Named(status);
  const std::uint64_t next_begin = next_ - std::min<std::uint64_t>(before_, next_);
  last_.assign(run.records, (next_begin - begin) * length, (end - next_begin) * length);
  return status;
}

absl::StatusOr<std::string> LasPointRuns::ReadChunk(const LasRun& run) const {
  if (laz_ == nullptr) return "";
  absl::StatusOr<std::string> chunk = laz_->ReadChunk(run.first, run.own);
  return chunk.ok() ? std::move(chunk) : reader_.Named(chunk.status());
}

std::uint64_t LasPointRuns::tail_begin() const {
  return laz_ != nullptr ? laz_->end() : reader_.header().end_of_points();
}

std::uint64_t LasPointRuns::tail_end() const { return laz_ != nullptr ? laz_->tail_end() : reader_.file_size(); }

absl::StatusOr<std::string> FirstRecord(const LasReader& reader) {
  const LasHeader& header = reader.header();
  if (reader.kind() == LasKind::kLas) return reader.ReadAt(header.offset_to_points, header.record_length);
  absl::StatusOr<std::string> record = laz::LazPoints::First(reader.bytes(), reader.extent());
  return record.ok() ? std::move(record) : reader.Named(record.status());
}

}  // namespace albtpu::formats
