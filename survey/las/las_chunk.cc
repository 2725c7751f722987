#include "survey/las/las_chunk.h"

#include <cstring>

#include "survey/las/las_extra_bytes.h"
#include "survey/las/little_endian.h"

namespace albtpu::client {

LasChunkWork::LasChunkWork(const LasHeader& header, const LasAnnotation& annotation,
                           UncertaintySource& source)
    : fields_(header),
      record_length_(header.record_length),
      flight_line_(annotation.flight_line),
      style_(annotation.style),
      source_(source) {
  UncertaintySummary::Select(selection_);
  selection_.standard_errors = style_.standard_errors;
  for (const int point_class : annotation.classes) is_bathymetric_[point_class] = true;
}

absl::Status LasChunkWork::operator()(Chunk& chunk) const {
  Decode(chunk);
  const AnswerColumns answers = chunk.answers.Resize(chunk.pulses.size, selection_);
  if (absl::Status status = source_.Answer(style_.query(), chunk.pulses.columns(), answers); !status.ok()) {
    return status;
  }
  chunk.summary = UncertaintySummary(style_);
  chunk.summary.Add(chunk.pulses, chunk.answers);
  Encode(chunk);
  return absl::OkStatus();
}

void LasChunkWork::Decode(Chunk& chunk) const {
  const std::size_t count = chunk.records.size() / record_length_;
  chunk.classes = {};
  chunk.bathymetric.resize(count);
  chunk.z.resize(count);
  chunk.scan_angles.resize(count);
  std::size_t found = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::string_view record(chunk.records.data() + i * record_length_, record_length_);
    const int point_class = fields_.Class(record);
    chunk.classes.Add(point_class);
    // Avoids a branch: every point is written, and the next one overwrites it unless it is bathymetric.
    chunk.bathymetric[found] = static_cast<std::uint32_t>(i);
    chunk.z[found] = fields_.Z(record);
    chunk.scan_angles[found] = fields_.ScanAngle(record);
    found += is_bathymetric_[point_class];
  }
  chunk.bathymetric.resize(found);
  chunk.z.resize(found);
  chunk.scan_angles.resize(found);
  flight_line_.MakePulses(chunk.z, chunk.scan_angles, chunk.pulses);
}

void LasChunkWork::Encode(Chunk& chunk) const {
  const std::size_t count = chunk.records.size() / record_length_;
  const std::size_t annotated_length = record_length_ + kAppendedBytes;
  chunk.annotated.resize(count * annotated_length);
  char* const annotated = chunk.annotated.data();
  const float no_data[] = {kNoUncertainty, kNoUncertainty};
  for (std::size_t i = 0; i < count; ++i) {
    char* const record = annotated + i * annotated_length;
    std::memcpy(record, chunk.records.data() + i * record_length_, record_length_);
    std::memcpy(record + record_length_, no_data, sizeof no_data);
  }
  for (std::size_t i = 0; i < chunk.bathymetric.size(); ++i) {
    if (!chunk.answers.interpolated(i)) continue;
    char* const values = annotated + chunk.bathymetric[i] * annotated_length + record_length_;
    Store(chunk.answers[Quantity::kThu][i], values);
    Store(chunk.answers[Quantity::kTvu][i], values + sizeof(float));
  }
}

}  // namespace albtpu::client
