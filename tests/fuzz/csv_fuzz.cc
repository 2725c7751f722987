// Arbitrary text as CSV records of pulses is rejected with a message that names a line, or read without losing a byte.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "absl/strings/ascii.h"
#include "absl/strings/match.h"
#include "annotate/csv/csv_pulses.h"
#include "formats/csv/csv_reader.h"
#include "formats/text/text.h"
#include "tests/fuzz/fuzz_target.h"

namespace {

using namespace albtpu;
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

// The cells make up the whole record: they follow each other with a comma between them, and quoting the value of a
// quoted cell again gives the cell.
void CheckCells(const CsvRecord& record) {
  const std::size_t first = record.cell_begins.front();
  ALBTPU_MUST(record.text.substr(0, first) == kByteOrderMark.substr(0, first));
  for (std::size_t i = 0; i < record.cell_count(); ++i) {
    const std::size_t begin = record.cell_begins[i];
    ALBTPU_MUST(begin <= record.text.size());
    if (i > 0) ALBTPU_MUST(begin > record.cell_begins[i - 1] && record.text[begin - 1] == ',');
    const std::string_view raw = record.RawCell(i);
    if (raw.empty() || raw.front() != '"')
      ALBTPU_MUST(raw.find_first_of(",\n") == std::string_view::npos);
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
      return ParseFloat(record.Cell(i));
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

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const CsvBlock block{.text = std::string(reinterpret_cast<const char*>(data), size), .first_line = 1};
  CheckRecords(block);
  CheckPulses(block);
  return 0;
}
