#include "service/client/las_annotation.h"

#include <algorithm>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "service/client/las_crs.h"
#include "service/client/las_extra_bytes.h"
#include "service/client/las_reader.h"
#include "service/client/las_writer.h"
#include "service/client/progress.h"

namespace albtpu::client {
namespace {

// What is held at a time: so many bytes of records, and no more records than a server takes pulses in a
// message.
constexpr std::size_t kChunkBytes = 8 << 20;
constexpr std::size_t kChunkRecords = 65536;

absl::Status CheckUnits(const LasReader& reader, const LasAnnotation& annotation) {
  if (annotation.unit_is_given) return absl::OkStatus();
  const absl::StatusOr<std::optional<std::string>> feet = FindFeet(reader);
  if (!feet.ok()) return feet.status();
  if (!feet->has_value()) return absl::OkStatus();
  return absl::FailedPreconditionError(
      absl::StrCat(reader.name(), ": its coordinate system is in feet (", **feet,
                   "): say what unit its heights and --water-level have, by --units m, ft or us-ft"));
}

class Annotator {
 public:
  Annotator(const LasReader& reader, const LasAnnotation& annotation, UncertaintySource& source)
      : fields_(reader.header()),
        record_length_(reader.header().record_length),
        annotation_(annotation),
        source_(source),
        summary_(annotation.style) {}

  // The records with their values behind each.
  absl::StatusOr<std::string> operator()(std::string_view records) {
    const std::size_t count = records.size() / record_length_;
    pulses_.clear();
    for (std::size_t i = 0; i < count; ++i) {
      const std::string_view record = Record(records, i);
      const int point_class = fields_.Class(record);
      summary_.AddPoint(point_class);
      if (annotation_.classes.count(point_class) == 0) continue;
      pulses_.push_back(annotation_.flight_line.At(fields_.Z(record), fields_.ScanAngle(record)));
    }
    answers_.resize(pulses_.size());
    if (absl::Status status = source_.Answer(pulses_, answers_); !status.ok()) return status;

    std::string annotated;
    annotated.reserve(records.size() + count * kAppendedBytes);
    std::size_t answered = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const std::string_view record = Record(records, i);
      float thu = kNoUncertainty, tvu = kNoUncertainty;
      if (annotation_.classes.count(fields_.Class(record)) > 0) {
        const PulseUncertainty stated = WithCoverage(answers_[answered], annotation_.style.coverage);
        summary_.AddPulse(pulses_[answered], answers_[answered], stated);
        ++answered;
        if (stated.outcome == Outcome::kInterpolated) {
          thu = stated[Quantity::kThu];
          tvu = stated[Quantity::kTvu];
        }
      }
      AppendRecord(record, thu, tvu, annotated);
    }
    return annotated;
  }

  const LasSummary& summary() const { return summary_; }

 private:
  std::string_view Record(std::string_view records, std::size_t i) const {
    return records.substr(i * record_length_, record_length_);
  }

  LasPointFields fields_;
  std::size_t record_length_;
  const LasAnnotation& annotation_;
  UncertaintySource& source_;
  LasSummary summary_;
  std::vector<Pulse> pulses_;
  std::vector<PulseUncertainty> answers_;
};

}  // namespace

absl::StatusOr<AnnotatedLas> AnnotateLas(const std::filesystem::path& input,
                                         const std::filesystem::path& output, Existing existing,
                                         const LasAnnotation& annotation, UncertaintySource& source) {
  if (absl::Status status = CheckNotTheSameFile(input, output); !status.ok()) return status;
  const absl::StatusOr<LasReader> reader = LasReader::Open(input);
  if (!reader.ok()) return reader.status();
  if (absl::Status status = CheckUnits(*reader, annotation); !status.ok()) return status;
  const absl::StatusOr<std::string> head = AnnotatedHead(*reader, annotation.style.coverage);
  if (!head.ok()) return head.status();
  absl::StatusOr<OutputFile> file = OutputFile::Create(output, existing);
  if (!file.ok()) return file.status();
  if (absl::Status status = file->Write(*head); !status.ok()) return status;

  const LasHeader& header = reader->header();
  const std::uint64_t chunk = std::clamp<std::uint64_t>(kChunkBytes / header.record_length, 1, kChunkRecords);
  Annotator annotator(*reader, annotation, source);
  Progress progress(input.filename().string(), header.point_count);
  for (std::uint64_t done = 0; done < header.point_count;) {
    const std::uint64_t count = std::min(chunk, header.point_count - done);
    const absl::StatusOr<std::string> records =
        reader->ReadAt(header.offset_to_points + done * header.record_length, count * header.record_length);
    if (!records.ok()) return records.status();
    const absl::StatusOr<std::string> annotated = annotator(*records);
    if (!annotated.ok()) return annotated.status();
    if (absl::Status status = file->Write(*annotated); !status.ok()) return status;
    done += count;
    progress.Reach(done);
  }
  if (absl::Status status = CopyTail(*reader, *file); !status.ok()) return status;
  return AnnotatedLas{header.point_format, annotator.summary(), *std::move(file)};
}

}  // namespace albtpu::client
