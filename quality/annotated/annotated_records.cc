#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <string_view>
#include <utility>

#include "absl/strings/str_cat.h"
#include "annotate/run/file_progress.h"
#include "formats/files/ordered_pipeline.h"
#include "formats/las/las_extra_bytes.h"
#include "formats/las/las_points.h"
#include "laz/coding/little_endian.h"
#include "quality/annotated/annotated_points.h"
#include "quality/annotated/point_sample.h"
#include "status/status_macros.h"

namespace albtpu::quality {
namespace {

constexpr std::uint64_t kRunPoints = 1 << 14;

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
                                FloatOfPoint{"water_depth", &AnnotatedPoint::depth},
                                FloatOfPoint{"tvu_footprint", &AnnotatedPoint::tvu_footprint, true}};

constexpr float kGreatest = 1e6F;  // m or m^2; larger values are not plausible.

// Of a length or a variance: neither no-data (NaN or -1) nor beyond what is possible.
bool IsKnown(float value) { return value >= 0 && value <= kGreatest; }

float KnownOrZero(float value, bool signed_value) {
  return IsKnown(signed_value ? std::abs(value) : value) ? value : 0;
}

// Of a point without a number. Without a surface, beams of a trajectory are not known; beams known by angles are. Where
// those `may_lack_surface`, that is the more severe of two reasons why a depth is missing.
Gap GapOf(const AnnotatedPoint& point, bool may_lack_surface) {
  if (point.has_number) return Gap::kNone;
  const bool depth = point.depth >= 0, beam = std::isfinite(point.incidence);
  if (depth) return beam ? Gap::kNoAnswer : Gap::kNoTrajectory;
  return beam && !may_lack_surface ? Gap::kAboveWater : Gap::kNoSurface;
}

// What some records of a file hold.
struct MadePoints {
  std::vector<AnnotatedPoint> points;
  std::vector<DryPoint> dry;
  LeftOutPoints left_out;
  bool lacks_covariance = false;  // Some point with a total does.
};

// Angles without a direction give a total, which is that of the worst direction, and no covariance.
bool LacksCovariance(const AnnotatedPoint& point) {
  return IsKnown(point.thu) && IsKnown(point.tvu) && std::isnan(point.beam_azimuth) && std::isnan(point.variance_x);
}

}  // namespace

absl::Status AnnotatedLasFile::FindFloats() {
  ASSIGN_OR_RETURN(const std::string record, formats::ReadExtraBytesRecord(reader_));
  ASSIGN_OR_RETURN(const auto offsets, formats::FloatOffsets(reader_.name(), record, reader_.header().extra_bytes()));
  const std::size_t begin = reader_.header().record_length - reader_.header().extra_bytes();
  for (const FloatOfPoint& each : kFloats) {
    const auto found = offsets.find(each.name);
    if (found == offsets.end() && !each.may_lack)
      return absl::InvalidArgumentError(
          absl::StrCat(path_.string(), ": has no ", std::string(each.name), " in its extra bytes", kRemedy));
    offsets_.push_back(found == offsets.end() ? kAbsent : begin + found->second);
  }
  ASSIGN_OR_RETURN(const auto bytes, formats::ByteOffsets(reader_.name(), record, reader_.header().extra_bytes()));
  if (const auto found = bytes.find("share_of"); found != bytes.end()) share_of_ = begin + found->second;
  return absl::OkStatus();
}

// Makes points of the records of a file.
class AnnotatedLasFile::PointMaker {
 public:
  explicit PointMaker(const AnnotatedLasFile& file)
      : file_(file),
        fields_(file.reader_.header()),
        water_surface_(formats::WaterSurfaceClasses(file.reader_.header().point_format)) {
    for (const int each : file.classes_)
      if (each >= 0 && each < formats::kClassCount) wanted_[each] = true;
  }

  // What a record holds is added to `made`; of a dry point only `with_dry`.
  void Add(std::string_view record, bool with_dry, MadePoints& made) const {
    const int point_class = fields_.Class(record);
    if (point_class == formats::kLowNoise || point_class == formats::kHighNoise) {
      ++made.left_out.noise;
      return;
    }
    if (with_dry && file_.share_of_.has_value() &&
        static_cast<std::uint8_t>(record[*file_.share_of_]) == static_cast<std::uint8_t>(formats::ShareOf::kLand))
      AddDry(record, point_class, made);
    if (!wanted_[point_class]) return;
    if (!file_.use_withheld_ && fields_.IsWithheld(record)) {
      ++made.left_out.withheld;
      return;
    }
    AnnotatedPoint& point = made.points.emplace_back();
    Read(record, point);
    made.lacks_covariance |= LacksCovariance(point);
    point.has_number = IsKnown(point.thu) && IsKnown(point.tvu) && IsKnown(point.variance_x) &&
                       IsKnown(point.variance_y) && IsKnown(point.variance_z) && IsKnown(point.depth);
    const auto is_its = [&](const formats::ScannerPoints& scanner) { return scanner.Has(fields_, record); };
    const bool scanned = file_.channels_.empty() || point.has_number || std::ranges::any_of(file_.channels_, is_its);
    point.gap = scanned ? GapOf(point, file_.may_lack_surface_) : Gap::kNoChannel;
    TakeKnown(point);
  }

 private:
  void Read(std::string_view record, AnnotatedPoint& point) const {
    point.x = fields_.X(record);
    point.y = fields_.Y(record);
    point.z = fields_.Z(record) * file_.metres_per_height_unit_;
    if (fields_.has_gps_time()) point.time = fields_.GpsTime(record) * file_.seconds_per_time_unit_;
    point.line = fields_.PointSourceId(record);
    for (std::size_t k = 0; k < kFloats.size(); ++k)
      if (file_.offsets_[k] != kAbsent) point.*kFloats[k].member = laz::Load<float>(record, file_.offsets_[k]);
  }

  // A contribution or a bias that is not known is 0.
  static void TakeKnown(AnnotatedPoint& point) {
    for (float AnnotatedPoint::*const length :
         {&AnnotatedPoint::thu_sea, &AnnotatedPoint::tvu_air, &AnnotatedPoint::tvu_sea, &AnnotatedPoint::tvu_water,
          &AnnotatedPoint::tvu_extra, &AnnotatedPoint::tvu_pulse, &AnnotatedPoint::tvu_line,
          &AnnotatedPoint::tvu_footprint})
      point.*length = KnownOrZero(point.*length, false);
    for (float AnnotatedPoint::*const bias :
         {&AnnotatedPoint::bias_along_beam, &AnnotatedPoint::bias_vertical, &AnnotatedPoint::covariance_xy,
          &AnnotatedPoint::covariance_xz, &AnnotatedPoint::covariance_yz})
      point.*bias = KnownOrZero(point.*bias, true);
  }

  void AddDry(std::string_view record, int point_class, MadePoints& made) const {
    AnnotatedPoint dry;
    Read(record, dry);
    made.lacks_covariance |= LacksCovariance(dry);
    if (!(IsKnown(dry.variance_x) && IsKnown(dry.variance_y) && IsKnown(dry.tvu))) return;
    TakeKnown(dry);
    dry.depth = 0;
    dry.has_number = IsKnown(dry.variance_z);
    const auto variance = [&](float length) {
      const auto sigma = static_cast<float>(length / VerticalFactor(file_.coverage_));
      return sigma * sigma;
    };
    made.dry.push_back({.point_class = point_class,
                        .of_water_surface = water_surface_.contains(point_class),
                        .of_ground = formats::IsGround(point_class, file_.reader_.header().point_format),
                        .of_bottom = wanted_[point_class],
                        .variance_horizontal = dry.variance_x + dry.variance_y,
                        .variance_vertical = variance(dry.tvu),
                        .variance_footprint = variance(dry.tvu_footprint),
                        .point = dry});
  }

  const AnnotatedLasFile& file_;
  formats::LasPointFields fields_;
  std::array<bool, formats::kClassCount> wanted_ = {};
  std::set<int> water_surface_;
};

absl::StatusOr<LeftOutPoints> AnnotatedLasFile::ForEach(annotate::FileProgress& progress, const Visit& visit,
                                                        const VisitDry& visit_dry) const {
  annotate::FileProgress::File shown(progress, reader_.name());
  absl::StatusOr<formats::LasPointRuns> runs = formats::LasPointRuns::Open(reader_, 0, 0);
  if (!runs.ok()) return reader_.Named(runs.status());
  const formats::LasHeader& header = reader_.header();
  const PointMaker maker(*this);
  struct Chunk {
    formats::LasRun run;
    MadePoints made;
    std::vector<PointSample::Point> sample;
  };
  const auto sample = std::make_shared<PointSample>(header, use_withheld_);
  LeftOutPoints left_out;
  RETURN_IF_ERROR(formats::RunOrderedPipeline(
      [] { return Chunk(); },
      [&](Chunk& chunk) -> absl::StatusOr<bool> {
        const absl::StatusOr<bool> more = runs->Next(kRunPoints, chunk.run);
        return more.ok() ? more : reader_.Named(more.status());
      },
      [&](Chunk& chunk) {
        chunk.made.points.clear(), chunk.made.dry.clear();
        chunk.made.left_out = {}, chunk.made.lacks_covariance = false;
        for (std::size_t i = 0; i < chunk.run.own; ++i)
          maker.Add(std::string_view(chunk.run.records).substr(i * header.record_length, header.record_length),
                    static_cast<bool>(visit_dry), chunk.made);
        if (files_ != nullptr) chunk.sample = sample->Choose(chunk.run.records);
        return absl::OkStatus();
      },
      [&](Chunk& chunk) -> absl::Status {
        if (chunk.made.lacks_covariance)
          return absl::InvalidArgumentError(absl::StrCat(
              path_.string(),
              ": was annotated without the directions of its beams, so that its points have no covariance; annotate it "
              "again with --trajectory, or give --beam-azimuth or --flight-direction beside the angles"));
        for (const DryPoint& dry : chunk.made.dry) visit_dry(dry);
        visit(chunk.made.points);
        left_out.Add(chunk.made.left_out);
        sample->Add(chunk.sample);
        const std::uint64_t done = chunk.run.first + chunk.run.own;
        const double share =
            static_cast<double>(done) / static_cast<double>(std::max<std::uint64_t>(header.point_count, 1));
        shown.Reach(static_cast<std::uint64_t>(share * static_cast<double>(reader_.file_size())), done);
        return absl::OkStatus();
      }));
  RETURN_IF_ERROR(reader_.CheckUnchanged());
  if (files_ != nullptr) RETURN_IF_ERROR(files_->Add(path_, sample));
  return left_out;
}

}  // namespace albtpu::quality
