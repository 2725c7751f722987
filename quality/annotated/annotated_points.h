// The points of LAS and LAZ files that `albtpu-query las --details` annotated with a total.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "annotate/run/file_progress.h"
#include "formats/las/las_points.h"
#include "formats/las/las_reader.h"
#include "tables/coverage.h"

namespace albtpu::quality {

class SampledFiles;

// Why a point has no number, in order of severity. kNoAnswer: outside the table, or no state of the sea or optics of
// the water at it. kNoTrajectory: none at its time, or one that is too uncertain. kNoChannel: of a scanner that the
// survey does not have.
enum class Gap : std::uint8_t { kNone, kAboveWater, kNoAnswer, kNoSurface, kNoTrajectory, kNoChannel };

inline constexpr double kLastDate = 9e10;  // s, some 2850 years; later times are no dates.

// Points that take no part, and are counted apart.
struct LeftOutPoints {
  std::uint64_t withheld = 0;  // Of the bathymetric classes, by their flag.
  std::uint64_t noise = 0;     // Of classes 7 and 18, whatever the bathymetric classes are.

  bool empty() const { return withheld == 0 && noise == 0; }
  void Add(const LeftOutPoints& other) { withheld += other.withheld, noise += other.noise; }
};

nlohmann::ordered_json LeftOutJson(const LeftOutPoints& points);

// "12 withheld points and 3 points of noise (classes 7 and 18) take no part".
std::string LeftOutText(const LeftOutPoints& points);

// SHA-256 of the digests of summaries (AnnotatedLasFile::summary_digest), whatever their order is.
std::string DigestOfAnnotations(std::vector<std::string> summary_digests);

// The member of an object of a summary; null where there is none.
nlohmann::ordered_json MemberOf(const nlohmann::ordered_json& json, const char* key);

// A point of the bathymetric classes. Lengths in m but for x and y, which are those of the file; THU and TVU at the
// coverage of the file; variances at 1 sigma, on the axes of the file. A contribution that was left out is 0, and so is
// an unknown bias.
struct AnnotatedPoint {
  double x = 0, y = 0, z = 0;
  double time = 0;  // s, by the clock of the file (LasPointFields::GpsTime); 0 if its points have none.
  int line = 0;     // Point source ID.
  Gap gap = Gap::kNone;
  bool has_number = false;  // Otherwise only the members above are known.
  float thu = 0, tvu = 0;
  float tvu_air = 0, tvu_sea = 0, tvu_water = 0, tvu_extra = 0;  // Contributions.
  float tvu_pulse = 0,
        tvu_line = 0;  // The parts that are independent from pulse to pulse, and from line to line.
  float bias_along_beam = 0, bias_vertical = 0;
  float thu_sea = 0;
  float variance_x = 0, variance_y = 0, variance_z = 0;
  float covariance_xy = 0, covariance_xz = 0, covariance_yz = 0;
  float incidence = 0, beam_azimuth = 0;  // degree; clockwise from north, where the beam travels to.
  float footprint = 0;                    // m
  float depth = 0;
  float tvu_footprint = 0;  // Of a dry point, with --terrain-slope.
};

// A point whose beam met no water before it, with a total of the air side.
struct DryPoint {
  int point_class = 0;
  // By its class: 9, or one that surface returns usually have; the ground; one of the classes of the bottom.
  bool of_water_surface = false, of_ground = false, of_bottom = false;
  float variance_horizontal = 0;  // m^2 at 1 sigma, of both axes together.
  float variance_vertical = 0;    // Of the total: with --terrain-slope that of the height at a fixed place.
  float variance_footprint = 0;   // The part of it that the spread of the footprint over the slope adds.
  AnnotatedPoint point = {};      // All of it; without a depth.
};

class AnnotatedLasFile {
 public:
  // Fails on a file without our extra bytes or without the summary beside it, and on one that was annotated without a
  // total, without --details or in geographic coordinates.
  static absl::StatusOr<AnnotatedLasFile> Open(const std::filesystem::path& path);

  const std::filesystem::path& path() const { return path_; }
  const nlohmann::ordered_json& summary() const { return *summary_; }
  const formats::LasReader& reader() const { return reader_; }
  Coverage coverage() const { return coverage_; }
  std::string table_digest() const;
  std::string summary_digest() const;  // SHA-256 of the summary, which is another one for another annotation.
  const std::string& crs_name() const { return crs_name_; }  // "not stated" if the file states none.
  const std::string& crs_wkt() const { return crs_wkt_; }
  // Of the heights in metres; where the file does not state their datum, the name that the surveyor gave, or empty.
  const std::string& vertical_name() const { return vertical_name_; }
  const std::string& vertical_wkt() const { return vertical_wkt_; }
  bool has_dates() const;  // Whether times are GPS seconds - 1e9, as the header says.
  double metres_per_unit() const { return metres_per_unit_; }  // Of x and y.
  double metres_per_height_unit() const { return metres_per_height_unit_; }

  // ForEach fails where points are those of another file.
  void CompareWith(std::shared_ptr<SampledFiles> files) { files_ = std::move(files); }

  using Visit = std::function<void(std::span<const AnnotatedPoint>)>;

  using VisitDry = std::function<void(const DryPoint&)>;

  // All bathymetric points in their order, some at a time, without those left out. Also each dry point with a total, of
  // whatever class: a bathymetric one is visited as both. Visits come one after the other, from several threads. Fails
  // when the file cannot be read or was modified.
  absl::StatusOr<LeftOutPoints> ForEach(annotate::FileProgress& progress, const Visit& visit,
                                        const VisitDry& visit_dry = {}) const;

 private:
  static constexpr char kRemedy[] =
      "; annotate its input again by albtpu-query las with --survey or --sensor and --details";
  class PointMaker;

  explicit AnnotatedLasFile(formats::LasReader reader) : reader_(std::move(reader)) {}
  absl::Status ReadSummary();
  absl::Status FindFloats();
  absl::Status FindCrs();

  std::filesystem::path path_;
  formats::LasReader reader_;
  std::shared_ptr<const nlohmann::ordered_json> summary_;
  Coverage coverage_ = Coverage::kTwoSigma;
  std::set<int> classes_;
  std::vector<formats::ScannerPoints> channels_;  // Empty: all points are of one scanner.
  bool use_withheld_ = false;                     // As --use-withheld of the annotation.
  bool may_lack_surface_ = false;                 // Of points whose beams are known by angles.
  std::vector<std::size_t> offsets_;              // In a record, by kFloats of the implementation.
  std::optional<std::size_t> share_of_;           // In a record; absent: annotated without dry points.
  std::string crs_name_ = "not stated", crs_wkt_, vertical_name_, vertical_wkt_;
  double metres_per_unit_ = 1, metres_per_height_unit_ = 1, seconds_per_time_unit_ = 1;
  bool has_clock_of_header_ = true;      // Otherwise another one was named or found.
  std::shared_ptr<SampledFiles> files_;  // Null: there is no other one.
};

}  // namespace albtpu::quality
