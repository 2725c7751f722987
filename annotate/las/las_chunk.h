// A run of points of a LAS file: turns their records into records with the uncertainty, and on request the geometry of
// the beam, appended.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "annotate/answers/batch.h"
#include "annotate/answers/uncertainty_summary.h"
#include "annotate/beams/beam_plan.h"
#include "annotate/beams/point_beams.h"
#include "annotate/las/las_csv.h"
#include "annotate/seas/sea_timeline.h"
#include "annotate/totals/terrain_totals.h"
#include "annotate/totals/total_summary.h"
#include "budget/beams/terrain_planes.h"
#include "formats/clocks/dated_clock.h"
#include "formats/las/las_extra_bytes.h"
#include "formats/las/las_header.h"
#include "formats/las/las_points.h"

namespace albtpu::annotate {

// One of several scanners whose points are in one file.
struct LasChannel {
  std::string label;  // "scanner channel 1"
  formats::ScannerPoints points;
  BeamPlan plan;
  TotalPlan total;
};

struct LasAnnotation {
  std::optional<std::set<int>> classes;  // Of the bottom; absent: DefaultClasses of the format.
  BeamPlan plan;
  bool use_withheld = false;   // Points with this flag count as any other.
  bool terrain_slope = false;  // Heights of the ground are those at a fixed place (terrain_error.h). With a total.
  std::shared_ptr<const SeaTimeline> seas;  // Null where a table of winds answers.
  bool details = false;                     // Append the geometry of each beam, too.
  bool replace = false;                     // Take the place of floats of the same names (DescribeAppended).
  AnswerStyle style;
  std::optional<TotalPlan> total = {};  // Absent: the contribution of the sea surface alone.
  // Empty: the points are of one scanner. Otherwise `plan` and `total` are those of the first one; what belongs to no
  // sensor is the same in all plans.
  std::vector<LasChannel> channels = {};

  std::set<int> ClassesOf(int point_format) const;
  formats::Appended appended() const {
    return {.coverage = style.coverage,
            .total = total.has_value(),
            .water = total.has_value() && total->water.has_share(),
            .extra = total.has_value() && total->has_extra(),
            .details = details,
            .terrain = terrain_slope};
  }
  // How the sea is queried: for a total at 2 sigma.
  AnswerStyle style_of_sea() const;
};

// The ground of a file.
struct LasTerrain {
  const TerrainPlanes* planes = nullptr;  // Null: uncertainties are those of the points themselves.
  bool is_classified = false;             // As LasPrescan::terrain_is_classified.
  formats::LocalFrame frame = {};
};

// The settings of all chunks of a file.
class LasChunkWork {
 public:
  // `replaced`: as AnnotatedHead says. `beams` has those of each scanner, and must outlive it. `utc`: UTC [s since
  // 1970] of the time of a point, where the sea goes by time. `pulse_surface`: the water surface at a point may come
  // from a return of the same pulse.
  LasChunkWork(const formats::LasHeader& header, const LasAnnotation& annotation,
               const std::vector<formats::ReplacedFloat>& replaced, const std::vector<BeamGeometry>& beams,
               const formats::UtcClock& utc, bool pulse_surface, const AnswerSource& source,
               const LasTerrain& terrain = {});

  // Memory that is reused from chunk to chunk. The input is a run of points; points before and after its own are only
  // searched for returns of the same pulse.
  struct Chunk : formats::LasRun {
    explicit Chunk(AnswerStyle style) : summary(style) {}

    std::string annotated;  // Output: the own records, each followed by the appended bytes.
    std::string csv;        // The same as text, where it is wanted.
    formats::LasClassCounts classes;
    std::uint64_t withheld = 0, synthetic = 0;  // Of the chosen classes; withheld ones have no number.
    DrySummary dry;                             // Of dry points, where the plan has them.
    std::uint64_t sloped = 0;                   // Of these with the slope of the terrain.
    // By class: points below the water that are not of the ground, which have no number. And those of the ground there.
    std::map<int, std::uint64_t> submerged;
    std::uint64_t low_ground = 0;
    SurfaceCounts surface;
    CoordinateSpread incidence;  // degree, of the chosen points that have a beam.
    UncertaintySummary summary;
    TotalSummary totals;                         // Empty without a total.
    std::map<int, TotalSummary> totals_by_line;  // By point source id.
    // By scanner, where there are several: own points that may get a number, and their totals. And points of none.
    std::vector<std::uint64_t> points_by_channel;
    std::vector<TotalSummary> totals_by_channel;
    std::uint64_t dry_without_channel = 0;
    std::uint64_t sigmas_assumed = 0;  // As TotalBatch.

   private:
    friend class LasChunkWork;
    // A return from the water surface, by its index in `records`.
    struct WaterReturn {
      double time;
      std::size_t record;
    };

    std::vector<std::uint8_t> scanners;  // Of each own record, that of a point that may get a number; or kNoScanner.
    // The block of own records that is worked on; what follows is of one scanner in it.
    std::size_t begin = 0, end = 0;
    std::vector<std::uint32_t> chosen;  // Indices of own records.
    std::vector<WaterReturn> water;     // In order.
    SurveyPoints points;                // Of the chosen records.
    BeamScratch scratch;
    PointBeams beams;
    std::vector<std::uint32_t> rows;  // Of the points that have a pulse.
    PulseBatch pulses;
    AnswerBatch answers;
    AircraftColumns aircraft;  // Of the pulses.
    TotalBatch total;
    // The same of dry points.
    std::vector<std::uint32_t> dry_rows;
    std::vector<float> dry_incidence;
    AircraftColumns dry_aircraft;
    TotalBatch dry_total;
    std::vector<TerrainShare> dry_terrain;  // Empty without the slope of the terrain.
  };

  // Makes `csv` of chunks, too; it must outlive this.
  void MakeCsv(const LasCsv* csv) { csv_ = csv; }

  absl::Status operator()(Chunk& chunk) const;

 private:
  std::string_view Record(const Chunk& chunk, std::size_t i) const {
    return std::string_view(chunk.records).substr(i * record_length_, record_length_);
  }
  // One of the scanners of the file, or the only one.
  struct Scanner {
    std::size_t number;
    const formats::ScannerPoints* points;  // Null: all are its.
    const BeamPlan* plan;
    const BeamGeometry* beams;
    const TotalPlan* total;  // Null without a total.
  };
  static constexpr std::uint8_t kNoScanner = 255;

  // Counts.
  void Begin(Chunk& chunk) const;
  // The records of a block, without numbers.
  void CopyRecords(Chunk& chunk) const;
  std::uint8_t ScannerOf(std::string_view record) const;
  absl::Status Annotate(const Scanner& scanner, Chunk& chunk) const;
  void Decode(const Scanner& scanner, Chunk& chunk) const;
  void FindPulseSurface(const Scanner& scanner, Chunk& chunk) const;
  void FindSeas(Chunk& chunk) const;
  void FindTotals(const Scanner& scanner, Chunk& chunk) const;
  void FindDryTotals(const Scanner& scanner, Chunk& chunk) const;
  void FindTerrain(const Scanner& scanner, Chunk& chunk) const;
  // Columns of `rows` of the points.
  static void TakeAircraft(const BeamPlan& plan, const PointBeams& beams, const std::vector<std::uint32_t>& rows,
                           AircraftColumns& aircraft);
  void Summarize(Chunk& chunk) const;
  void Encode(const Scanner& scanner, Chunk& chunk) const;
  void Replace(Chunk& chunk) const;
  // Of row i of the totals, which is a dry one or a pulse in water.
  void EncodeTotals(const TotalPlan& plan, const Chunk& chunk, bool dry, std::size_t i, char* values) const;

  formats::LasPointFields fields_;
  std::size_t record_length_;
  LasTerrain terrain_;
  std::vector<Scanner> scanners_;
  const SeaTimeline* seas_;  // Null where all pulses have one sea, or a table of winds.
  formats::UtcClock utc_;
  bool pulse_surface_, use_withheld_, dry_points_;
  formats::Appended appended_;
  std::vector<formats::AppendedFloat> numbers_;  // What is appended or replaces: floats, and a byte at the end.
  std::string no_data_;                          // Its bytes where there is no number.
  std::vector<formats::ReplacedFloat> replaced_;
  std::size_t extra_bytes_begin_;  // In a record of the input.
  AnswerStyle style_;
  AnswerSelection selection_;
  std::array<bool, formats::kClassCount> is_chosen_ = {}, is_water_ = {}, is_dry_ = {}, is_terrain_ = {};
  std::array<bool, formats::kClassCount> is_ground_ = {}, is_on_water_ = {};
  AnswerSource source_;
  const LasCsv* csv_ = nullptr;
};

}  // namespace albtpu::annotate
