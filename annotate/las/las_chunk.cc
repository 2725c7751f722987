#include "annotate/las/las_chunk.h"

#include <cmath>
#include <cstring>
#include <limits>

#include "annotate/las/las_prescan.h"
#include "laz/coding/little_endian.h"
#include "status/status_macros.h"

namespace albtpu::annotate {

using laz::Store;

std::set<int> LasAnnotation::ClassesOf(int point_format) const {
  return classes.has_value() ? *classes : formats::DefaultClasses(point_format);
}

AnswerStyle LasAnnotation::style_of_sea() const {
  AnswerStyle of_sea = style;
  if (total.has_value()) of_sea.coverage = Coverage::kTwoSigma;
  return of_sea;
}

LasChunkWork::LasChunkWork(const formats::LasHeader& header, const LasAnnotation& annotation,
                           const std::vector<formats::ReplacedFloat>& replaced, const BeamGeometry& beams, double utc,
                           bool pulse_surface, const AnswerSource& source, const LasTerrain& terrain)
    : fields_(header),
      record_length_(header.record_length),
      plan_(annotation.plan),
      beams_(beams),
      terrain_(terrain),
      seas_(annotation.seas != nullptr && annotation.seas->by_time() ? annotation.seas.get() : nullptr),
      utc_(utc),
      pulse_surface_(pulse_surface && fields_.has_gps_time()),
      use_withheld_(annotation.use_withheld),
      appended_(annotation.appended()),
      numbers_(formats::AppendedFloats(appended_)),
      replaced_(replaced),
      extra_bytes_begin_(header.record_length - header.extra_bytes()),
      style_(annotation.style_of_sea()),
      total_(annotation.total.has_value() ? &*annotation.total : nullptr),
      source_(source) {
  for (const formats::AppendedFloat& each : numbers_) {
    const std::size_t at = no_data_.size();
    no_data_.resize(at + each.size());  // 0 of a byte.
    if (!each.is_byte) Store(each.no_data, no_data_.data() + at);
  }
  UncertaintySummary::Select(selection_);
  if (total_ != nullptr) SelectForTotals(selection_);
  selection_.standard_errors = style_.standard_errors;
  for (const int point_class : annotation.ClassesOf(header.point_format)) is_chosen_[point_class] = true;
  for (const int point_class : plan_.water_classes) is_water_[point_class] = true;
  for (int i = 0; i < formats::kClassCount && plan_.dry_points; ++i)
    is_dry_[i] = !is_chosen_[i] && formats::MayBeDry(i, header.point_format);
  for (int i = 0; i < formats::kClassCount; ++i)
    is_terrain_[i] =
        is_dry_[i] && (terrain.is_classified ? formats::IsGround(i, header.point_format) : formats::IsUnclassified(i));
}

absl::Status LasChunkWork::operator()(Chunk& chunk) const {
  Decode(chunk);
  if (pulse_surface_) FindPulseSurface(chunk);
  beams_.Compute(chunk.points, chunk.scratch, chunk.beams);
  chunk.surface = chunk.beams.surface;
  if (seas_ != nullptr) FindSeas(chunk);
  MakePulses(plan_, chunk.beams, chunk.rows, chunk.pulses);
  if (seas_ != nullptr) {
    chunk.pulses.times.clear();
    for (const std::uint32_t row : chunk.rows) chunk.pulses.times.push_back(chunk.points.times[row] + utc_);
  }
  RETURN_IF_ERROR(AnswerPulses(source_, style_.query(), chunk.pulses, selection_, chunk.answers));
  if (total_ != nullptr) {
    AddWater(total_->water, chunk.pulses, chunk.answers, chunk.total.water);
    FindTotals(chunk);
    if (plan_.dry_points) FindDryTotals(chunk);
  }
  Summarize(chunk);
  Encode(chunk);
  if (!replaced_.empty()) Replace(chunk);
  return absl::OkStatus();
}

void LasChunkWork::Decode(Chunk& chunk) const {
  chunk.classes = {};
  chunk.withheld = chunk.synthetic = 0;
  chunk.chosen.resize(chunk.own);
  std::size_t found = 0;
  for (std::size_t i = chunk.before; i < chunk.before + chunk.own; ++i) {
    const std::string_view record = Record(chunk, i);
    const int point_class = fields_.Class(record);
    chunk.classes.Add(point_class);
    const bool withheld = !use_withheld_ && fields_.IsWithheld(record);
    const bool chosen = is_chosen_[point_class];
    chunk.withheld += chosen && withheld;
    chunk.synthetic += chosen && !withheld && fields_.IsSynthetic(record);
    // Avoids a branch: every index is written, and the next one overwrites it unless it is chosen.
    chunk.chosen[found] = static_cast<std::uint32_t>(i);
    found += (chosen || is_dry_[point_class]) && !withheld;
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
  if (!plan_.dry_points) return;
  for (const std::uint32_t i : chunk.chosen) points.dry.push_back(is_dry_[fields_.Class(Record(chunk, i))]);
}

void LasChunkWork::FindPulseSurface(Chunk& chunk) const {
  chunk.water.clear();
  const std::size_t count = chunk.records.size() / record_length_;
  for (std::size_t i = 0; i < count; ++i) {
    const std::string_view record = Record(chunk, i);
    if (!is_water_[fields_.Class(record)] || (!use_withheld_ && fields_.IsWithheld(record))) continue;
    chunk.water.push_back(static_cast<std::uint32_t>(i));
  }
  chunk.points.pulse_surface.assign(chunk.chosen.size(), std::numeric_limits<double>::quiet_NaN());
  std::size_t first = 0;  // The first return from the surface that is within reach.
  for (std::size_t i = 0; i < chunk.chosen.size(); ++i) {
    if (chunk.points.is_dry(i)) continue;
    const std::size_t point = chunk.chosen[i];
    while (first < chunk.water.size() && chunk.water[first] + kPulseReach < point) ++first;
    std::size_t nearest = kPulseReach + 1;
    for (std::size_t at = first; at < chunk.water.size() && chunk.water[at] <= point + kPulseReach; ++at) {
      const std::size_t other = chunk.water[at];
      const std::size_t distance = other > point ? other - point : point - other;
      if (distance == 0 || distance >= nearest) continue;
      const std::string_view record = Record(chunk, other);
      if (fields_.GpsTime(record) != chunk.points.times[i]) continue;
      if (!fields_.OfOnePulse(record, Record(chunk, point))) continue;
      nearest = distance;
      chunk.points.pulse_surface[i] = fields_.Z(record);
    }
  }
}

void LasChunkWork::FindSeas(Chunk& chunk) const {
  for (std::size_t i = 0; i < chunk.beams.why_not.size(); ++i) {
    std::optional<NoPulse>& why = chunk.beams.why_not[i];
    if (!why.has_value() && chunk.beams.dry[i] == 0 && !seas_->At(chunk.points.times[i] + utc_).has_value())
      why = NoPulse::kNoSea;
  }
}

void LasChunkWork::TakeAircraft(const PointBeams& beams, const std::vector<std::uint32_t>& rows,
                                AircraftColumns& aircraft) const {
  const auto column = [&](const std::vector<float>& of_points, std::vector<float>& of_rows) {
    of_rows.clear();
    if (of_points.empty()) return;
    of_rows.resize(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) of_rows[i] = of_points[rows[i]];
  };
  column(beams.aircraft[BudgetInput::kAltitude], aircraft[BudgetInput::kAltitude]);
  aircraft[BudgetInput::kBeamAzimuth].clear();
  if (plan_.has_direction()) column(beams.beam_azimuth, aircraft[BudgetInput::kBeamAzimuth]);
  for (std::size_t i = 0; i < kMotionInputs; ++i)
    column(beams.aircraft[BudgetInput::kRoll + i], aircraft[BudgetInput::kRoll + i]);
}

void LasChunkWork::FindDryTotals(Chunk& chunk) const {
  const PointBeams& beams = chunk.beams;
  chunk.dry_rows.clear();
  chunk.dry_incidence.clear();
  chunk.submerged = 0;
  for (std::size_t i = 0; i < chunk.chosen.size(); ++i) {
    if (beams.dry[i] == 0 || beams.why_not[i].has_value()) continue;
    // A return from under the water that nobody classified is none from land.
    if (chunk.scratch.above[i] < 0 && formats::IsUnclassified(fields_.Class(Record(chunk, chunk.chosen[i])))) {
      ++chunk.submerged;
      continue;
    }
    chunk.dry_rows.push_back(static_cast<std::uint32_t>(i));
    chunk.dry_incidence.push_back(beams.incidence[i]);
  }
  TakeAircraft(beams, chunk.dry_rows, chunk.dry_aircraft);
  chunk.dry_total.whole = terrain_.planes != nullptr;
  ComputeDryTotals(*total_, chunk.dry_incidence, chunk.dry_aircraft, chunk.dry_total);
  if (terrain_.planes != nullptr) FindTerrain(chunk);
  chunk.sigmas_assumed += chunk.dry_total.sigmas_assumed;
  chunk.dry = {};
  for (std::size_t i = 0; i < chunk.dry_rows.size(); ++i) chunk.dry.Add(chunk.dry_total, i);
}

void LasChunkWork::FindTerrain(Chunk& chunk) const {
  chunk.dry_terrain.assign(chunk.dry_rows.size(), {});
  chunk.sloped = 0;
  const PointBeams& beams = chunk.beams;
  for (std::size_t i = 0; i < chunk.dry_rows.size(); ++i) {
    const std::uint32_t row = chunk.dry_rows[i];
    if (!is_terrain_[fields_.Class(Record(chunk, chunk.chosen[row]))]) continue;
    const Eigen::Vector3d at = terrain_.frame.At(chunk.points.x[row], chunk.points.y[row], chunk.points.z[row]);
    const std::optional<TerrainPlanes::Gradient> gradient = terrain_.planes->GradientAt(at.x(), at.y());
    if (!gradient.has_value()) continue;
    ++chunk.sloped;
    chunk.dry_terrain[i] = AddTerrain(total_->options.coverage,
                                      {.gradient = OfGrid(gradient->x, gradient->y, beams.convergence[row]),
                                       .footprint = beams.footprint[row],
                                       .incidence = beams.incidence[row],
                                       .azimuth = beams.beam_azimuth[row]},
                                      i, chunk.dry_total);
  }
}

void LasChunkWork::FindTotals(Chunk& chunk) const {
  TakeAircraft(chunk.beams, chunk.rows, chunk.aircraft);
  ComputeTotals(*total_, chunk.pulses, chunk.answers, chunk.aircraft, chunk.total);
  chunk.sigmas_assumed = chunk.total.sigmas_assumed;
  chunk.totals = {};
  chunk.totals_by_line.clear();
  for (std::size_t i = 0; i < chunk.rows.size(); ++i) {
    const int line = fields_.PointSourceId(Record(chunk, chunk.chosen[chunk.rows[i]]));
    chunk.totals_by_line[line].Add(chunk.pulses, chunk.answers, chunk.total, i);
  }
  for (const auto& [line, summary] : chunk.totals_by_line) chunk.totals.Merge(summary);
}

void LasChunkWork::Summarize(Chunk& chunk) const {
  chunk.summary = UncertaintySummary(style_);
  chunk.summary.Add(chunk.pulses, chunk.answers);
  chunk.incidence = {};
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

void LasChunkWork::Replace(Chunk& chunk) const {
  const std::size_t length = record_length_ + no_data_.size();
  std::size_t new_length = length;
  for (const formats::ReplacedFloat& replaced : replaced_) new_length -= numbers_[replaced.appended].size();
  char* const begin = chunk.annotated.data();
  for (std::size_t i = 0; i < chunk.own; ++i) {
    char* const record = begin + i * length;
    char* const values = record + record_length_;
    for (const formats::ReplacedFloat& replaced : replaced_) {
      const char* const value = values + replaced.appended * sizeof(float);
      char* const place = record + extra_bytes_begin_ + replaced.offset;
      if (replaced.is_double)
        Store(static_cast<double>(laz::Load<float>({value, sizeof(float)}, 0)), place);
      else
        std::memcpy(place, value, numbers_[replaced.appended].size());
    }
    // The new values close up, and the record moves to its place among the shorter records.
    char* end = values;
    auto next = replaced_.begin();
    for (std::size_t k = 0; k < numbers_.size(); ++k) {
      if (next != replaced_.end() && next->appended == k) {
        ++next;
        continue;
      }
      std::memmove(end, values + k * sizeof(float), numbers_[k].size());
      end += numbers_[k].size();
    }
    std::memmove(begin + i * new_length, record, new_length);
  }
  chunk.annotated.resize(chunk.own * new_length);
}

void LasChunkWork::Encode(Chunk& chunk) const {
  const std::size_t appended = no_data_.size();
  const std::size_t annotated_length = record_length_ + appended;
  chunk.annotated.resize(chunk.own * annotated_length);
  const char* const records = chunk.records.data() + chunk.before * record_length_;
  for (std::size_t i = 0; i < chunk.own; ++i) {
    char* const record = chunk.annotated.data() + i * annotated_length;
    std::memcpy(record, records + i * record_length_, record_length_);
    std::memcpy(record + record_length_, no_data_.data(), appended);
  }
  const auto appended_to = [&](std::size_t point) {
    return chunk.annotated.data() + (chunk.chosen[point] - chunk.before) * annotated_length + record_length_;
  };
  for (std::size_t i = 0; i < chunk.rows.size(); ++i) {
    if (!chunk.answers.interpolated(i)) continue;
    char* const values = appended_to(chunk.rows[i]);
    if (total_ != nullptr) {
      EncodeTotals(chunk, false, i, values);
    } else {
      Store(chunk.answers[Quantity::kThu][i], values);
      Store(chunk.answers[Quantity::kTvu][i], values + sizeof(float));
    }
  }
  for (std::size_t i = 0; i < chunk.dry_rows.size() && plan_.dry_points; ++i)
    EncodeTotals(chunk, true, i, appended_to(chunk.dry_rows[i]));
  if (!appended_.details) return;
  const auto length_or_none = [](float value) { return value >= 0 ? value : formats::kNoNumber; };  // Also for NaN.
  const PointBeams& beams = chunk.beams;
  for (std::size_t i = 0; i < chunk.chosen.size(); ++i) {
    char* values = appended_to(i) + appended - appended_.share_of() - formats::kGeometryCount * sizeof(float);
    for (const float value : {beams.incidence[i], beams.beam_azimuth[i], length_or_none(beams.footprint[i]),
                              beams.dry[i] != 0 ? formats::kNoNumber : length_or_none(beams.depth[i]),
                              length_or_none(beams.slant_range[i])}) {
      Store(value, values);
      values += sizeof(float);
    }
  }
}

void LasChunkWork::EncodeTotals(const Chunk& chunk, bool dry, std::size_t i, char* values) const {
  const TotalBatch& total = dry ? chunk.dry_total : chunk.total;
  const std::uint32_t point = dry ? chunk.dry_rows[i] : chunk.rows[i];
  if (!std::isfinite(total.thu[i]) || !std::isfinite(total.tvu[i])) return;
  if (appended_.share_of())
    Store(static_cast<std::uint8_t>(dry ? formats::ShareOf::kLand : formats::ShareOf::kWater),
          values + no_data_.size() - 1);
  const auto put = [&values](float value) {
    Store(value, values);
    values += sizeof(float);
  };
  put(total.thu[i]);
  put(total.tvu[i]);
  if (!appended_.details) return;
  for (const auto* column : {&total.thu_air, &total.tvu_air}) put((*column)[i]);
  for (const auto* column : {&total.thu_sea, &total.tvu_sea}) put(dry ? 0 : (*column)[i]);
  for (const auto* column : {&total.thu_water, &total.tvu_water})
    put(total_->water.share == nullptr ? formats::kNoNumber : dry ? 0 : (*column)[i]);
  const double factor = VerticalFactor(total_->options.coverage);
  for (const ErrorGroup group : {ErrorGroup::kPulse, ErrorGroup::kLine})
    put(static_cast<float>(factor * std::sqrt(total.groups[static_cast<std::size_t>(group)][2][i])));
  for (const Quantity bias : {Quantity::kBiasAlongBeam, Quantity::kBiasVertical}) put(dry ? 0 : chunk.answers[bias][i]);
  for (const float entry : OnGridAxes(total.covariance, i, chunk.beams.convergence[point])) put(entry);
  if (!appended_.terrain) return;
  const TerrainShare terrain = dry ? chunk.dry_terrain[i] : TerrainShare();
  put(terrain.slope);
  put(terrain.tvu_slope);
  put(terrain.tvu_footprint);
}

}  // namespace albtpu::annotate
