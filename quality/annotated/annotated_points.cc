#include "quality/annotated/annotated_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "annotate/answers/batch.h"
#include "annotate/beams/beam_plan.h"
#include "annotate/run/file_jobs.h"
#include "annotate/run/file_progress.h"
#include "formats/crs/map_frame.h"
#include "formats/las/las_crs.h"
#include "formats/las/las_extra_bytes.h"
#include "formats/las/las_points.h"
#include "laz/coding/little_endian.h"
#include "status/status_macros.h"

namespace albtpu::quality {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::uint64_t kRunPoints = 1 << 16;
constexpr char kRemedy[] = "; annotate its input again by albtpu-query las with --survey or --sensor and --details";

struct FloatOfPoint {
  std::string_view name;
  float AnnotatedPoint::*member;
  bool may_lack = false;  // Only where the survey has it.
};

constexpr std::size_t kAbsent = 0;  // A record begins with its coordinates.

constexpr std::array kFloats = {FloatOfPoint{"total_thu", &AnnotatedPoint::thu},
                                FloatOfPoint{"total_tvu", &AnnotatedPoint::tvu},
                                FloatOfPoint{"tvu_air", &AnnotatedPoint::tvu_air},
                                FloatOfPoint{"thu_sea", &AnnotatedPoint::thu_sea},
                                FloatOfPoint{"tvu_sea", &AnnotatedPoint::tvu_sea},
                                FloatOfPoint{"tvu_water", &AnnotatedPoint::tvu_water},
                                FloatOfPoint{"tvu_extra", &AnnotatedPoint::tvu_extra, true},
                                FloatOfPoint{"tvu_pulse", &AnnotatedPoint::tvu_pulse},
                                FloatOfPoint{"tvu_line", &AnnotatedPoint::tvu_line},
                                FloatOfPoint{"bias_along_beam", &AnnotatedPoint::bias_along_beam},
                                FloatOfPoint{"bias_vertical", &AnnotatedPoint::bias_vertical},
                                FloatOfPoint{"VarianceX", &AnnotatedPoint::variance_x},
                                FloatOfPoint{"VarianceY", &AnnotatedPoint::variance_y},
                                FloatOfPoint{"VarianceZ", &AnnotatedPoint::variance_z},
                                FloatOfPoint{"CovarianceXY", &AnnotatedPoint::covariance_xy},
                                FloatOfPoint{"CovarianceXZ", &AnnotatedPoint::covariance_xz},
                                FloatOfPoint{"CovarianceYZ", &AnnotatedPoint::covariance_yz},
                                FloatOfPoint{"incidence", &AnnotatedPoint::incidence},
                                FloatOfPoint{"beam_azimuth", &AnnotatedPoint::beam_azimuth},
                                FloatOfPoint{"footprint", &AnnotatedPoint::footprint},
                                FloatOfPoint{"water_depth", &AnnotatedPoint::depth}};

constexpr double kMinUnit = 1e-3, kMaxUnit = 1e3;  // m
constexpr float kGreatest = 1e6F;                  // m or m^2; larger values are not plausible.

// Of a length or a variance: neither no-data (NaN or -1) nor beyond what is possible.
bool IsKnown(float value) { return value >= 0 && value <= kGreatest; }

float KnownOrZero(float value, bool signed_value) {
  return IsKnown(signed_value ? std::abs(value) : value) ? value : 0;
}

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

std::set<int> NumbersOf(const Json& channel, const char* key) {
  std::set<int> numbers;
  for (const Json& number : channel.is_object() ? channel.value(key, Json::array()) : Json::array())
    if (number.is_number_unsigned() && number <= 255) numbers.insert(number.get<int>());
  return numbers;
}

// Of a point without a number. Without a surface, beams of a trajectory are not known; beams known by angles are. Where
// those `may_lack_surface`, that is the more severe of two reasons why a depth is missing.
Gap GapOf(const AnnotatedPoint& point, bool may_lack_surface) {
  if (point.has_number) return Gap::kNone;
  const bool depth = point.depth >= 0, beam = std::isfinite(point.incidence);
  if (depth) return beam ? Gap::kNoAnswer : Gap::kNoTrajectory;
  return beam && !may_lack_surface ? Gap::kAboveWater : Gap::kNoSurface;
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

absl::Status AnnotatedLasFile::FindFloats() {
  ASSIGN_OR_RETURN(const std::string record, formats::ReadExtraBytesRecord(reader_));
  ASSIGN_OR_RETURN(const auto offsets, formats::FloatOffsets(reader_.name(), record, reader_.header().extra_bytes()));
  const std::size_t begin = reader_.header().record_length - reader_.header().extra_bytes();
  for (const FloatOfPoint& each : kFloats) {
    const auto found = offsets.find(each.name);
    if (found == offsets.end() && !each.may_lack)
      return Invalid(path_, absl::StrCat("has no ", std::string(each.name), " in its extra bytes", kRemedy));
    offsets_.push_back(found == offsets.end() ? kAbsent : begin + found->second);
  }
  ASSIGN_OR_RETURN(const auto bytes, formats::ByteOffsets(reader_.name(), record, reader_.header().extra_bytes()));
  if (const auto found = bytes.find("share_of"); found != bytes.end()) share_of_ = begin + found->second;
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
  // --units is that of heights. Without a coordinate system, x and y are in it, too.
  if (const Json unit = parameters.value("metres_per_unit", Json()); unit.is_number())
    metres_per_height_unit_ = unit.get<double>();
  if (!has_map) metres_per_unit_ = metres_per_height_unit_;
  return absl::OkStatus();
}

bool AnnotatedLasFile::has_dates() const {
  return formats::HasGpsTime(reader_.header().point_format) && reader_.header().adjusted_gps_time;
}

std::string AnnotatedLasFile::table_digest() const {
  const Json table = summary_->value("table", Json());
  const Json digest = table.is_object() ? table.value("digest", Json()) : Json();
  return digest.is_string() ? digest.get<std::string>() : "";
}

absl::StatusOr<LeftOutPoints> AnnotatedLasFile::ForEach(annotate::FileProgress& progress, const Visit& visit,
                                                        const VisitDry& visit_dry) const {
  annotate::FileProgress::File shown(progress, reader_.name());
  absl::StatusOr<formats::LasPointRuns> runs = formats::LasPointRuns::Open(reader_, 0, 0);
  if (!runs.ok()) return reader_.Named(runs.status());
  const formats::LasHeader& header = reader_.header();
  const formats::LasPointFields fields(header);
  std::array<bool, formats::kClassCount> wanted = {};
  for (const int each : classes_)
    if (each >= 0 && each < formats::kClassCount) wanted[each] = true;
  const std::set<int> water_surface = formats::WaterSurfaceClasses(header.point_format);
  const auto read_floats = [&](std::string_view record, AnnotatedPoint& point) {
    for (std::size_t k = 0; k < kFloats.size(); ++k)
      if (offsets_[k] != kAbsent) point.*kFloats[k].member = laz::Load<float>(record, offsets_[k]);
  };
  formats::LasRun run;
  LeftOutPoints left_out;
  std::vector<AnnotatedPoint> points;
  while (true) {
    const absl::StatusOr<bool> more = runs->Next(kRunPoints, run);
    if (!more.ok()) return reader_.Named(more.status());
    if (!*more) break;
    points.clear();
    for (std::size_t i = 0; i < run.own; ++i) {
      const std::string_view record =
          std::string_view(run.records).substr(i * header.record_length, header.record_length);
      const int point_class = fields.Class(record);
      if (point_class == formats::kLowNoise || point_class == formats::kHighNoise) {
        ++left_out.noise;
        continue;
      }
      if (visit_dry && share_of_.has_value() &&
          static_cast<std::uint8_t>(record[*share_of_]) == static_cast<std::uint8_t>(formats::ShareOf::kLand)) {
        AnnotatedPoint dry;
        read_floats(record, dry);
        const auto sigma = static_cast<float>(dry.tvu / VerticalFactor(coverage_));
        if (IsKnown(dry.variance_x) && IsKnown(dry.variance_y) && IsKnown(dry.tvu))
          visit_dry({.point_class = point_class,
                     .of_water_surface = water_surface.contains(point_class),
                     .variance_horizontal = dry.variance_x + dry.variance_y,
                     .variance_vertical = sigma * sigma});
      }
      if (!wanted[point_class]) continue;
      if (!use_withheld_ && fields.IsWithheld(record)) {
        ++left_out.withheld;
        continue;
      }
      AnnotatedPoint& point = points.emplace_back();
      point.x = fields.X(record);
      point.y = fields.Y(record);
      point.z = fields.Z(record) * metres_per_height_unit_;
      if (fields.has_gps_time()) point.time = fields.GpsTime(record);
      point.line = fields.PointSourceId(record);
      read_floats(record, point);
      point.has_number = IsKnown(point.thu) && IsKnown(point.tvu) && IsKnown(point.variance_x) &&
                         IsKnown(point.variance_y) && IsKnown(point.variance_z) && IsKnown(point.depth);
      const auto is_its = [&](const formats::ScannerPoints& scanner) { return scanner.Has(fields, record); };
      const bool scanned = channels_.empty() || point.has_number || std::ranges::any_of(channels_, is_its);
      point.gap = scanned ? GapOf(point, may_lack_surface_) : Gap::kNoChannel;
      for (float AnnotatedPoint::*const length :
           {&AnnotatedPoint::thu_sea, &AnnotatedPoint::tvu_air, &AnnotatedPoint::tvu_sea, &AnnotatedPoint::tvu_water,
            &AnnotatedPoint::tvu_extra, &AnnotatedPoint::tvu_pulse, &AnnotatedPoint::tvu_line})
        point.*length = KnownOrZero(point.*length, false);
      for (float AnnotatedPoint::*const bias :
           {&AnnotatedPoint::bias_along_beam, &AnnotatedPoint::bias_vertical, &AnnotatedPoint::covariance_xy,
            &AnnotatedPoint::covariance_xz, &AnnotatedPoint::covariance_yz})
        point.*bias = KnownOrZero(point.*bias, true);
    }
    visit(points);
    const std::uint64_t done = run.first + run.own;
    shown.Reach(header.point_count > 0 ? reader_.file_size() * done / header.point_count : 0, done);
  }
  RETURN_IF_ERROR(reader_.CheckUnchanged());
  return left_out;
}

Json LeftOutJson(const LeftOutPoints& points) { return {{"withheld", points.withheld}, {"noise", points.noise}}; }

std::string LeftOutText(const LeftOutPoints& points) {
  std::vector<std::string> parts;
  if (points.withheld > 0) parts.push_back(absl::StrCat(points.withheld, " withheld points"));
  if (points.noise > 0)
    parts.push_back(absl::StrCat(points.noise, " points of noise (classes ", formats::kLowNoise, " and ",
                                 formats::kHighNoise, ")"));
  return absl::StrCat(absl::StrJoin(parts, " and "), " take no part");
}

}  // namespace albtpu::quality
