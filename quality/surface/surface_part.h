// The points of some files of a survey, and what is known of these files: what a surface is made of. One process makes
// it of all files; or each of several makes a part of some files, as a sealed file, and the surface is made of these.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "quality/annotated/annotated_points.h"
#include "quality/seas/sea_sharing.h"
#include "quality/surface/node.h"
#include "tables/coverage.h"

namespace albtpu::quality {

// Where points lie.
struct SurfaceMap {
  std::string crs_name, crs_wkt;            // The second is empty if it is not known.
  std::string vertical_name, vertical_wkt;  // Of heights in metres; empty if it is not known.
  double metres_per_unit = 1;               // Of x and y.

  // Of another file of the same datum: the first that is known as a system, or else the first name.
  void TakeVertical(const std::string& name, const std::string& wkt) {
    if (vertical_wkt.empty() && (vertical_name.empty() || !wkt.empty())) vertical_name = name, vertical_wkt = wkt;
  }
};

// A file that is in a part, so that none is taken twice.
struct PartFile {
  std::string name;
  std::uint64_t bytes = 0, points = 0;
  std::array<double, 6> bounds = {};  // Of x, y, z, as its header states them.
  auto operator<=>(const PartFile&) const = default;
};

struct SourceOfPoints {
  std::uint16_t sea = 0;  // Of `seas`.
  HorizontalGroups groups;
};

struct PartFacts {
  double cell = 1;  // m
  SurfaceMap map;
  Coverage coverage = Coverage::kTwoSigma;  // Of the files; the points are at 1 sigma.
  std::string table_digest;
  std::vector<PartFile> files;
  std::vector<std::string> summary_digests;  // Of each file.
  std::vector<SeaOfSource> seas;
  std::vector<SourceOfPoints> sources;  // By SurfacePoint::source.
  std::uint64_t with_number = 0, without_number = 0;
  std::optional<std::uint64_t> dry;  // Dry points, where they are asked for.
  LeftOutPoints left_out;
  std::optional<std::pair<double, double>> times;  // First and last, GPS seconds; of files that have dates.
};

// The number of the source of this sea and these groups; a new one where there is none. ResourceExhausted where there
// are more than the points can number.
absl::StatusOr<std::uint16_t> AddSource(PartFacts& facts, const SeaOfSource& sea, const HorizontalGroups& groups);

struct SurfacePart {
  std::filesystem::path path;
  PartFacts facts;
  std::uint64_t points_end = 0;  // Bytes: where the points end in the file.

  bool empty() const { return facts.files.empty(); }  // Of files without points, which leave nothing to know.
};

// Appends the facts to the points (PointTilesWriter), and a digest of everything. ResourceExhausted on a full disk.
absl::Status SealPart(const SurfacePart& part);

// DataLoss for a file that is none, was cut short or changed; InvalidArgument for one of another version.
absl::StatusOr<SurfacePart> OpenPart(const std::filesystem::path& path);

// What one process would know that read the files of all parts, none of them empty, which are put into the order of
// their files. `sources[i][j]` is the number of source j of part i. InvalidArgument, with the names of two, where parts
// differ in a setting, or have a file in common.
struct JoinedParts {
  PartFacts facts;
  std::vector<std::vector<std::uint16_t>> sources;
};
absl::StatusOr<JoinedParts> Join(std::vector<SurfacePart>& parts);

}  // namespace albtpu::quality
