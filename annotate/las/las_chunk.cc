#include "annotate/las/las_chunk.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>

#include "annotate/las/las_prescan.h"
#include "laz/coding/little_endian.h"
#include "status/status_macros.h"

namespace albtpu::annotate {

using laz::Store;

namespace {

// Points whose columns stay in the cache of a core: some 100 numbers each.
constexpr std::size_t kBlockPoints = 4096;

}  // namespace

std::set<int> LasAnnotation::ClassesOf(int point_format) const {
  return classes.has_value() ? *classes : formats::DefaultClasses(point_format);
}

AnswerStyle LasAnnotation::style_of_sea() const {
  AnswerStyle of_sea = style;
  if (total.has_value()) of_sea.coverage = Coverage::kTwoSigma;
  return of_sea;
}

LasChunkWork::LasChunkWork(const formats::LasHeader& header, const LasAnnotation& annotation,
                           const std::vector<formats::ReplacedFloat>& replaced, const std::vector<BeamGeometry>& beams,
                           const formats::UtcClock& utc, bool pulse_surface, const AnswerSource& source,
                           const LasTerrain& terrain)
    : fields_(header),
      record_length_(header.record_length),
      terrain_(terrain),
      seas_(annotation.seas != nullptr && annotation.seas->by_time() ? annotation.seas.get() : nullptr),
      utc_(utc),
      pulse_surface_(pulse_surface && fields_.has_gps_time()),
      use_withheld_(annotation.use_withheld),
      dry_points_(annotation.plan.dry_points),
      appended_(annotation.appended()),
      numbers_(formats::AppendedFloats(appended_)),
      replaced_(replaced),
      extra_bytes_begin_(header.record_length - header.extra_bytes()),
      style_(annotation.style_of_sea()),
      source_(source) {
  if (annotation.channels.empty())
    scanners_.push_back(
        {0, nullptr, &annotation.plan, beams.data(), annotation.total.has_value() ? &*annotation.total : nullptr});
  for (const LasChannel& channel : annotation.channels) {
    const std::size_t number = scanners_.size();
    scanners_.push_back({number, &channel.points, &channel.plan, &beams[number], &channel.total});
  }
  for (const formats::AppendedFloat& each : numbers_) {
    const std::size_t at = no_data_.size();
    no_data_.resize(at + each.size());  // 0 of a byte.
    if (!each.is_byte) Store(each.no_data, no_data_.data() + at);
  }
  UncertaintySummary::Select(selection_);
  if (annotation.total.has_value()) SelectForTotals(selection_);
  selection_.standard_errors = style_.standard_errors;
  for (const int point_class : annotation.ClassesOf(header.point_format)) is_chosen_[point_class] = true;
  for (const int point_class : formats::WaterSurfaceClasses(header.point_format)) is_on_water_[point_class] = true;
  for (const int point_class : annotation.plan.water_classes) is_water_[point_class] = is_on_water_[point_class] = true;
  for (int i = 0; i < formats::kClassCount; ++i) is_ground_[i] = formats::IsGround(i, header.point_format);
  for (int i = 0; i < formats::kClassCount && dry_points_; ++i)
    is_dry_[i] = !is_chosen_[i] && formats::MayBeDry(i, header.point_format);
  for (int i = 0; i < formats::kClassCount; ++i)
    is_terrain_[i] =
        is_dry_[i] && (terrain.is_classified ? formats::IsGround(i, header.point_format) : formats::IsUnclassified(i));
}

absl::Status LasChunkWork::operator()(Chunk& chunk) const {
  Begin(chunk);
  // A server is asked once.
  const std::size_t block = source_.in_process() ? kBlockPoints : chunk.own;
  for (chunk.begin = 0; chunk.begin < chunk.own; chunk.begin = chunk.end) {
    chunk.end = std::min(chunk.begin + block, chunk.own);
    CopyRecords(chunk);
    for (const Scanner& scanner : scanners_) RETURN_IF_ERROR(Annotate(scanner, chunk));
  }
  if (csv_ != nullptr) {
    chunk.csv.clear();
    csv_->Append(chunk.annotated, chunk.own, record_length_, record_length_ + no_data_.size(), chunk.csv);
  }
  if (!replaced_.empty()) Replace(chunk);
  return absl::OkStatus();
}

absl::Status LasChunkWork::Annotate(const Scanner& scanner, Chunk& chunk) const {
  Decode(scanner, chunk);
  if (pulse_surface_) FindPulseSurface(scanner, chunk);
  scanner.beams->Compute(chunk.points, chunk.scratch, chunk.beams);
  chunk.surface.Merge(chunk.beams.surface);
  if (seas_ != nullptr) FindSeas(chunk);
  MakePulses(*scanner.plan, chunk.beams, chunk.rows, chunk.pulses);
  if (seas_ != nullptr) {
    chunk.pulses.times.clear();
    for (const std::uint32_t row : chunk.rows) chunk.pulses.times.push_back(utc_(chunk.points.times[row]));
  }
  RETURN_IF_ERROR(AnswerPulses(source_, style_.query(), chunk.pulses, selection_, chunk.answers));
  if (scanner.total != nullptr) {
    AddWater(scanner.total->water, chunk.pulses, chunk.answers, chunk.total.water);
    FindTotals(scanner, chunk);
    if (dry_points_) FindDryTotals(scanner, chunk);
  }
  Summarize(chunk);
  Encode(scanner, chunk);
  return absl::OkStatus();
}

std::uint8_t LasChunkWork::ScannerOf(std::string_view record) const {
  for (const Scanner& scanner : scanners_)
    if (scanner.points == nullptr || scanner.points->Has(fields_, record))
      return static_cast<std::uint8_t>(scanner.number);
  return kNoScanner;
}

void LasChunkWork::Begin(Chunk& chunk) const {
  chunk.classes = {};
  chunk.withheld = chunk.synthetic = chunk.sloped = chunk.low_ground = chunk.sigmas_assumed =
      chunk.dry_without_channel = 0;
  chunk.submerged.clear();
  chunk.dry = {};
  chunk.surface = {};
  chunk.incidence = {};
  chunk.summary = UncertaintySummary(style_);
  chunk.totals = {};
  chunk.totals_by_line.clear();
  const bool several = scanners_.front().points != nullptr;
  chunk.points_by_channel.assign(several ? scanners_.size() : 0, 0);
  chunk.totals_by_channel.assign(several ? scanners_.size() : 0, {});
  chunk.scanners.resize(chunk.own);
  for (std::size_t i = 0; i < chunk.own; ++i) {
    const std::string_view record = Record(chunk, chunk.before + i);
    const int point_class = fields_.Class(record);
    chunk.classes.Add(point_class);
    const bool withheld = !use_withheld_ && fields_.IsWithheld(record);
    const bool chosen = is_chosen_[point_class];
    chunk.withheld += chosen && withheld;
    chunk.synthetic += chosen && !withheld && fields_.IsSynthetic(record);
    const bool wanted = (chosen || is_dry_[point_class]) && !withheld;
    std::uint8_t& scanner = chunk.scanners[i];
    scanner = !wanted ? kNoScanner : several ? ScannerOf(record) : std::uint8_t{0};
    if (!several || !wanted) continue;
    if (scanner != kNoScanner)
      ++chunk.points_by_channel[scanner];
    else if (chosen)
      chunk.summary.Add(NoPulse::kNoChannel);
    else
      ++chunk.dry_without_channel;
  }
  chunk.annotated.resize(chunk.own * (record_length_ + no_data_.size()));
}

void LasChunkWork::CopyRecords(Chunk& chunk) const {
  const std::size_t appended = no_data_.size();
  const std::size_t annotated_length = record_length_ + appended;
  const char* const records = chunk.records.data() + chunk.before * record_length_;
  for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
    char* const record = chunk.annotated.data() + i * annotated_length;
    std::memcpy(record, records + i * record_length_, record_length_);
    std::memcpy(record + record_length_, no_data_.data(), appended);
  }
}

void LasChunkWork::Decode(const Scanner& scanner, Chunk& chunk) const {
  chunk.chosen.resize(chunk.end - chunk.begin);
  std::size_t found = 0;
  for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
    // Avoids a branch: every index is written, and the next one overwrites it unless it is chosen.
    chunk.chosen[found] = static_cast<std::uint32_t>(chunk.before + i);
    found += chunk.scanners[i] == scanner.number;
  }
  chunk.chosen.resize(found);
  const auto column = [&](auto field, std::vector<double>& values) {
    values.resize(found);
    for (std::size_t i = 0; i < found; ++i) values[i] = field(Record(chunk, chunk.chosen[i]));
  };
  SurveyPoints& points = chunk.points;
  column([this](std::string_view record) { return fields_.X(record); }, points.x);
  column([this](std::string_view record) { return fields_.Y(record); }, points.y);
  column([this](std::string_view record) { return fields_.Z(record); }, points.z);
  column([this](std::string_view record) { return fields_.ScanAngle(record); }, points.scan_angles);
  points.times.clear();
  if (fields_.has_gps_time()) column([this](std::string_view record) { return fields_.GpsTime(record); }, points.times);
  points.pulse_surface.clear();
  points.dry.clear();
  if (!dry_points_) return;
  for (const std::uint32_t i : chunk.chosen) points.dry.push_back(is_dry_[fields_.Class(Record(chunk, i))]);
}

namespace {

// False if a time is NaN.
bool IsInOrder(const auto& records, const auto& time) {
  return std::ranges::adjacent_find(records, std::not_fn(std::less_equal()), time) == records.end();
}

}  // namespace

void LasChunkWork::FindPulseSurface(const Scanner& scanner, Chunk& chunk) const {
  chunk.water.clear();
  const std::size_t count = chunk.records.size() / record_length_, begin = chunk.before + chunk.begin;
  const std::size_t end = std::min(chunk.before + chunk.end + kPulseReach, count);
  for (std::size_t i = begin - std::min(begin, kPulseReach); i < end; ++i) {
    const std::string_view record = Record(chunk, i);
    if (!is_water_[fields_.Class(record)] || (!use_withheld_ && fields_.IsWithheld(record))) continue;
    if (scanner.points != nullptr && !scanner.points->Has(fields_, record)) continue;
    chunk.water.push_back({fields_.GpsTime(record), i});
  }
  chunk.points.pulse_surface.assign(chunk.chosen.size(), std::numeric_limits<double>::quiet_NaN());
  // If times are in order, a search may skip earlier returns for good, and end at a later one.
  const bool in_order =
      IsInOrder(chunk.points.times, std::identity()) && IsInOrder(chunk.water, &Chunk::WaterReturn::time);
  std::size_t first = 0;  // The first return from the surface that may be of the pulse.
  for (std::size_t i = 0; i < chunk.chosen.size(); ++i) {
    if (chunk.points.is_dry(i)) continue;
    const std::size_t point = chunk.chosen[i];
    const double time = chunk.points.times[i];
    while (first < chunk.water.size() &&
           (chunk.water[first].record + kPulseReach < point || (in_order && chunk.water[first].time < time)))
      ++first;
    std::size_t nearest = kPulseReach + 1;
    for (std::size_t at = first; at < chunk.water.size() && chunk.water[at].record <= point + kPulseReach; ++at) {
      if (in_order && chunk.water[at].time > time) break;
      if (chunk.water[at].time != time) continue;
      const std::size_t other = chunk.water[at].record;
      const std::size_t distance = other > point ? other - point : point - other;
      if (distance == 0 || distance >= nearest) continue;
      const std::string_view record = Record(chunk, other);
      if (!fields_.OfOnePulse(record, Record(chunk, point))) continue;
      nearest = distance;
      chunk.points.pulse_surface[i] = fields_.Z(record);
    }
  }
}

void LasChunkWork::FindSeas(Chunk& chunk) const {
  for (std::size_t i = 0; i < chunk.beams.why_not.size(); ++i) {
    std::optional<NoPulse>& why = chunk.beams.why_not[i];
    if (!why.has_value() && chunk.beams.dry[i] == 0 && !seas_->At(utc_(chunk.points.times[i])).has_value())
      why = NoPulse::kNoSea;
  }
}

void LasChunkWork::TakeAircraft(const BeamPlan& plan, const PointBeams& beams, const std::vector<std::uint32_t>& rows,
                                AircraftColumns& aircraft) {
  const auto column = [&](const std::vector<float>& of_points, std::vector<float>& of_rows) {
    of_rows.clear();
    if (of_points.empty()) return;
    of_rows.resize(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) of_rows[i] = of_points[rows[i]];
  };
  column(beams.aircraft[BudgetInput::kAltitude], aircraft[BudgetInput::kAltitude]);
  aircraft[BudgetInput::kBeamAzimuth].clear();
  if (plan.has_direction()) column(beams.beam_azimuth, aircraft[BudgetInput::kBeamAzimuth]);
  for (std::size_t i = 0; i < kMotionInputs; ++i)
    column(beams.aircraft[BudgetInput::kRoll + i], aircraft[BudgetInput::kRoll + i]);
}

void LasChunkWork::FindDryTotals(const Scanner& scanner, Chunk& chunk) const {
  const PointBeams& beams = chunk.beams;
  chunk.dry_rows.clear();
  chunk.dry_incidence.clear();
  for (std::size_t i = 0; i < chunk.chosen.size(); ++i) {
    if (beams.dry[i] == 0 || beams.why_not[i].has_value()) continue;
    // A return from under the water is none from land, unless it is of the ground, which may lie lower behind a dike.
    const int point_class = fields_.Class(Record(chunk, chunk.chosen[i]));
    if (chunk.scratch.above[i] < 0 && !is_on_water_[static_cast<std::size_t>(point_class)]) {
      if (!is_ground_[static_cast<std::size_t>(point_class)]) {
        ++chunk.submerged[point_class];
        continue;
      }
      ++chunk.low_ground;
    }
    chunk.dry_rows.push_back(static_cast<std::uint32_t>(i));
    chunk.dry_incidence.push_back(beams.incidence[i]);
  }
  TakeAircraft(*scanner.plan, beams, chunk.dry_rows, chunk.dry_aircraft);
  chunk.dry_total.whole = terrain_.planes != nullptr;
  ComputeDryTotals(*scanner.total, chunk.dry_incidence, chunk.dry_aircraft, chunk.dry_total);
  if (terrain_.planes != nullptr) FindTerrain(scanner, chunk);
  chunk.sigmas_assumed += chunk.dry_total.sigmas_assumed;
  for (std::size_t i = 0; i < chunk.dry_rows.size(); ++i) chunk.dry.Add(chunk.dry_total, i);
}

void LasChunkWork::FindTerrain(const Scanner& scanner, Chunk& chunk) const {
  chunk.dry_terrain.assign(chunk.dry_rows.size(), {});
  const PointBeams& beams = chunk.beams;
  for (std::size_t i = 0; i < chunk.dry_rows.size(); ++i) {
    const std::uint32_t row = chunk.dry_rows[i];
    if (!is_terrain_[fields_.Class(Record(chunk, chunk.chosen[row]))]) continue;
    const Eigen::Vector3d at = terrain_.frame.At(chunk.points.x[row], chunk.points.y[row], chunk.points.z[row]);
    const std::optional<TerrainPlanes::Gradient> gradient = terrain_.planes->GradientAt(at.x(), at.y());
    if (!gradient.has_value()) continue;
    ++chunk.sloped;
    chunk.dry_terrain[i] = AddTerrain(scanner.total->options.coverage,
                                      {.gradient = OfGrid(gradient->x, gradient->y, beams.convergence[row]),
                                       .footprint = beams.footprint[row],
                                       .incidence = beams.incidence[row],
                                       .azimuth = beams.beam_azimuth[row]},
                                      i, chunk.dry_total);
  }
}

void LasChunkWork::FindTotals(const Scanner& scanner, Chunk& chunk) const {
  TakeAircraft(*scanner.plan, chunk.beams, chunk.rows, chunk.aircraft);
  ComputeTotals(*scanner.total, chunk.pulses, chunk.answers, chunk.aircraft, chunk.total);
  chunk.sigmas_assumed += chunk.total.sigmas_assumed;
  // As many of the chunk as of a batch.
  const auto samples_before = [&](std::size_t point) { return kSourceSamples * point / chunk.own; };
  const std::size_t samples = samples_before(chunk.end) - samples_before(chunk.begin);
  if (!chunk.rows.empty())
    chunk.totals.Add(SampleSources(*scanner.total, chunk.pulses, chunk.aircraft, chunk.total, samples));
  std::map<int, TotalSummary> by_line;
  for (std::size_t i = 0; i < chunk.rows.size(); ++i) {
    const int line = fields_.PointSourceId(Record(chunk, chunk.chosen[chunk.rows[i]]));
    by_line[line].Add(chunk.pulses, chunk.answers, chunk.total, i);
  }
  for (const auto& [line, summary] : by_line) {
    chunk.totals_by_line[line].Merge(summary);
    chunk.totals.Merge(summary);
    if (scanner.points != nullptr) chunk.totals_by_channel[scanner.number].Merge(summary);
  }
}

void LasChunkWork::Summarize(Chunk& chunk) const {
  chunk.summary.Add(chunk.pulses, chunk.answers);
  for (std::size_t i = 0; i < chunk.chosen.size(); ++i) {
    if (chunk.points.is_dry(i)) continue;
    if (std::isfinite(chunk.beams.incidence[i])) chunk.incidence.Add(chunk.beams.incidence[i]);
    const std::optional<NoPulse>& why = chunk.beams.why_not[i];
    if (chunk.beams.dry[i] != 0) {
      if (!why.has_value()) chunk.summary.AddAboveWater(static_cast<float>(-chunk.scratch.above[i]), NoPulse::kDry);
    }
    if (!why.has_value()) continue;
    if (*why == NoPulse::kAboveWater)
      chunk.summary.AddAboveWater(chunk.beams.depth[i]);
    else
      chunk.summary.Add(*why);
  }
}

}  // namespace albtpu::annotate
