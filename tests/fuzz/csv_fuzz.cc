// Arbitrary text as CSV: as records of pulses it is rejected with a message that names a line, or read without losing a
// byte; as a file it is annotated such that every record is kept, or nothing is written.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "absl/strings/ascii.h"
#include "absl/strings/match.h"
#include "annotate/answers/answer_counts.h"
#include "annotate/csv/csv_annotation.h"
#include "annotate/csv/csv_pulses.h"
#include "formats/csv/csv_reader.h"
#include "formats/text/text.h"
#include "service/client/local_source.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/memory_file.h"
#include "tests/tables/synthetic_table.h"
#include "tests/temporary_folder.h"

namespace albtpu::fuzz {
namespace {

using namespace albtpu::annotate;
using namespace albtpu::formats;

void MustNameALine(const absl::Status& status) {
  ALBTPU_MUST(absl::IsInvalidArgument(status) && absl::StrContains(status.message(), " line "));
}

std::string Quoted(std::string_view value) {
  std::string quoted = "\"";
  for (const char character : value) quoted.append(character == '"' ? 2 : 1, character);
  return quoted + '"';
}

// The cells make up the whole record: they follow each other with a separator between them, and quoting the value of a
// quoted cell again gives the cell.
void CheckCells(const CsvRecord& record) {
  const std::size_t first = record.cell_begins.front();
  ALBTPU_MUST(record.text.substr(0, first) == kByteOrderMark.substr(0, first));
  for (std::size_t i = 0; i < record.cell_count(); ++i) {
    const std::size_t begin = record.cell_begins[i];
    ALBTPU_MUST(begin <= record.text.size());
    if (i > 0) ALBTPU_MUST(begin > record.cell_begins[i - 1] && record.text[begin - 1] == record.dialect.separator);
    const std::string_view raw = record.RawCell(i);
    if (raw.empty() || raw.front() != '"')
      ALBTPU_MUST(raw.find(record.dialect.separator) == raw.npos && raw.find('\n') == raw.npos);
    else
      ALBTPU_MUST(Quoted(record.Cell(i)) == raw);
  }
}

// The records follow each other without gaps from the beginning of the block to its end, or to the first malformed
// record.
void CheckRecords(const CsvBlock& block) {
  CsvRecords records("file", block);
  CsvRecord record;
  const char* next = block.text.data();
  const char* const end = next + block.text.size();
  std::size_t line = block.first_line;
  while (true) {
    const absl::StatusOr<bool> more = records.Next(record);
    if (!more.ok()) return MustNameALine(more.status());
    if (!*more) break;
    ALBTPU_MUST(record.text.data() == next && record.line == line);
    next += record.text.size();
    const std::string_view ending = record.line_ending;
    ALBTPU_MUST(ending == "\n" || ending == "\r\n" || (ending.empty() && next == end));
    ALBTPU_MUST(ending.empty() || ending.data() == next);
    next += ending.size();
    for (const char character : record.text) line += character == '\n';
    line += !ending.empty();
    CheckCells(record);
  }
  ALBTPU_MUST(next == end);
}

// A number from the file, written and read again, is the same number.
void CheckNumbers(const PulseBatch& pulses) {
  for (const std::vector<float>& column : pulses.axis) {
    for (const float number : column) {
      if (std::isnan(number)) continue;
      ALBTPU_MUST(ParseFloat(FormatFloat(number)) == number);
    }
  }
}

// The value of a cell by its column's name; none if there is no such column or if the cell is empty.
std::optional<float> Value(const CsvRecord& header, const CsvRecord& record, std::string_view name) {
  for (std::size_t i = 0; i < header.cell_count(); ++i)
    if (absl::StripAsciiWhitespace(header.Cell(i)) == absl::string_view(name.data(), name.size()))
      return NumberOf("file", record, i, name, "", true).value_or(std::nullopt);
  return std::nullopt;
}

// An azimuth that follows from directions is their difference, and absent where one of them is.
void CheckAzimuth(const CsvRecord& header, const CsvRecord& record, bool has_azimuth, const CsvPulseBatches& batches) {
  const std::optional<float> beam = Value(header, record, "beam_azimuth"), wind = Value(header, record, "wind_from");
  ALBTPU_MUST(has_azimuth == (beam.has_value() && wind.has_value()));
  if (!has_azimuth) return;
  const float azimuth = batches.with_azimuth.axis[Index(AxisId::kAzimuth)].back();
  const double expected = static_cast<double>(*beam) - (static_cast<double>(*wind) + 180);
  constexpr double kGreatest = std::numeric_limits<float>::max();
  if (std::isfinite(expected))
    ALBTPU_MUST(azimuth == static_cast<float>(std::clamp(expected, -kGreatest, kGreatest)));
  else
    ALBTPU_MUST(!std::isfinite(azimuth));
}

// Every record that is not blank becomes one pulse, up to the first malformed record.
void CheckPulses(const CsvBlock& block) {
  CsvRecords records("file", block);
  CsvRecord header, record;
  const absl::StatusOr<bool> has_header = records.Next(header);
  if (!has_header.ok() || !*has_header) return;
  FixedInputs fixed;
  if (!absl::StrContains(block.text, "wind_speed")) fixed[PulseInput::kWindSpeed] = 5.0f;
  if (!absl::StrContains(block.text, "divergence") && !absl::StrContains(block.text, "footprint"))
    fixed[PulseInput::kDivergence] = 1.5f;
  static const std::vector<std::string> appended = {"thu", "tvu"};
  const absl::StatusOr<CsvPulses> columns = CsvPulses::Bind("file", header, fixed, appended);
  if (!columns.ok()) return MustNameALine(columns.status());
  CsvPulseBatches batches;
  columns->Clear(batches);
  const auto has_column = [&](std::string_view name) {
    for (std::size_t i = 0; i < header.cell_count(); ++i)
      if (absl::StripAsciiWhitespace(header.Cell(i)) == absl::string_view(name.data(), name.size())) return true;
    return false;
  };
  std::size_t count = 0;
  for (absl::StatusOr<bool> more = records.Next(record); more.ok() && *more; more = records.Next(record)) {
    if (record.blank()) continue;
    const absl::StatusOr<bool> has_azimuth = columns->Append(record, batches);
    if (!has_azimuth.ok()) return MustNameALine(has_azimuth.status());
    ++count;
    const bool by_directions = has_column("beam_azimuth") && has_column("wind_from");
    if (by_directions) CheckAzimuth(header, record, *has_azimuth, batches);
  }
  ALBTPU_MUST(batches.with_azimuth.size + batches.without_azimuth.size == count);
  for (const PulseBatch* batch : {&batches.with_azimuth, &batches.without_azimuth}) {
    ALBTPU_MUST(batch->size == 0 || CheckLengths(batch->columns()).ok());
    CheckNumbers(*batch);
  }
}

// The text with its dialect, or with none and the error of it.
CsvBlock BlockOf(std::string_view text, absl::Status& status) {
  CsvBlock block{.text = std::string(text), .first_line = 1};
  const absl::StatusOr<CsvDialect> dialect = DialectOf("file", text);
  status = dialect.status();
  if (dialect.ok()) block.dialect = *dialect;
  return block;
}

void CsvTarget(std::string_view text) {
  absl::Status status;
  const CsvBlock block = BlockOf(text, status);
  if (!status.ok()) return MustNameALine(status);
  CheckRecords(block);
  CheckPulses(block);
}

struct Record {
  std::string text;  // Without its line ending.
  std::size_t cell_count;
  std::string last_cell;
  bool operator==(const Record&) const = default;
};

// The records of a text up to the first malformed one, whose error is `status`.
std::vector<Record> Records(const CsvBlock& block, absl::Status& status) {
  std::vector<Record> records;
  CsvRecords reader("file", block);
  CsvRecord record;
  while (true) {
    const absl::StatusOr<bool> more = reader.Next(record);
    status = more.status();
    if (!more.ok() || !*more) return records;
    records.push_back({std::string(record.text), record.cell_count(), record.Cell(record.cell_count() - 1)});
  }
}

std::vector<Record> RecordsOfFile(const std::filesystem::path& path, absl::Status& status) {
  absl::StatusOr<CsvReader> reader = CsvReader::Open(path);
  ALBTPU_MUST(reader.ok());
  const absl::StatusOr<CsvBlock> header = reader->ReadHeader();
  status = header.status();
  if (!header.ok()) return {};
  std::vector<Record> records = Records(*header, status);
  CsvBlock block;
  while (status.ok()) {
    const absl::StatusOr<bool> more = reader->Read(block);
    status = more.status();
    if (!more.ok() || !*more) break;
    for (Record& record : Records(block, status)) records.push_back(std::move(record));
  }
  return records;
}

void CheckAnnotated(const std::vector<Record>& before, char separator, const std::filesystem::path& path) {
  const std::size_t appended = AnswerCells({}).names().size();
  absl::Status status;
  const std::vector<Record> after = RecordsOfFile(path, status);
  ALBTPU_MUST(status.ok() && after.size() == before.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (before[i].text.empty()) {
      ALBTPU_MUST(after[i].text.empty());
      continue;
    }
    ALBTPU_MUST(after[i].text.substr(0, before[i].text.size() + 1) == before[i].text + separator);
    ALBTPU_MUST(after[i].cell_count == before[i].cell_count + appended);
    const std::string& outcome = after[i].last_cell;
    ALBTPU_MUST(outcome == (i == 0 ? "outcome" : "INTERPOLATED") || outcome == "INVALID" ||
                (absl::StartsWith(outcome, "OUT_OF_DOMAIN:") &&
                 (absl::EndsWith(outcome, ":below") || absl::EndsWith(outcome, ":above"))));
  }
}

// Reading the file gives the same records as reading from memory.
void CsvFileTarget(std::string_view text) {
  static client::LocalSource source("", testing::SyntheticTable());
  static MemoryFile input;
  static const testing::TemporaryFolder folder;
  static const std::filesystem::path output = folder / "out.csv";
  absl::Status dialect, status, status_of_file;
  const CsvBlock block = BlockOf(text, dialect);
  const std::vector<Record> records = Records(block, status);
  input.Write(block.text);
  const std::vector<Record> of_file = RecordsOfFile(input.path(), status_of_file);
  if (dialect.ok()) {
    ALBTPU_MUST(of_file == records);
    ALBTPU_MUST(status.ok() == status_of_file.ok());
  }

  FixedInputs fixed;
  if (!absl::StrContains(block.text, "wind_speed")) fixed[PulseInput::kWindSpeed] = 5.0f;
  FileProgress progress("pulses", 1, 0);
  progress.NextFile();
  {
    absl::StatusOr<AnnotatedCsv> annotated =
        AnnotateCsv(input.path(), output, Existing::kReplace, fixed, {}, source, progress);
    if (annotated.ok()) {
      ALBTPU_MUST(dialect.ok() && status.ok() && annotated->file.Commit().ok());
      CheckAnnotated(records, block.dialect.separator, output);
      std::filesystem::remove(output);
    } else {
      ALBTPU_MUST(absl::IsInvalidArgument(annotated.status()));
      ALBTPU_MUST(absl::StrContains(annotated.status().message(), " line "));
    }
  }
  ALBTPU_MUST(folder.file_count() == 0);
}

}  // namespace

const std::vector<Target> kTargets = {{"csv", CsvTarget}, {"csv_file", CsvFileTarget}};

}  // namespace albtpu::fuzz
