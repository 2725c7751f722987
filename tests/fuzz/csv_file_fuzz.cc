// Arbitrary text as a CSV file: reading the file gives the same records as reading from memory. The file is annotated
// such that every record is kept and followed by the cells of its answer; or it is rejected and nothing is written.
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/match.h"
#include "annotate/answers/answer_counts.h"
#include "annotate/csv/csv_annotation.h"
#include "formats/csv/csv_reader.h"
#include "service/client/local_source.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/memory_file.h"
#include "tests/tables/synthetic_table.h"
#include "tests/temporary_folder.h"

namespace {

using namespace albtpu;
using namespace albtpu::annotate;
using namespace albtpu::client;
using namespace albtpu::formats;

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
  ALBTPU_MUST(header.ok());
  std::vector<Record> records = Records(*header, status);
  CsvBlock block;
  while (status.ok()) {
    const absl::StatusOr<bool> more = reader->Read(block);
    ALBTPU_MUST(more.ok());
    if (!*more) break;
    for (Record& record : Records(block, status)) records.push_back(std::move(record));
  }
  return records;
}

void CheckAnnotated(const std::vector<Record>& before, const std::filesystem::path& path) {
  const std::size_t appended = AnswerCells({}).names().size();
  absl::Status status;
  const std::vector<Record> after = RecordsOfFile(path, status);
  ALBTPU_MUST(status.ok() && after.size() == before.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (before[i].text.empty()) {
      ALBTPU_MUST(after[i].text.empty());
      continue;
    }
    ALBTPU_MUST(after[i].text.substr(0, before[i].text.size() + 1) == before[i].text + ",");
    ALBTPU_MUST(after[i].cell_count == before[i].cell_count + appended);
    const std::string& outcome = after[i].last_cell;
    ALBTPU_MUST(outcome == (i == 0 ? "outcome" : "INTERPOLATED") || outcome == "INVALID" ||
                (absl::StartsWith(outcome, "OUT_OF_DOMAIN:") &&
                 (absl::EndsWith(outcome, ":below") || absl::EndsWith(outcome, ":above"))));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static LocalSource source("", testing::SyntheticTable());
  static fuzz::MemoryFile input;
  static const testing::TemporaryFolder folder;
  static const std::filesystem::path output = folder / "out.csv";
  const CsvBlock block{.text = std::string(reinterpret_cast<const char*>(data), size), .first_line = 1};
  absl::Status status, status_of_file;
  const std::vector<Record> records = Records(block, status);
  input.Write(block.text);
  ALBTPU_MUST(RecordsOfFile(input.path(), status_of_file) == records);
  ALBTPU_MUST(status.ok() == status_of_file.ok());

  FixedInputs fixed;
  if (!absl::StrContains(block.text, "wind_speed")) fixed[PulseInput::kWindSpeed] = 5.0f;
  FileProgress progress("pulses", 1, 0);
  progress.NextFile();
  {
    absl::StatusOr<AnnotatedCsv> annotated =
        AnnotateCsv(input.path(), output, Existing::kReplace, fixed, {}, source, progress);
    if (annotated.ok()) {
      ALBTPU_MUST(status.ok() && annotated->file.Commit().ok());
      CheckAnnotated(records, output);
      std::filesystem::remove(output);
    } else {
      ALBTPU_MUST(absl::IsInvalidArgument(annotated.status()));
      ALBTPU_MUST(absl::StrContains(annotated.status().message(), " line "));
    }
  }
  ALBTPU_MUST(folder.file_count() == 0);
  return 0;
}
