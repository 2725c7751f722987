#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "absl/strings/str_cat.h"
#include "budget/total/error_ellipse.h"
#include "formats/clocks/trajectory_time.h"
#include "quality/crosscheck/cross_check.h"
#include "quality/surface/point_tiles.h"
#include "quality/surface/survey_surface.h"
#include "status/status_macros.h"

namespace albtpu::quality {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr double kAdjustment = 1e9;  // s, from the times of files with dates to GPS time; exact.

PartFile NameOf(const AnnotatedLasFile& file) {
  const auto& header = file.reader().header();
  return {.name = file.path().filename().string(),
          .bytes = file.reader().file_size(),
          .points = header.point_count,
          .bounds = {header.least[0], header.least[1], header.least[2], header.greatest[0], header.greatest[1],
                     header.greatest[2]}};
}

// With the water of all files alike: the sea's share depends on its index.
absl::Status CheckWater(const AnnotatedLasFile& first, const AnnotatedLasFile& file, const PartFacts& facts) {
  const auto other = std::ranges::find_if(
      facts.seas, [&](const SeaOfSource& sea) { return sea.water_index != facts.seas.front().water_index; });
  if (other == facts.seas.end()) return absl::OkStatus();
  return absl::InvalidArgumentError(absl::StrCat(file.path().string(), ": was annotated with the index of the water ",
                                                 other->water_index, " (", first.path().string(), " with ",
                                                 facts.seas.front().water_index, "); annotate all files with one"));
}

}  // namespace

HorizontalGroups GroupsOf(const AnnotatedLasFile& file, bool dry) {
  const Json& answers = file.summary()["answers"];
  const Json all = dry ? MemberOf(answers, "dry") : MemberOf(MemberOf(answers, "total"), "all");
  const Json groups = MemberOf(all, "groups_horizontal");
  const auto fraction = [](const Json& shares, const char* name) {
    const Json number = MemberOf(shares, name);
    return number.is_number() ? number.get<double>() : 0.0;
  };
  const double rest = 1 - fraction(MemberOf(all, "shares_horizontal"), "sea");
  if (!groups.is_object()) return {.pulse = 0, .line = 0, .survey = 1};  // Not stated: nothing averages out.
  if (!(rest > 0)) return {};
  // To a hundredth, so that files of one survey have the same ones.
  const auto part = [&](const char* name) {
    return std::round(100 * std::clamp(fraction(groups, name) / rest, 0.0, 1.0)) / 100;
  };
  const double line = part("line"), survey = std::min(part("survey"), 1 - line);
  return {.pulse = 1 - line - survey, .line = line, .survey = survey};
}

SurfacePoint SurfacePointOf(const AnnotatedPoint& point, Coverage coverage, std::uint16_t source) {
  const double factor = VerticalFactor(coverage);
  const auto variance = [factor](float length) {
    const double sigma = length / factor;
    return static_cast<float>(sigma * sigma);
  };
  SurfacePoint of{.x = point.x, .y = point.y, .z = point.z, .time = point.time};
  of.sea = variance(point.tvu_sea);
  of.pulse = std::max(variance(point.tvu_pulse) - of.sea, 0.F);
  of.line = variance(point.tvu_line);
  of.survey = std::max(point.variance_z - of.sea - of.pulse - of.line, 0.F);
  of.xx = point.variance_x, of.yy = point.variance_y, of.xy = point.covariance_xy;
  of.xz = point.covariance_xz, of.yz = point.covariance_yz;
  of.incidence = point.incidence, of.azimuth = point.beam_azimuth, of.footprint = point.footprint;
  of.depth = point.depth, of.bias = point.bias_vertical, of.bias_along_beam = point.bias_along_beam;
  of.flight_line = static_cast<std::uint16_t>(point.line);
  of.source = source;
  return of;
}

SurfacePoint DrySurfacePointOf(const DryPoint& dry, Coverage coverage, const HorizontalGroups& groups,
                               std::uint16_t source) {
  SurfacePoint of = SurfacePointOf(dry.point, coverage, source);
  of.depth = NAN;
  // With --terrain-slope the groups are those of the height at a fixed place, with the spread of the footprint in that
  // of the pulse. A node has a slope of its own.
  const double by_slope = dry.variance_vertical - dry.variance_footprint - dry.point.variance_z;
  of.pulse = std::max(of.pulse - static_cast<float>(dry.variance_footprint + groups.pulse * by_slope), 0.F);
  of.line = std::max(of.line - static_cast<float>(groups.line * by_slope), 0.F);
  of.survey = std::max(dry.point.variance_z - of.pulse - of.line, 0.F);
  return of;
}

SurfaceMap MapOf(const AnnotatedLasFile& file) {
  return {.crs_name = file.crs_name(),
          .crs_wkt = file.crs_wkt(),
          .vertical_name = file.vertical_name(),
          .vertical_wkt = file.vertical_wkt(),
          .metres_per_unit = file.metres_per_unit()};
}

absl::StatusOr<SurfacePart> GatherPoints(const std::vector<AnnotatedLasFile>& files, const SurfaceOptions& options,
                                         const fs::path& path) {
  SurfacePart part = {.path = path, .facts = {}, .points_end = 0};
  PartFacts& facts = part.facts;
  facts.cell = options.cell;
  if (options.land) facts.dry = 0;
  if (!files.empty()) {
    const AnnotatedLasFile& first = files.front();
    facts.map = MapOf(first);
    facts.coverage = first.coverage();
    facts.table_digest = first.table_digest();
  }
  ASSIGN_OR_RETURN(PointTilesWriter writer, PointTilesWriter::Create(path, options.cell / facts.map.metres_per_unit));
  annotate::FileProgress progress = ProgressOver(files);
  for (const AnnotatedLasFile& file : files) {
    progress.NextFile();
    ASSIGN_OR_RETURN(const SeaOfSource sea, SeaOfFile(file, options.seas));
    ASSIGN_OR_RETURN(const std::uint16_t source, AddSource(facts, sea, GroupsOf(file, false)));
    const HorizontalGroups dry_groups = GroupsOf(file, true);
    std::uint16_t dry_source = source;
    if (options.land) {
      ASSIGN_OR_RETURN(dry_source, AddSource(facts, sea, dry_groups));
    }
    RETURN_IF_ERROR(CheckWater(files.front(), file, facts));
    const bool has_dates = file.has_dates();
    const auto add = [&](const SurfacePoint& point) {
      writer.Add(point);
      if (!has_dates || formats::IsNoTime(point.time) || std::abs(point.time) > kLastDate) return;
      const double time = point.time + kAdjustment;
      if (!facts.times.has_value()) facts.times = {time, time};
      facts.times->first = std::min(facts.times->first, time);
      facts.times->second = std::max(facts.times->second, time);
    };
    const AnnotatedLasFile::VisitDry add_dry = [&](const DryPoint& dry) {
      if (!dry.point.has_number || !(dry.of_bottom || dry.of_ground)) return;
      ++*facts.dry;
      add(DrySurfacePointOf(dry, facts.coverage, dry_groups, dry_source));
    };
    ASSIGN_OR_RETURN(const LeftOutPoints of_file,
                     file.ForEach(
                         progress,
                         [&](std::span<const AnnotatedPoint> points) {
                           for (const AnnotatedPoint& point : points) {
                             ++(point.has_number ? facts.with_number : facts.without_number);
                             if (point.has_number) add(SurfacePointOf(point, facts.coverage, source));
                           }
                         },
                         options.land ? add_dry : nullptr));
    facts.left_out.Add(of_file);
    facts.files.push_back(NameOf(file));
    facts.summary_digests.push_back(file.summary_digest());
    facts.map.TakeVertical(file.vertical_name(), file.vertical_wkt());
  }
  RETURN_IF_ERROR(writer.Finish());
  part.points_end = fs::file_size(path);
  return part;
}

}  // namespace albtpu::quality
