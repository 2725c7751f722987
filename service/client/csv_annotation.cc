#include "service/client/csv_annotation.h"

#include <string>
#include <system_error>
#include <vector>

#include "absl/strings/str_cat.h"
#include "service/client/csv_reader.h"
#include "service/client/number_text.h"
#include "service/client/output_file.h"
#include "service/client/progress.h"

namespace albtpu::client {
namespace {

// Records held at a time; also the pulses of one question, so that a server gets whole messages.
constexpr std::size_t kChunk = 65536;

std::string Text(const AnswerCell& cell) {
  if (const float* number = std::get_if<float>(&cell)) return FormatFloat(*number);
  if (const std::string* text = std::get_if<std::string>(&cell)) return *text;
  return "";
}

// Repeats records with cells behind them.
class CsvWriter {
 public:
  CsvWriter(OutputFile& output, std::string default_line_ending)
      : output_(output), default_line_ending_(std::move(default_line_ending)) {}

  absl::Status Repeat(const CsvRecord& record) { return output_.Write(record.text + Ending(record)); }

  template <typename Cells>
  absl::Status Append(const CsvRecord& record, const Cells& cells) {
    line_ = record.text;
    for (const auto& cell : cells) absl::StrAppend(&line_, ",", Text(cell));
    line_ += Ending(record);
    return output_.Write(line_);
  }

 private:
  const std::string& Ending(const CsvRecord& record) const {
    return record.line_ending.empty() ? default_line_ending_ : record.line_ending;
  }

  OutputFile& output_;
  std::string default_line_ending_;
  std::string line_;
};

class Annotator {
 public:
  Annotator(CsvReader& reader, const CsvPulses& columns, const AnswerColumns& answer_columns,
            CsvWriter& writer, UncertaintySource& source)
      : reader_(reader),
        columns_(columns),
        answer_columns_(answer_columns),
        writer_(writer),
        source_(source) {}

  // One chunk of records; false when there are no more.
  absl::StatusOr<bool> Step() {
    if (records_.empty()) records_.resize(kChunk);
    pulses_.clear();
    std::size_t count = 0;
    for (; count < kChunk; ++count) {
      const absl::StatusOr<bool> more = reader_.Read(records_[count]);
      if (!more.ok()) return more.status();
      if (!*more) break;
      if (records_[count].blank()) continue;
      const absl::StatusOr<Pulse> pulse = columns_.Read(records_[count]);
      if (!pulse.ok()) return pulse.status();
      pulses_.push_back(*pulse);
    }
    answers_.resize(pulses_.size());
    if (absl::Status status = source_.Answer(pulses_, answers_); !status.ok()) return status;
    if (absl::Status status = Write(count); !status.ok()) return status;
    return count == kChunk;
  }

  const OutcomeCounts& counts() const { return counts_; }

 private:
  absl::Status Write(std::size_t record_count) {
    std::size_t answered = 0;
    for (std::size_t i = 0; i < record_count; ++i) {
      absl::Status written;
      if (records_[i].blank()) {
        written = writer_.Repeat(records_[i]);
      } else {
        counts_.Add(answers_[answered]);
        written = writer_.Append(records_[i], answer_columns_.Cells(pulses_[answered], answers_[answered]));
        ++answered;
      }
      if (!written.ok()) return written;
    }
    return absl::OkStatus();
  }

  CsvReader& reader_;
  const CsvPulses& columns_;
  const AnswerColumns& answer_columns_;
  CsvWriter& writer_;
  UncertaintySource& source_;
  std::vector<CsvRecord> records_;
  std::vector<Pulse> pulses_;
  std::vector<PulseUncertainty> answers_;
  OutcomeCounts counts_;
};

std::uint64_t SizeOf(const std::filesystem::path& path) {
  std::error_code unknown;
  const std::uintmax_t size = std::filesystem::file_size(path, unknown);
  return unknown ? 0 : size;
}

}  // namespace

absl::StatusOr<OutcomeCounts> AnnotateCsv(const std::filesystem::path& input,
                                          const std::filesystem::path& output, Existing existing,
                                          const FixedCoordinates& fixed, AnswerStyle style,
                                          UncertaintySource& source) {
  if (absl::Status status = CheckNotTheSameFile(input, output); !status.ok()) return status;
  absl::StatusOr<CsvReader> reader = CsvReader::Open(input);
  if (!reader.ok()) return reader.status();
  CsvRecord header;
  const absl::StatusOr<bool> has_header = reader->Read(header);
  if (!has_header.ok()) return has_header.status();
  if (!*has_header || header.blank()) {
    return absl::InvalidArgumentError(
        absl::StrCat(input.string(), " line 1: is empty: a header that names the columns is right"));
  }
  const AnswerColumns answer_columns(style);
  const absl::StatusOr<CsvPulses> columns =
      CsvPulses::Bind(input.string(), header, fixed, answer_columns.names());
  if (!columns.ok()) return columns.status();
  absl::StatusOr<OutputFile> file = OutputFile::Create(output, existing);
  if (!file.ok()) return file.status();

  CsvWriter writer(*file, header.line_ending.empty() ? "\n" : header.line_ending);
  if (absl::Status status = writer.Append(header, answer_columns.names()); !status.ok()) return status;
  Annotator annotator(*reader, *columns, answer_columns, writer, source);
  Progress progress(input.filename().string(), SizeOf(input));
  for (bool more = true; more;) {
    const absl::StatusOr<bool> step = annotator.Step();
    if (!step.ok()) return step.status();
    more = *step;
    progress.Reach(reader->bytes_read());
  }
  if (absl::Status status = file->Commit(); !status.ok()) return status;
  return annotator.counts();
}

}  // namespace albtpu::client
