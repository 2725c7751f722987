// Arbitrary bytes as a LAS file are rejected with a reason, or annotated.
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "annotate/beams/water_heights.h"
#include "annotate/las/las_chunk.h"
#include "annotate/las/las_prescan.h"
#include "budget/beams/ray_track.h"
#include "formats/las/las_contents.h"
#include "formats/las/las_crs.h"
#include "formats/las/las_extra_bytes.h"
#include "formats/las/las_header.h"
#include "formats/las/las_reader.h"
#include "formats/las/las_writer.h"
#include "laz/coding/little_endian.h"
#include "service/client/local_source.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/memory_file.h"
#include "tests/tables/synthetic_table.h"

namespace albtpu::fuzz {
namespace {

using namespace albtpu::annotate;
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
    if (is_ours(old_entry)) continue;  // Of several, one is left.
    while (i < entries.size() && is_ours(entries[i])) ++i;
    ALBTPU_MUST(i < entries.size());
    const auto all = [](std::string_view file, const VlrEntry& entry) {
      return file.substr(entry.offset, entry.end() - entry.offset);
    };
    ALBTPU_MUST(all(before, old_entry) == all(after, entries[i]));
    ++i;
  }
}

// A track from whatever pairs of returns the file has, known or not, has finite positions.
void CheckFittedTrack(const LasPrescan& prescan, const WaterHeights& water) {
  const std::vector<AirRay> rays = RaysOfPairs(prescan.pairs, water, formats::LocalFrame(), kSeaWaterIndex);
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
  static client::LocalSource source("", testing::SyntheticTable());
  static const FlyingSensor sensor;
  const LasHeader& header = reader.header();
  const absl::StatusOr<LasPrescan> prescan = Prescan(reader, formats::LocalFrame(),
                                                     {.classes = *annotation.classes,
                                                      .water_classes = annotation.plan.water_classes,
                                                      .pairs = true,
                                                      .water_level = {}});
  ALBTPU_MUST(prescan.ok());
  const WaterHeights water = {.surface = prescan->surface.has_value() ? &*prescan->surface : nullptr,
                              .level = annotation.plan.water_level};
  CheckFittedTrack(*prescan, water);
  const std::vector<BeamGeometry> beams = {{annotation.plan, formats::LocalFrame(), water, &sensor}};
  LasChunkWork::Chunk chunk((AnswerStyle()));
  chunk.records = file.substr(header.offset_to_points, header.point_count * header.record_length);
  chunk.own = header.point_count;
  ALBTPU_MUST(LasChunkWork(header, annotation, {}, beams, {}, true, source)(chunk).ok());
  return head + chunk.annotated + std::string(file.substr(header.end_of_points()));
}

void CheckAnnotated(std::string_view file, const LasReader& reader, const std::string& annotated,
                    float largest_incidence) {
  static MemoryFile output;
  output.Write(annotated);
  const absl::StatusOr<LasReader> again = LasReader::Open(output.path());
  ALBTPU_MUST(again.ok());
  CheckRecords(file, reader.header(), annotated, again->header(), largest_incidence);
  CheckVlrs(file, reader.vlrs(), annotated, again->vlrs());
  CheckVlrs(file, reader.evlrs(), annotated, again->evlrs());
  ALBTPU_MUST(
      absl::IsInvalidArgument(AnnotatedHead(*again, AppendedFloats({.details = true}), LasKind::kLas).status()));
}

// What is said of a file to people who have yet to describe it: all points are of some class.
void CheckContents(const LasReader& reader, std::string_view input) {
  const absl::StatusOr<LasContents> contents = ReadContents(reader);
  if (!contents.ok()) return MustExplain(contents.status());
  ALBTPU_MUST(contents->points == reader.header().point_count);
  std::uint64_t points = 0;
  for (const LasClassContents& of_class : contents->classes) points += of_class.points;
  ALBTPU_MUST(points == contents->points);
  ALBTPU_MUST(!contents->has_times() || (std::isfinite(contents->first_time) && std::isfinite(contents->last_time)));
  contents->scan_pattern();
  if (!IsOneIn(64, input)) return;  // PROJ takes long.
  const absl::StatusOr<LasCrs> crs = CrsOf(reader, "");
  ALBTPU_MUST(!crs.ok() || crs->map != nullptr);
}

// Every byte is kept, and the output is a LAS file that describes its uncertainties: with incidences from scan angles,
// and from the positions of a sensor.
void LasTarget(std::string_view file) {
  static MemoryFile input;
  input.Write(file);
  const absl::StatusOr<LasReader> reader = LasReader::Open(input.path());
  if (!reader.ok()) return MustExplain(reader.status());
  ALBTPU_MUST(FindFeet(*reader).ok());
  ALBTPU_MUST(DescribeCrs(*reader).ok());
  CheckContents(*reader, file);
  if (reader->kind() == LasKind::kLaz) return;  // Its points are not in the file as they are.
  absl::StatusOr<LasHead> head = AnnotatedHead(*reader, AppendedFloats({.details = true}), LasKind::kLas);
  if (!head.ok()) return MustExplain(head.status());
  // Extra Bytes of an EVLR are in a VLR of the copy, so that what follows the points is not copied as it is.
  for (const VlrEntry& evlr : reader->evlrs())
    if (!IsKept(*reader, evlr)) return;
  const LasHeader& header = reader->header();
  const std::uint64_t length = header.record_length + AppendedFloats({.details = true}).size() * sizeof(float);
  MoveTailStarts(*reader, header.end_of_points(), head->bytes.size() + header.point_count * length, head->bytes);
  static const LasAnnotation by_angle = Annotation(), by_track = TrackAnnotation();
  CheckAnnotated(file, *reader, Annotated(file, *reader, head->bytes, by_angle),
                 32768 * 0.006f);  // Of 16 bits.
  // LasBeams refuses a track where the points have no times. A point that lies above the sensor is seen upwards.
  if (HasGpsTime(reader->header().point_format))
    CheckAnnotated(file, *reader, Annotated(file, *reader, head->bytes, by_track), 180);
}

const std::string kName = "file";

void CheckHeader(const LasHeader& header, std::uint64_t file_size) {
  ALBTPU_MUST(header.version_minor >= 0 && header.version_minor <= 5);
  ALBTPU_MUST(header.point_format >= 0 && header.point_format <= kLargestPointFormat);
  ALBTPU_MUST(header.record_length >= MinimumRecordLength(header.point_format));
  ALBTPU_MUST(header.header_size <= header.offset_to_points && header.offset_to_points <= file_size);
  const std::uint64_t room = file_size - header.offset_to_points;
  std::uint64_t end_of_points = header.offset_to_points;  // Of LAZ: at least.
  if (!header.compressed) {
    ALBTPU_MUST(header.point_count <= room && header.point_count * header.record_length <= room);
    end_of_points = header.end_of_points();
  }
  for (const std::uint64_t start : {header.start_of_evlrs, header.start_of_waveform_packet})
    ALBTPU_MUST(start == 0 || (end_of_points <= start && start <= file_size));
  for (std::size_t axis = 0; axis < header.scale.size(); ++axis)
    ALBTPU_MUST(std::isfinite(header.offset[axis]) && std::isfinite(header.scale[axis]) && header.scale[axis] != 0);
}

// The result starts with the existing description and ends with our entries of 192 bytes.
void CheckExtraBytes(std::string_view described, std::size_t extra_bytes) {
  constexpr std::size_t kEntry = 192, kNameField = 4;
  const std::vector<AppendedFloat> appended = AppendedFloats({.details = true});
  const absl::StatusOr<AppendedDescription> description = DescribeAppended(kName, described, extra_bytes, appended);
  if (!description.ok()) return MustExplain(description.status());
  const std::string* const ours = &description->record;
  ALBTPU_MUST(ours->size() % kEntry == 0 && ours->size() >= described.size() + appended.size() * kEntry);
  ALBTPU_MUST(ours->size() <= kLargestExtraBytesRecord);
  ALBTPU_MUST(ours->substr(0, described.size()) == described);
  for (std::size_t i = 0; i < appended.size(); ++i) {
    const std::size_t entry = ours->size() - (appended.size() - i) * kEntry;
    ALBTPU_MUST(ours->substr(entry + kNameField, appended[i].name.size()) == appended[i].name);
  }
  const std::size_t more = appended.size() * sizeof(float);
  ALBTPU_MUST(absl::IsInvalidArgument(DescribeAppended(kName, *ours, extra_bytes + more, appended).status()));
  const auto replacing = DescribeAppended(kName, *ours, extra_bytes + more, appended, true);
  ALBTPU_MUST(replacing.ok() && replacing->record == *ours && replacing->replaced.size() == appended.size());
}

void CheckData(const VlrEntry& entry, std::string_view data, const LasHeader& header) {
  constexpr std::string_view kProjection = "LASF_Projection";
  if (entry.Is(kSpecUser, kExtraBytesRecord)) CheckExtraBytes(data, header.extra_bytes());
  const std::optional<std::string> feet = entry.Is(kProjection, 2112)    ? FindFeetInWkt(data)
                                          : entry.Is(kProjection, 34735) ? FindFeetInGeoKeys(data)
                                                                         : std::nullopt;
  ALBTPU_MUST(!feet.has_value() || feet->size() > 4);
}

void CheckVlrs(std::string_view head, const LasHeader& header) {
  const absl::StatusOr<std::vector<VlrEntry>> entries = ListVlrs(kName, header, head);
  if (!entries.ok()) return MustExplain(entries.status());
  ALBTPU_MUST(entries->size() == header.vlr_count);
  std::uint64_t next = header.header_size;
  bool described = false;
  for (const VlrEntry& entry : *entries) {
    ALBTPU_MUST(entry.offset == next && entry.data_offset == next + kVlrHeaderSize);
    ALBTPU_MUST(entry.data_size <= head.size() && entry.end() <= head.size());
    next = entry.end();
    CheckData(entry, head.substr(entry.data_offset, entry.data_size), header);
    described = described || entry.Is(kSpecUser, kExtraBytesRecord);
  }
  if (!described) CheckExtraBytes("", header.extra_bytes());
}

void CheckEvlrs(std::string_view file, const LasHeader& header) {
  std::uint64_t next = header.start_of_evlrs;
  for (std::uint32_t i = 0; i < header.evlr_count && file.size() - next >= kEvlrHeaderSize; ++i) {
    const std::string bytes(file.substr(next, kEvlrHeaderSize));
    const absl::StatusOr<VlrEntry> entry = ParseEvlr(kName, bytes, next, file.size());
    if (!entry.ok()) return MustExplain(entry.status());
    ALBTPU_MUST(entry->data_offset == next + kEvlrHeaderSize && entry->data_size <= file.size());
    ALBTPU_MUST(entry->end() <= file.size());
    CheckData(*entry, file.substr(entry->data_offset, entry->data_size), header);
    next = entry->end();
  }
}

// Everything but the points, read from memory: all offsets lie in the file, and the extra bytes can be described.
void LasHeadTarget(std::string_view input) {
  const std::string file(input);
  const absl::StatusOr<LasHeader> header = ParseLasHeader(kName, file.substr(0, kLargestLasHeader), file.size());
  if (!header.ok()) return MustExplain(header.status());
  CheckHeader(*header, file.size());
  CheckVlrs(file.substr(0, header->offset_to_points), *header);  // A copy: sanitizers detect reads beyond it.
  CheckEvlrs(file, *header);
}

}  // namespace

const std::vector<Target> kTargets = {{"las", LasTarget}, {"las_head", LasHeadTarget}};

}  // namespace albtpu::fuzz
