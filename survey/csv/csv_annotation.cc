#include "survey/csv/csv_annotation.h"

#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "survey/answers/answer_cells.h"
#include "survey/csv/csv_reader.h"
#include "survey/files/ordered_pipeline.h"
#include "survey/number_text.h"

namespace albtpu::client {
namespace {

// Memory that is reused from block to block.
struct Chunk {
  explicit Chunk(AnswerStyle style) : summary(style) {}

  // The sizes of a record in the block. Blank records have no pulse.
  struct Row {
    std::uint32_t text_size, ending_size;
    bool blank, has_azimuth;
  };

  CsvBlock block;         // Input.
  std::string annotated;  // Output.
  std::uint64_t bytes_read = 0;
  std::uint64_t pulse_count = 0;
  UncertaintySummary summary;

  std::vector<Row> rows;
  CsvPulseBatches pulses;
  AnswerBatch with_azimuth, without_azimuth;
};

// Annotates the records of a block.
class BlockWork {
 public:
  BlockWork(const CsvReader& reader, const CsvPulses& columns, AnswerStyle style, std::string default_ending,
            const AnswerSource& source)
      : name_(reader.name()),
        columns_(columns),
        style_(style),
        cells_(style),
        selection_(cells_.selection()),
        default_ending_(std::move(default_ending)),
        source_(source) {
    UncertaintySummary::Select(selection_);
  }

  absl::Status operator()(Chunk& chunk) const {
    if (absl::Status status = Decode(chunk); !status.ok()) return status;
    chunk.summary = UncertaintySummary(style_);
    absl::Status status = QueryPulses(chunk.pulses.with_azimuth, chunk.with_azimuth, chunk.summary);
    if (status.ok()) status = QueryPulses(chunk.pulses.without_azimuth, chunk.without_azimuth, chunk.summary);
    if (status.ok()) Encode(chunk);
    return status;
  }

 private:
  absl::Status Decode(Chunk& chunk) const {
    CsvRecords records(name_, chunk.block);
    CsvRecord record;
    columns_.Clear(chunk.pulses);
    chunk.rows.clear();
    while (true) {
      const absl::StatusOr<bool> more = records.Next(record);
      if (!more.ok()) return more.status();
      if (!*more) break;
      bool has_azimuth = false;
      if (!record.blank()) {
        const absl::StatusOr<bool> appended = columns_.Append(record, chunk.pulses);
        if (!appended.ok()) return appended.status();
        has_azimuth = *appended;
      }
      chunk.rows.push_back({static_cast<std::uint32_t>(record.text.size()),
                            static_cast<std::uint32_t>(record.line_ending.size()), record.blank(),
                            has_azimuth});
    }
    chunk.pulse_count = chunk.pulses.with_azimuth.size + chunk.pulses.without_azimuth.size;
    return absl::OkStatus();
  }

  absl::Status QueryPulses(const PulseBatch& pulses, AnswerBatch& answers,
                           UncertaintySummary& summary) const {
    absl::Status status = AnswerPulses(source_, style_.query(), pulses, selection_, answers);
    if (status.ok() && pulses.size > 0) summary.Add(pulses, answers);
    return status;
  }

  void Encode(Chunk& chunk) const {
    std::string_view rest = chunk.block.text;
    std::string& to = chunk.annotated;
    to.clear();
    std::size_t with = 0, without = 0;
    for (const Chunk::Row& row : chunk.rows) {
      to.append(rest.substr(0, row.text_size));
      if (!row.blank) {
        const AnswerBatch& answers = row.has_azimuth ? chunk.with_azimuth : chunk.without_azimuth;
        cells_.Visit(
            answers, row.has_azimuth ? with++ : without++,
            [&to](float number) {
              to += ',';
              AppendFloat(number, to);
            },
            [&to](std::string_view text) { (to += ',') += text; }, [&to] { to += ','; });
      }
      const std::string_view ending = rest.substr(row.text_size, row.ending_size);
      to.append(ending.empty() ? std::string_view(default_ending_) : ending);
      rest.remove_prefix(row.text_size + row.ending_size);
    }
  }

  std::string name_;
  const CsvPulses& columns_;
  AnswerStyle style_;
  AnswerCells cells_;
  AnswerSelection selection_;
  std::string default_ending_;
  AnswerSource source_;
};

std::string AnnotatedHeader(const CsvRecord& header, const std::string& ending,
                            const std::vector<std::string>& names) {
  std::string text(header.text);
  for (const std::string& name : names) absl::StrAppend(&text, ",", name);
  return text + ending;
}

// Copies all records after the header from `reader` to the file of `annotated`, with their answers.
absl::Status AnnotateRecords(CsvReader& reader, const BlockWork& work, AnswerStyle style,
                             FileProgress::File& progress, AnnotatedCsv& annotated) {
  std::uint64_t written_pulses = 0;
  return RunOrderedPipeline([&] { return Chunk(style); },
                            [&](Chunk& chunk) {
                              absl::StatusOr<bool> more = reader.Read(chunk.block);
                              chunk.bytes_read = reader.bytes_read();
                              return more;
                            },
                            [&](Chunk& chunk) { return work(chunk); },
                            [&](Chunk& chunk) {
                              annotated.summary.Merge(chunk.summary);
                              annotated.input_bytes = chunk.bytes_read;
                              written_pulses += chunk.pulse_count;
                              progress.Reach(chunk.bytes_read, written_pulses);
                              return annotated.file.Write(chunk.annotated);
                            });
}

}  // namespace

absl::StatusOr<AnnotatedCsv> AnnotateCsv(const std::filesystem::path& input,
                                         const std::filesystem::path& output, Existing existing,
                                         const FixedInputs& fixed, AnswerStyle style,
                                         const AnswerSource& source, FileProgress& progress) {
  if (absl::Status status = CheckNotTheSameFile(input, output); !status.ok()) return status;
  absl::StatusOr<CsvReader> reader = CsvReader::Open(input);
  if (!reader.ok()) return reader.status();
  const absl::StatusOr<CsvBlock> header_block = reader->ReadHeader();
  if (!header_block.ok()) return header_block.status();
  CsvRecord header;
  const absl::StatusOr<bool> has_header = CsvRecords(reader->name(), *header_block).Next(header);
  if (!has_header.ok()) return has_header.status();
  if (!*has_header || header.blank()) {
    return absl::InvalidArgumentError(absl::StrCat(
        input.string(), " line 1: is empty; begin the file with a header that names the columns"));
  }
  const std::vector<std::string> appended = AnswerCells(style).names();
  const absl::StatusOr<CsvPulses> columns = CsvPulses::Bind(input.string(), header, fixed, appended);
  if (!columns.ok()) return columns.status();
  absl::StatusOr<OutputFile> file = OutputFile::Create(output, existing);
  if (!file.ok()) return file.status();

  AnnotatedCsv annotated{
      .input_bytes = reader->bytes_read(), .summary = UncertaintySummary(style), .file = *std::move(file)};
  FileProgress::File file_progress(progress, input.filename().string());
  const std::string ending = header.line_ending.empty() ? "\n" : std::string(header.line_ending);
  absl::Status status = annotated.file.Write(AnnotatedHeader(header, ending, appended));
  const BlockWork work(*reader, *columns, style, ending, source);
  if (status.ok()) status = AnnotateRecords(*reader, work, style, file_progress, annotated);
  if (absl::Status changed = reader->CheckUnchanged(); !changed.ok()) return changed;
  if (!status.ok()) return status;
  return annotated;
}

}  // namespace albtpu::client
