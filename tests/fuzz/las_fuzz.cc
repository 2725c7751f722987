// Arbitrary bytes as a LAS file are rejected with a reason, or annotated such that every byte is kept and the output
// is a LAS file that describes its uncertainties: with incidences from scan angles, and from the positions of a sensor.
#include <cmath>
#include <string>
#include <string_view>

#include "annotate/beams/water_heights.h"
#include "annotate/las/las_chunk.h"
#include "annotate/las/las_prescan.h"
#include "budget/beams/ray_track.h"
#include "formats/las/las_crs.h"
#include "formats/las/las_extra_bytes.h"
#include "formats/las/las_reader.h"
#include "formats/las/las_writer.h"
#include "formats/laz/coding/little_endian.h"
#include "service/client/local_source.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/memory_file.h"
#include "tests/tables/synthetic_table.h"

namespace {

using namespace albtpu;
using namespace albtpu::annotate;
using namespace albtpu::client;
using namespace albtpu::formats;
using laz::Load;

// A sensor that flies with the times of the points, is not known at some of them, and stands in another place than most
// points have.
class FlyingSensor final : public SensorTrack {
 public:
  void PositionsAt(std::span<const double> times, std::span<SensorPosition> positions,
                   std::span<TrackOutcome> outcomes) const override {
    for (std::size_t i = 0; i < times.size(); ++i) {
      outcomes[i] = !(std::abs(times[i]) < 1e9) ? TrackOutcome::kOutside
                    : times[i] < 0              ? TrackOutcome::kUncertain
                                                : TrackOutcome::kKnown;
      positions[i] = {.x = 50 * std::fmod(times[i], 100), .y = -10, .z = 400, .convergence = 0.02};
    }
  }
};

LasAnnotation Annotation() {
  LasAnnotation annotation;
  annotation.classes.emplace();
  for (int point_class = 0; point_class < kClassCount; point_class += 2) annotation.classes->insert(point_class);
  annotation.plan.source = AcrossTrackScan{.flight_direction = 10, .altitude = 400};
  annotation.plan.wind_speed = 5;
  annotation.plan.wind_from = 200;
  annotation.plan.footprint = DivergingBeam{.divergence = 1};
  annotation.plan.water_level = 0;
  annotation.plan.water_classes = {9, 27, 41};
  annotation.details = true;
  return annotation;
}

// The water is known from returns alone.
LasAnnotation TrackAnnotation() {
  LasAnnotation annotation = Annotation();
  annotation.plan.source = TrajectoryFromReturns();
  annotation.plan.water_level.reset();
  return annotation;
}

std::string_view Record(std::string_view file, const LasHeader& header, std::size_t i) {
  return file.substr(header.offset_to_points + i * header.record_length, header.record_length);
}

void CheckRecords(std::string_view before, const LasHeader& old_header, std::string_view after, const LasHeader& header,
                  float largest_incidence) {
  ALBTPU_MUST(header.point_count == old_header.point_count && header.point_format == old_header.point_format);
  ALBTPU_MUST(header.record_length ==
              old_header.record_length + AppendedFloats({.details = true}).size() * sizeof(float));
  for (std::size_t i = 0; i < header.point_count; ++i) {
    const std::string_view record = Record(after, header, i);
    ALBTPU_MUST(record.substr(0, old_header.record_length) == Record(before, old_header, i));
    const auto thu = Load<float>(record, old_header.record_length);
    const auto tvu = Load<float>(record, old_header.record_length + sizeof(float));
    ALBTPU_MUST((thu == kNoNumber && tvu == kNoNumber) || (thu >= 0 && tvu >= 0));
    const auto detail = [&](std::size_t at) {
      return Load<float>(record, old_header.record_length + (kUncertaintyCount + at) * sizeof(float));
    };
    const float incidence = detail(0), azimuth = detail(1);
    ALBTPU_MUST(std::isnan(incidence) || (incidence >= 0 && incidence <= largest_incidence));
    ALBTPU_MUST(std::isnan(azimuth) || (azimuth >= 0 && azimuth < 360));
    for (const std::size_t length : {2, 3, 4}) ALBTPU_MUST(detail(length) == kNoNumber || detail(length) >= 0);
  }
}

void CheckVlrs(std::string_view before, const std::vector<VlrEntry>& old_entries, std::string_view after,
               const std::vector<VlrEntry>& entries) {
  const auto is_ours = [](const VlrEntry& entry) { return entry.Is(kSpecUser, kExtraBytesRecord); };
  std::size_t i = 0;
  for (const VlrEntry& old_entry : old_entries) {
    while (i < entries.size() && is_ours(entries[i]) && !is_ours(old_entry)) ++i;
    ALBTPU_MUST(i < entries.size());
    if (!is_ours(old_entry)) {
      const auto all = [](std::string_view file, const VlrEntry& entry) {
        return file.substr(entry.offset, entry.end() - entry.offset);
      };
      ALBTPU_MUST(all(before, old_entry) == all(after, entries[i]));
    }
    ++i;
  }
}

// A track from whatever pairs of returns the file has, known or not, has finite positions.
void CheckFittedTrack(const LasPrescan& prescan, const WaterHeights& water) {
  const std::vector<AirRay> rays = RaysOfPairs(prescan.pairs, water, LocalFrame(), kSeaWaterIndex);
  const RayTrack track = FitTrack(rays);
  std::vector<double> times;
  for (const AirRay& ray : rays) times.push_back(ray.time);
  std::vector<SensorPosition> positions(times.size());
  std::vector<TrackOutcome> outcomes(times.size());
  track.PositionsAt(times, positions, outcomes);
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (outcomes[i] != TrackOutcome::kKnown) continue;
    ALBTPU_MUST(std::isfinite(positions[i].x) && std::isfinite(positions[i].y));
    ALBTPU_MUST(std::isfinite(positions[i].z));
  }
}

std::string Annotated(std::string_view file, const LasReader& reader, const std::string& head,
                      const LasAnnotation& annotation) {
  static LocalSource source("", testing::SyntheticTable());
  static const FlyingSensor sensor;
  const LasHeader& header = reader.header();
  const absl::StatusOr<LasPrescan> prescan = Prescan(reader, LocalFrame(),
                                                     {.classes = *annotation.classes,
                                                      .water_classes = annotation.plan.water_classes,
                                                      .pairs = true,
                                                      .water_level = {}});
  ALBTPU_MUST(prescan.ok());
  const WaterHeights water = {.surface = prescan->surface.has_value() ? &*prescan->surface : nullptr,
                              .level = annotation.plan.water_level};
  CheckFittedTrack(*prescan, water);
  const BeamGeometry beams(annotation.plan, LocalFrame(), water, &sensor);
  LasChunkWork::Chunk chunk((AnswerStyle()));
  chunk.records = file.substr(header.offset_to_points, header.point_count * header.record_length);
  chunk.own = header.point_count;
  ALBTPU_MUST(LasChunkWork(header, annotation, {}, beams, 0, true, source)(chunk).ok());
  return head + chunk.annotated + std::string(file.substr(header.end_of_points()));
}

void CheckAnnotated(std::string_view file, const LasReader& reader, const std::string& annotated,
                    float largest_incidence) {
  static fuzz::MemoryFile output;
  output.Write(annotated);
  const absl::StatusOr<LasReader> again = LasReader::Open(output.path());
  ALBTPU_MUST(again.ok());
  CheckRecords(file, reader.header(), annotated, again->header(), largest_incidence);
  CheckVlrs(file, reader.vlrs(), annotated, again->vlrs());
  CheckVlrs(file, reader.evlrs(), annotated, again->evlrs());
  ALBTPU_MUST(
      absl::IsInvalidArgument(AnnotatedHead(*again, AppendedFloats({.details = true}), LasKind::kLas).status()));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static fuzz::MemoryFile input;
  const std::string_view file(reinterpret_cast<const char*>(data), size);
  input.Write(file);
  const absl::StatusOr<LasReader> reader = LasReader::Open(input.path());
  if (!reader.ok()) {
    fuzz::MustExplain(reader.status());
    return 0;
  }
  ALBTPU_MUST(FindFeet(*reader).ok());
  ALBTPU_MUST(DescribeCrs(*reader).ok());
  if (reader->kind() == LasKind::kLaz) return 0;  // Its points are not in the file as they are.
  absl::StatusOr<LasHead> head = AnnotatedHead(*reader, AppendedFloats({.details = true}), LasKind::kLas);
  if (!head.ok()) {
    fuzz::MustExplain(head.status());
    return 0;
  }
  const LasHeader& header = reader->header();
  const std::uint64_t length = header.record_length + AppendedFloats({.details = true}).size() * sizeof(float);
  MoveTailStarts(*reader, header.end_of_points(), head->bytes.size() + header.point_count * length, head->bytes);
  static const LasAnnotation by_angle = Annotation(), by_track = TrackAnnotation();
  CheckAnnotated(file, *reader, Annotated(file, *reader, head->bytes, by_angle),
                 32768 * 0.006f);  // Of 16 bits.
  // LasBeams refuses a track where the points have no times.
  if (HasGpsTime(reader->header().point_format))
    CheckAnnotated(file, *reader, Annotated(file, *reader, head->bytes, by_track), 90);
  return 0;
}
