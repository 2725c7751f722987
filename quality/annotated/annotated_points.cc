#include "quality/annotated/annotated_points.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <system_error>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "annotate/answers/batch.h"
#include "annotate/beams/beam_plan.h"
#include "annotate/run/file_jobs.h"
#include "formats/clocks/point_clock.h"
#include "formats/crs/map_frame.h"
#include "formats/las/las_crs.h"
#include "formats/las/las_extra_bytes.h"
#include "formats/las/las_points.h"
#include "status/status_macros.h"
#include "tables/digest.h"

namespace albtpu::quality {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr double kMinUnit = 1e-3, kMaxUnit = 1e3;  // m
constexpr double kMostStretch = 0.05;              // Of lengths on the map.

// Whether a summary has what is read of it later, with the right types.
bool IsOurs(const Json& summary) {
  const auto object = [](const Json& in, const char* key) {
    return in.is_object() && in.contains(key) && in[key].is_object();
  };
  if (!object(summary, "answers") || !object(summary, "parameters") || !object(summary, "input") ||
      !object(summary, "output") || !object(summary, "table") || !object(summary["answers"], "outcomes"))
    return false;
  for (const char* const key : {"id", "version", "digest"})
    if (!summary["table"].value(key, Json()).is_string()) return false;
  const Json& outcomes = summary["answers"]["outcomes"];
  return summary.value("program", Json()) == "albtpu-query" &&
         std::ranges::all_of(outcomes, [](const Json& count) { return count.is_number_unsigned(); });
}

// A length of the map that is not that on the ground would make cells, densities and slopes wrong.
absl::Status CheckTrueToScale(const formats::LasReader& reader, const formats::MapFrame& map) {
  if (reader.header().point_count == 0) return absl::OkStatus();
  ASSIGN_OR_RETURN(const std::string record, formats::FirstRecord(reader));
  const formats::LasPointFields fields(reader.header());
  const std::optional<formats::GeographicPosition> first = map.GeographicAt({fields.X(record), fields.Y(record)});
  // One damaged point says nothing, and neither does a wrong box.
  const formats::LasHeader& header = reader.header();
  const std::optional<formats::GeographicPosition> middle =
      map.GeographicAt({(header.least[0] + header.greatest[0]) / 2, (header.least[1] + header.greatest[1]) / 2});
  if (!first.has_value() || !middle.has_value()) return absl::OkStatus();
  const formats::MapMetric metric = map.MetricAt(*first), other = map.MetricAt(*middle);
  for (double formats::MapMetric::*const axis :
       {&formats::MapMetric::metres_per_x, &formats::MapMetric::metres_per_y}) {
    const double metres = metric.*axis / map.unit();
    if (std::abs(metres - 1) <= kMostStretch || std::abs(other.*axis / map.unit() - 1) <= kMostStretch) continue;
    return absl::InvalidArgumentError(absl::StrFormat(
        "%s: its coordinate system, %s, is not true to scale: 1 m of it is %.3g m on the ground, and at most %g %% of "
        "difference are allowed; annotate points in a system such as UTM",
        reader.name(), map.crs_name(), metres, 100 * kMostStretch));
  }
  return absl::OkStatus();
}

std::set<int> NumbersOf(const Json& channel, const char* key) {
  std::set<int> numbers;
  for (const Json& number : channel.is_object() ? channel.value(key, Json::array()) : Json::array())
    if (number.is_number_unsigned() && number <= 255) numbers.insert(number.get<int>());
  return numbers;
}

// Metres in a unit of the coordinates of well-known text of version 1: the last one of the horizontal system.
std::optional<double> UnitOfWkt(const std::string& wkt) {
  const std::size_t at = wkt.rfind("UNIT[\""), comma = at == std::string::npos ? at : wkt.find("\",", at);
  if (comma == std::string::npos) return std::nullopt;
  double metres = 0;
  const std::string number = wkt.substr(comma + 2, wkt.find_first_of(",]", comma + 2) - comma - 2);
  return absl::SimpleAtod(number, &metres) ? std::optional(metres) : std::nullopt;
}

absl::Status Invalid(const fs::path& path, const std::string& problem) {
  return absl::InvalidArgumentError(absl::StrCat(path.string(), ": ", problem));
}

}  // namespace

absl::StatusOr<AnnotatedLasFile> AnnotatedLasFile::Open(const fs::path& path) {
  ASSIGN_OR_RETURN(formats::LasReader reader, formats::LasReader::Open(path));
  AnnotatedLasFile file(std::move(reader));
  file.path_ = path;
  RETURN_IF_ERROR(file.FindFloats());
  RETURN_IF_ERROR(file.ReadSummary());
  RETURN_IF_ERROR(file.FindCrs());
  return file;
}

absl::Status AnnotatedLasFile::ReadSummary() {
  const fs::path summary = annotate::SummaryPath(path_);
  std::error_code error;
  if (!fs::exists(summary, error))
    return absl::NotFoundError(absl::StrCat(path_.string(), ": its summary ", summary.string(),
                                            " is missing; keep it beside the file", kRemedy));
  const Json read = annotate::ReadSummary(summary);
  summary_ = std::make_shared<const Json>(read);
  const Json total = IsOurs(read) ? read["answers"].value("total", Json()) : Json();
  const std::optional<Coverage> coverage =
      annotate::FindCoverage(total.is_object() && total.contains("coverage") && total["coverage"].is_string()
                                 ? total["coverage"].get<std::string>()
                                 : std::string());
  if (!coverage.has_value()) return Invalid(summary, absl::StrCat("is no summary of a total", kRemedy));
  coverage_ = *coverage;
  const Json size = read["output"].value("bytes", Json());
  if (size != reader_.file_size()) {
    return Invalid(path_, absl::StrCat("has ", reader_.file_size(), " bytes, its summary states ", size.dump(),
                                       " (the file was changed later)", kRemedy));
  }
  const Json beams = read["parameters"].value("incidence_from", Json());
  may_lack_surface_ = beams.is_string() && annotate::IsByAngle(beams.get<std::string>()) &&
                      read["answers"]["outcomes"].contains("NO_SURFACE");
  use_withheld_ = read["parameters"].value("use_withheld", Json()) == true;
  // What the user said of the times, or what trajectory, water levels or sea showed.
  const Json geometry = read["input"].value("geometry", Json());
  if (const Json unit = MemberOf(geometry, "seconds_per_time_unit"); unit.is_number()) seconds_per_time_unit_ = unit;
  Json clock = read["parameters"].value("time_format", Json());
  if (!clock.is_string()) clock = MemberOf(MemberOf(geometry, "trajectory"), "time_format");
  has_clock_of_header_ = !clock.is_string() || clock == formats::NameOf(formats::TimeFormat::kAuto) ||
                         clock == formats::NameOf(formats::TimeFormat::kAdjusted);
  const Json classes = read["parameters"].value("classes", Json());
  if (!classes.is_null() && !classes.is_array())
    return Invalid(summary, absl::StrCat("its classes are no list", kRemedy));
  for (const Json& each : classes) {
    if (!each.is_number_unsigned() || each >= formats::kClassCount)
      return Invalid(summary, absl::StrCat("has a class that LAS files cannot have", kRemedy));
    classes_.insert(each.get<int>());
  }
  if (classes_.empty()) classes_ = formats::DefaultClasses(reader_.header().point_format);
  for (const Json& channel : read["parameters"].value("channels", Json::array()))
    channels_.push_back({NumbersOf(channel, "scanner_channels"), NumbersOf(channel, "user_data")});
  const Json unit = read["parameters"].value("metres_per_unit", Json());
  if (!unit.is_null() && !(unit.is_number() && unit >= kMinUnit && unit <= kMaxUnit))
    return Invalid(summary, absl::StrCat("its metres_per_unit is no unit of length", kRemedy));
  for (const auto& [outcome, count] : read["answers"]["outcomes"].items())
    if (count > reader_.header().point_count)
      return Invalid(summary, absl::StrCat("has more outcomes than the file has points", kRemedy));
  return absl::OkStatus();
}

absl::Status AnnotatedLasFile::FindCrs() {
  ASSIGN_OR_RETURN(formats::CrsDescription description, formats::DescribeCrs(reader_));
  const Json& parameters = (*summary_)["parameters"];
  if (const Json user = parameters.value("crs", Json()); user.is_string()) description.user = user.get<std::string>();
  bool has_map = false;
  if (!description.empty()) {
    const absl::StatusOr<formats::LasCrs> crs = formats::CrsOf(reader_, description.user);
    const formats::MapFrame* const map = crs.ok() ? crs->map.get() : nullptr;
    if (map != nullptr && map->is_geographic()) {
      return Invalid(path_, absl::StrCat("has geographic coordinates (", map->crs_name(),
                                         "); a grid of square cells needs projected ones, such as UTM"));
    }
    if (map != nullptr) {
      RETURN_IF_ERROR(CheckTrueToScale(reader_, *map));
      crs_name_ = map->crs_name();
      crs_wkt_ = map->wkt();
      if (map->vertical().has_value()) vertical_name_ = map->vertical()->name, vertical_wkt_ = map->vertical()->wkt;
      has_map = true;
      metres_per_unit_ = map->unit();
      // Heights without a unit are metres, as albtpu-query las reads them.
      metres_per_height_unit_ = crs->metres_per_height_unit.value_or(1);
      // A unit of its own in GeoTIFF keys is none of the text.
      if (std::abs(UnitOfWkt(crs_wkt_).value_or(metres_per_unit_) / metres_per_unit_ - 1) > 1e-7) crs_wkt_.clear();
    } else {
      crs_name_ = "not understood";
    }
  }
  if (const Json named = (*summary_)["input"].value("vertical_datum", Json());
      vertical_name_.empty() && named.is_string())
    vertical_name_ = named.get<std::string>();
  // --units is that of heights. Without a coordinate system, x and y are in it, too.
  if (const Json unit = parameters.value("metres_per_unit", Json()); unit.is_number())
    metres_per_height_unit_ = unit.get<double>();
  if (!has_map) metres_per_unit_ = metres_per_height_unit_;
  return absl::OkStatus();
}

bool AnnotatedLasFile::has_dates() const {
  return formats::HasGpsTime(reader_.header().point_format) && reader_.header().adjusted_gps_time &&
         has_clock_of_header_ && seconds_per_time_unit_ == 1;
}

std::string AnnotatedLasFile::table_digest() const {
  const Json table = summary_->value("table", Json());
  const Json digest = table.is_object() ? table.value("digest", Json()) : Json();
  return digest.is_string() ? digest.get<std::string>() : "";
}

std::string AnnotatedLasFile::summary_digest() const {
  Sha256 digest;
  digest.Update(summary_->dump(-1, ' ', false, Json::error_handler_t::replace));
  return Hex(digest.Finish());
}

std::string DigestOfAnnotations(std::vector<std::string> summary_digests) {
  std::ranges::sort(summary_digests);
  Sha256 digest;
  for (const std::string& each : summary_digests) digest.Update(each);
  return Hex(digest.Finish());
}

Json LeftOutJson(const LeftOutPoints& points) { return {{"withheld", points.withheld}, {"noise", points.noise}}; }

Json MemberOf(const Json& json, const char* key) { return json.is_object() ? json.value(key, Json()) : Json(); }

std::string LeftOutText(const LeftOutPoints& points) {
  std::vector<std::string> parts;
  if (points.withheld > 0) parts.push_back(absl::StrCat(points.withheld, " withheld points"));
  if (points.noise > 0)
    parts.push_back(absl::StrCat(points.noise, " points of noise (classes ", formats::kLowNoise, " and ",
                                 formats::kHighNoise, ")"));
  return absl::StrCat(absl::StrJoin(parts, " and "), " take no part");
}

}  // namespace albtpu::quality
