#include "formats/trajectories/coops_levels.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "absl/status/status.h"
#include "absl/strings/ascii.h"
#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "formats/clocks/trajectory_time.h"
#include "formats/csv/csv_reader.h"
#include "formats/text/text.h"
#include "status/status_macros.h"

namespace albtpu::formats {
namespace {

constexpr double kLargestReading = 1000;  // In m or feet above any datum of a gauge, the Great Lakes included.
constexpr char kAdvice[] = "; get another copy of the file";

std::string_view Trimmed(std::string_view text) {
  const absl::string_view trimmed = absl::StripAsciiWhitespace(absl::string_view(text.data(), text.size()));
  return {trimmed.data(), trimmed.size()};
}

std::string_view Start(std::string_view text) {
  if (text.substr(0, kByteOrderMark.size()) == kByteOrderMark) text.remove_prefix(kByteOrderMark.size());
  return Trimmed(text.substr(0, 4096));
}

// Adds what the file says of one time.
class Collector {
 public:
  explicit Collector(const std::string& name) : name_(name) {}

  // `quality` is p for preliminary, v for verified; may be empty. `where`: "line 7".
  absl::Status Add(const std::string& where, std::string date, std::string_view level, std::string_view quality) {
    std::replace(date.begin(), date.end(), '/', '-');
    const std::optional<double> time = ParseUtc(absl::StrCat(date, "Z"));
    if (!time.has_value())
      return Error(where, absl::StrCat("'", Quoted(date), "' is no time such as 2016-05-11 14:00", kAdvice));
    const std::string_view value = Trimmed(level);
    if (value.empty() || value == "-") {
      ++found_.missing;
      return absl::OkStatus();
    }
    const std::optional<double> number = ParseDouble(value);
    if (!number.has_value() || !(std::abs(*number) <= kLargestReading))
      return Error(where, absl::StrCat("'", Quoted(value), "' is no water level", kAdvice));
    found_.levels.push_back({*time, *number});
    found_.preliminary += Trimmed(quality) == "p";
    return absl::OkStatus();
  }

  absl::Status Error(const std::string& where, std::string_view text) const {
    return absl::InvalidArgumentError(absl::StrCat(name_, where.empty() ? "" : " ", where, ": ", std::string(text)));
  }

  static std::string Quoted(std::string_view text) { return OneLine(std::string(text.substr(0, 80))); }

  CoopsLevels& found() { return found_; }

 private:
  const std::string& name_;
  CoopsLevels found_;
};

std::string TextOf(const nlohmann::json& object, const char* key) {
  if (!object.is_object()) return "";
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

absl::Status ReadJson(std::string_view text, Collector& to) {
  const nlohmann::json json = nlohmann::json::parse(text, nullptr, /*allow_exceptions=*/false);
  if (!json.is_object()) return to.Error("", absl::StrCat("is no sound JSON of CO-OPS", kAdvice));
  if (json.contains("error")) {
    const std::string message = TextOf(json["error"], "message");
    return to.Error("", absl::StrCat("is an error of CO-OPS and no water levels ('",
                                     Collector::Quoted(Trimmed(message)), "'); ask for the data again"));
  }
  const auto data = json.find("data"), predictions = json.find("predictions");
  to.found().predicted = predictions != json.end();
  const auto& list = to.found().predicted ? predictions : data;
  if (list == json.end() || !list->is_array())
    return to.Error("", "has neither data nor predictions, as the water levels of CO-OPS have; give such a file");
  const auto metadata = json.find("metadata");
  if (metadata != json.end())
    to.found().station = absl::StrCat(TextOf(*metadata, "id"), " ", TextOf(*metadata, "name"));
  std::size_t number = 0;
  for (const nlohmann::json& each : *list)
    RETURN_IF_ERROR(to.Add(absl::StrCat("value ", ++number), TextOf(each, "t"), TextOf(each, "v"), TextOf(each, "q")));
  return absl::OkStatus();
}

// The attribute of an element such as <wl t="2016-05-11 14:00" v="0.213"/>; empty if it has none.
std::string_view Attribute(std::string_view element, std::string_view name) {
  const std::string sought = absl::StrCat(" ", std::string(name), "=\"");
  const std::size_t begin = element.find(sought);
  if (begin == element.npos) return "";
  const std::string_view rest = element.substr(begin + sought.size());
  return rest.substr(0, rest.find('"'));
}

absl::Status ReadXml(std::string_view text, Collector& to) {
  std::size_t number = 0, line = 1;
  while (true) {
    const std::size_t begin = text.find('<');
    if (begin == text.npos) break;
    line += static_cast<std::size_t>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(begin), '\n'));
    text.remove_prefix(begin);
    const std::size_t end = text.find('>');
    if (end == text.npos) return to.Error(absl::StrCat("line ", line), absl::StrCat("ends within an element", kAdvice));
    std::string element(text.substr(0, end));
    for (char& character : element)
      if (character == '\n' || character == '\t' || character == '\r') character = ' ';
    const std::string_view rest = text.substr(end + 1);
    const bool predicted = element.starts_with("<pr ");
    if (element.starts_with("<error")) {
      return to.Error(
          "", absl::StrCat("is an error of CO-OPS and no water levels ('",
                           Collector::Quoted(Trimmed(rest.substr(0, rest.find('<')))), "'); ask for the data again"));
    }
    if (element.starts_with("<metadata "))
      to.found().station =
          absl::StrCat(std::string(Attribute(element, "id")), " ", std::string(Attribute(element, "name")));
    if (predicted || element.starts_with("<wl ") || element.starts_with("<hr ")) {
      to.found().predicted = predicted;
      ++number;
      RETURN_IF_ERROR(to.Add(absl::StrCat("line ", line), std::string(Attribute(element, "t")), Attribute(element, "v"),
                             Attribute(element, "q")));
    }
    line += static_cast<std::size_t>(std::count(element.begin(), element.end(), '\n'));
    text = rest;
  }
  if (number == 0) return to.Error("", "has no elements wl, as the water levels of CO-OPS have; give such a file");
  return absl::OkStatus();
}

std::string TextOfCell(const CsvRecord& record, std::size_t cell) { return std::string(Trimmed(record.Cell(cell))); }

// The columns of the two forms of CSV.
struct Columns {
  std::optional<std::size_t> date_time, date, time, verified, preliminary, predicted, quality;
  std::size_t count = 0;

  bool are_of_table() const { return date.has_value() && time.has_value(); }
};

Columns ColumnsOf(const CsvRecord& header, CoopsLevels& found) {
  Columns columns;
  columns.count = header.cell_count();
  const auto take_unit = [&](const std::string& name) {
    if (absl::EndsWith(name, "(m)")) found.metres = 1;
    if (absl::EndsWith(name, "(ft)")) found.metres = kMetresOfFoot;
  };
  for (std::size_t i = 0; i < columns.count; ++i) {
    const std::string name = TextOfCell(header, i);
    if (name == "Date Time") columns.date_time = i;
    if (name == "Date") columns.date = i;
    if (name == "Quality") columns.quality = i;
    if (absl::StartsWith(name, "Time (")) {
      columns.time = i;
      found.zone = name == "Time (GMT)" ? CoopsLevels::Zone::kGmt : CoopsLevels::Zone::kLocal;
    }
    if (name == "Water Level" || absl::StartsWith(name, "Verified (")) columns.verified = i;
    if (absl::StartsWith(name, "Preliminary (")) columns.preliminary = i;
    if (name == "Prediction" || absl::StartsWith(name, "Predicted (")) columns.predicted = i;
    take_unit(name);
  }
  return columns;
}

absl::Status ReadCsv(const std::string& name, std::string_view text, Collector& to) {
  CsvBlock block{.text = std::string(text)};
  ASSIGN_OR_RETURN(block.dialect, DialectOf(name, block.text));
  CsvRecords records(name, block);
  CsvRecord record;
  ASSIGN_OR_RETURN(const bool has_header, records.Next(record));
  if (!has_header) return to.Error("", absl::StrCat("is empty", kAdvice));
  const Columns columns = ColumnsOf(record, to.found());
  if (!columns.date_time.has_value() && !columns.are_of_table())
    return to.Error("line 1", "has no columns of dates and times; ask CO-OPS for those");
  const bool measured = columns.verified.has_value() || columns.preliminary.has_value();
  if (!measured && !columns.predicted.has_value())
    return to.Error("line 1", "has no column of water levels; ask CO-OPS for those");
  to.found().predicted = !measured;
  std::string buffer;
  while (true) {
    ASSIGN_OR_RETURN(const bool more, records.Next(record));
    if (!more) return absl::OkStatus();
    if (record.blank() || (record.cell_count() == 1 && TextOfCell(record, 0).empty())) continue;
    const std::string where = absl::StrCat("line ", record.line);
    if (record.cell_count() != columns.count)
      return to.Error(where, absl::StrCat("has ", record.cell_count(), " cells, not ", columns.count, kAdvice));
    const auto cell = [&](const std::optional<std::size_t>& column) {
      if (!column.has_value()) return std::string();
      const std::string value = TextOfCell(record, *column);
      return std::string(WithPoint(value, block.dialect, buffer).value_or(value));
    };
    const std::string date =
        columns.are_of_table() ? absl::StrCat(TextOfCell(record, *columns.date), " ", TextOfCell(record, *columns.time))
                               : TextOfCell(record, *columns.date_time);
    std::string level = measured ? cell(columns.verified) : cell(columns.predicted), quality = cell(columns.quality);
    if (columns.preliminary.has_value() && (level.empty() || level == "-")) {
      level = cell(columns.preliminary);
      quality = "p";
    }
    RETURN_IF_ERROR(to.Add(where, date, level, quality));
  }
}

}  // namespace

bool AreCoopsLevels(std::string_view text) {
  const std::string_view start = Start(text);
  if (start.empty()) return false;
  if (start.front() == '{' || start.front() == '<') return true;
  std::string line(start.substr(0, start.find('\n')));
  line.erase(std::remove(line.begin(), line.end(), '"'), line.end());
  return absl::StartsWith(line, "Date Time") || (absl::StartsWith(line, "Date") && absl::StrContains(line, "Time ("));
}

absl::StatusOr<CoopsLevels> ReadCoopsLevels(const std::string& name, std::string_view text) {
  Collector collector(name);
  const char first = Start(text).front();
  if (text.substr(0, kByteOrderMark.size()) == kByteOrderMark && (first == '{' || first == '<'))
    text.remove_prefix(kByteOrderMark.size());
  RETURN_IF_ERROR(first == '{'   ? ReadJson(text, collector)
                  : first == '<' ? ReadXml(text, collector)
                                 : ReadCsv(name, text, collector));
  CoopsLevels& found = collector.found();
  found.station = OneLine(std::string(Trimmed(found.station)));
  return std::move(found);
}

}  // namespace albtpu::formats
