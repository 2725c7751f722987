#include "quality/checkpoints/check_points_file.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "formats/csv/csv_reader.h"
#include "formats/text/text.h"
#include "status/status_macros.h"

namespace albtpu::quality {
namespace {

constexpr double kMostOfSigma = 10;  // m; a check point that is known worse checks nothing.

class CheckPointReader {
 public:
  CheckPointReader(std::string name, const CheckPointUnits& units, const GivenSigma& given)
      : name_(std::move(name)), units_(units), given_(given) {}

  absl::Status TakeHeader(const formats::CsvRecord& header) {
    for (std::size_t i = 0; i < header.cell_count(); ++i) {
      std::string name = header.Cell(i);
      absl::StripAsciiWhitespace(&name);
      names_.push_back(absl::AsciiStrToLower(name));
    }
    RETURN_IF_ERROR(Find(kNamesOfX, x_));
    RETURN_IF_ERROR(Find(kNamesOfY, y_));
    RETURN_IF_ERROR(Find(kNamesOfElevation, elevation_));
    RETURN_IF_ERROR(Find(kNamesOfId, id_));
    RETURN_IF_ERROR(Find(kNamesOfClass, class_));
    RETURN_IF_ERROR(Find(kNamesOfHorizontal, horizontal_));
    RETURN_IF_ERROR(Find(kNamesOfVertical, vertical_));
    RETURN_IF_ERROR(Require(x_, kNamesOfX));
    RETURN_IF_ERROR(Require(y_, kNamesOfY));
    RETURN_IF_ERROR(Require(elevation_, kNamesOfElevation));
    list_.has_classes = class_.has_value();
    list_.horizontal_stated = horizontal_.has_value() || given_.horizontal.has_value();
    list_.vertical_stated = vertical_.has_value() || given_.vertical.has_value();
    return absl::OkStatus();
  }

  absl::Status Take(const formats::CsvRecord& record) {
    if (record.cell_count() != names_.size())
      return absl::InvalidArgumentError(absl::StrCat(name_, " line ", record.line, ": has ", record.cell_count(),
                                                     " cells, the header ", names_.size(), "; mend the line"));
    if (list_.points.size() == kMostCheckPoints)
      return absl::InvalidArgumentError(absl::StrCat(name_, ": has more than ", kMostCheckPoints,
                                                     " check points; give a part of them, or surveys to crosscheck"));
    CheckPoint& point = list_.points.emplace_back();
    point.id = id_.has_value() ? Text(record, *id_) : "";
    if (point.id.empty()) point.id = absl::StrCat("line ", record.line);
    if (class_.has_value()) point.kind = Text(record, *class_);
    RETURN_IF_ERROR(Number(record, *x_, point.x));
    RETURN_IF_ERROR(Number(record, *y_, point.y));
    RETURN_IF_ERROR(Number(record, *elevation_, point.elevation));
    point.elevation *= units_.metres_per_height_unit;
    point.sigma = {given_.horizontal.value_or(0), given_.vertical.value_or(0)};
    list_.horizontal_stated &= given_.horizontal.has_value() || Has(record, horizontal_);
    list_.vertical_stated &= given_.vertical.has_value() || Has(record, vertical_);
    RETURN_IF_ERROR(Sigma(record, horizontal_, units_.metres_per_unit, point.sigma.horizontal));
    return Sigma(record, vertical_, units_.metres_per_height_unit, point.sigma.vertical);
  }

  absl::StatusOr<CheckPointList> Finish() {
    if (list_.points.empty())
      return absl::InvalidArgumentError(absl::StrCat(name_, ": has no check point; give a line for each"));
    return std::move(list_);
  }

 private:
  using Column = std::optional<std::size_t>;

  absl::Status Find(std::span<const std::string_view> names, Column& column) const {
    for (std::size_t i = 0; i < names_.size(); ++i) {
      if (std::ranges::find(names, names_[i]) == names.end()) continue;
      if (column.has_value())
        return absl::InvalidArgumentError(absl::StrCat(name_, " line 1: the columns '", names_[*column], "' and '",
                                                       names_[i], "' both are '", std::string(names.front()),
                                                       "'; rename one of them"));
      column = i;
    }
    return absl::OkStatus();
  }

  absl::Status Require(const Column& column, std::span<const std::string_view> names) const {
    if (column.has_value()) return absl::OkStatus();
    const auto has = [&](std::string_view name) { return std::ranges::find(names_, name) != names_.end(); };
    std::string why;
    if (has("lat") || has("latitude") || has("lon") || has("longitude"))
      why = "; latitude and longitude have to be projected into the coordinate system of the annotated files first";
    if (names.front() == kNamesOfElevation.front() && has("depth"))
      why = "; a depth below a water level has to be made an elevation in the datum of the annotated files first";
    return absl::InvalidArgumentError(absl::StrCat(
        name_, " line 1: no column '", std::string(names.front()),
        "' (columns found: ", formats::OneLine(absl::StrJoin(names_, ", ")), "); name it ",
        absl::StrJoin(names, " or ", [](std::string* text, std::string_view name) { text->append(name); }), why));
  }

  static std::string Text(const formats::CsvRecord& record, std::size_t cell) {
    return formats::OneLine(std::string(absl::StripAsciiWhitespace(record.Cell(cell))));
  }

  absl::Status Number(const formats::CsvRecord& record, std::size_t cell, double& number) const {
    const std::string text(absl::StripAsciiWhitespace(record.Cell(cell)));
    std::string buffer;
    const std::optional<std::string_view> pointed = formats::WithPoint(text, record.dialect, buffer);
    const std::optional<double> value = pointed.has_value() ? formats::ParseDouble(*pointed) : std::nullopt;
    if (!value.has_value() || !std::isfinite(*value))
      return absl::InvalidArgumentError(absl::StrCat(name_, " line ", record.line, ", column '", names_[cell], "': '",
                                                     formats::OneLine(text), "' is no number"));
    number = *value;
    return absl::OkStatus();
  }

  bool Has(const formats::CsvRecord& record, const Column& column) const {
    return column.has_value() && !absl::StripAsciiWhitespace(record.Cell(*column)).empty();
  }

  // An empty cell leaves what was given for all.
  absl::Status Sigma(const formats::CsvRecord& record, const Column& column, double metres, double& sigma) const {
    if (!Has(record, column)) return absl::OkStatus();
    RETURN_IF_ERROR(Number(record, *column, sigma));
    sigma *= metres;
    if (sigma >= 0 && sigma <= kMostOfSigma) return absl::OkStatus();
    return absl::InvalidArgumentError(absl::StrCat(name_, " line ", record.line, ", column '", names_[*column],
                                                   "': ", sigma, " m is no standard deviation from 0 to ", kMostOfSigma,
                                                   " m"));
  }

  std::string name_;
  CheckPointUnits units_;
  GivenSigma given_;
  std::vector<std::string> names_;
  Column x_, y_, elevation_, id_, class_, horizontal_, vertical_;
  CheckPointList list_;
};

}  // namespace

absl::StatusOr<CheckPointList> ReadCheckPoints(const std::filesystem::path& path, const CheckPointUnits& units,
                                               const GivenSigma& given) {
  ASSIGN_OR_RETURN(formats::CsvReader reader, formats::CsvReader::Open(path));
  CheckPointReader points(reader.name(), units, given);
  ASSIGN_OR_RETURN(const formats::CsvBlock header, reader.ReadHeader());
  formats::CsvRecord record;
  {
    formats::CsvRecords records(reader.name(), header);
    ASSIGN_OR_RETURN(const bool has_header, records.Next(record));
    if (!has_header || record.blank())
      return absl::InvalidArgumentError(
          absl::StrCat(reader.name(), ": has no header; give the columns x, y and elevation in its first line"));
    RETURN_IF_ERROR(points.TakeHeader(record));
  }
  formats::CsvBlock block;
  while (true) {
    ASSIGN_OR_RETURN(const bool more, reader.Read(block));
    if (!more) break;
    formats::CsvRecords records(reader.name(), block);
    while (true) {
      ASSIGN_OR_RETURN(const bool another, records.Next(record));
      if (!another) break;
      if (!record.blank()) RETURN_IF_ERROR(points.Take(record));
    }
  }
  RETURN_IF_ERROR(reader.CheckUnchanged());
  return points.Finish();
}

}  // namespace albtpu::quality
