#include "formats/las/wkt_records.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "status/status_macros.h"

namespace albtpu::formats {
namespace {

// The name of the datum in well-known text of version 1: DATUM["North_American_Datum_1983",...
std::string DatumOf(const std::string& wkt) {
  constexpr std::string_view kDatum = "DATUM[\"";
  const std::size_t begin = wkt.find(kDatum);
  if (begin == std::string::npos) return "";
  return wkt.substr(begin + kDatum.size(), wkt.find('"', begin + kDatum.size()) - begin - kDatum.size());
}

bool AreUnequal(double one, double other) { return std::abs(one / other - 1) > 1e-9; }

// "unit of x and y, 1 m and 0.3048 m": what the two state otherwise. What one of them does not state does not differ.
std::vector<std::string> Differences(const MapFrame& one, const MapFrame& other, const MapPosition& at) {
  std::vector<std::string> differences;
  const auto add = [&](const char* what, const std::string& first, const std::string& second) {
    differences.push_back(absl::StrCat(what, ", ", first, " and ", second));
  };
  const auto metres = [](double unit) { return absl::StrFormat("%.10g m", unit); };
  if (one.is_geographic() != other.is_geographic())
    add("kind of coordinates", one.is_geographic() ? "degrees" : "a map", other.is_geographic() ? "degrees" : "a map");
  else if (AreUnequal(one.unit(), other.unit()))
    add("unit of x and y", metres(one.unit()), metres(other.unit()));
  const std::string datum = DatumOf(one.wkt()), datum_of_other = DatumOf(other.wkt());
  if (datum != datum_of_other && !datum.empty() && !datum_of_other.empty()) add("datum", datum, datum_of_other);
  const std::optional<double> height = one.metres_per_height_unit(), height_of_other = other.metres_per_height_unit();
  if (height.has_value() && height_of_other.has_value() && AreUnequal(*height, *height_of_other))
    add("unit of heights", metres(*height), metres(*height_of_other));
  if (one.vertical().has_value() && other.vertical().has_value() && one.vertical()->name != other.vertical()->name)
    add("vertical datum", one.vertical()->name, other.vertical()->name);
  if (differences.empty() && Apart(one, other, at) > kSamePlace) add("projection", one.crs_name(), other.crs_name());
  return differences;
}

}  // namespace

absl::StatusOr<std::vector<std::string>> WktRecords(const LasReader& reader) {
  std::vector<std::string> texts;
  for (const std::vector<VlrEntry>* entries : {&reader.vlrs(), &reader.evlrs()}) {
    for (const VlrEntry& entry : *entries) {
      if (!entry.Is(kProjectionUser, kWktRecord)) continue;
      ASSIGN_OR_RETURN(const std::string data,
                       reader.ReadAt(entry.data_offset, std::min<std::uint64_t>(entry.data_size, kLongestWkt)));
      std::string text = data.substr(0, data.find('\0'));
      absl::StripAsciiWhitespace(&text);
      if (!text.empty() && std::ranges::find(texts, text) == texts.end()) texts.push_back(std::move(text));
    }
  }
  return texts;
}

double Apart(const MapFrame& one, const MapFrame& other, const MapPosition& at) {
  const std::optional<GeographicPosition> position = one.GeographicAt(at);
  if (!position.has_value() || one.is_geographic() != other.is_geographic()) return HUGE_VAL;
  const MapPosition again = other.Project(*position);
  const MapMetric metric = one.MetricAt(*position);
  const double dx = DifferenceOfX(again.x, at.x, one.turn());
  const double apart = std::hypot(dx * metric.metres_per_x, (again.y - at.y) * metric.metres_per_y);
  return std::isfinite(apart) ? apart : HUGE_VAL;
}

absl::StatusOr<std::string> CompareWkts(const LasReader& reader, const MapFrame& first, const MapPosition& middle) {
  ASSIGN_OR_RETURN(const std::vector<std::string> texts, WktRecords(reader));
  std::string remark;
  for (std::size_t i = 1; i < texts.size(); ++i) {
    const absl::StatusOr<std::shared_ptr<const MapFrame>> other = MapFrame::Create(reader.name(), {.wkt = texts[i]});
    if (!other.ok()) {
      remark = absl::StrCat(reader.name(), ": has ", texts.size(),
                            " records of well-known text, of which the first is used (", first.crs_name(),
                            "): another cannot be read");
      continue;
    }
    const std::vector<std::string> differences = Differences(first, **other, middle);
    if (!differences.empty()) {
      return absl::FailedPreconditionError(
          absl::StrCat(reader.name(), ": has two records of well-known text that contradict each other, ",
                       first.crs_name(), " and ", (*other)->crs_name(), " (", absl::StrJoin(differences, "; "),
                       "); remove the wrong one, or name the right one by --crs"));
    }
    if (remark.empty())
      remark = absl::StrCat(reader.name(), ": has ", texts.size(),
                            " records of well-known text, which agree; the first is used (", first.crs_name(), ")");
  }
  return remark;
}

}  // namespace albtpu::formats
