// The bytes of a chunk: what is appended to its records, or put in place of what they have.
#include <cmath>
#include <cstring>

#include "annotate/las/las_chunk.h"
#include "laz/coding/little_endian.h"

namespace albtpu::annotate {

using laz::Store;

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

void LasChunkWork::Encode(const Scanner& scanner, Chunk& chunk) const {
  const std::size_t appended = no_data_.size();
  const std::size_t annotated_length = record_length_ + appended;
  const auto appended_to = [&](std::size_t point) {
    return chunk.annotated.data() + (chunk.chosen[point] - chunk.before) * annotated_length + record_length_;
  };
  for (std::size_t i = 0; i < chunk.rows.size(); ++i) {
    if (!chunk.answers.interpolated(i)) continue;
    char* const values = appended_to(chunk.rows[i]);
    if (scanner.total != nullptr) {
      EncodeTotals(*scanner.total, chunk, false, i, values);
    } else {
      Store(chunk.answers[Quantity::kThu][i], values);
      Store(chunk.answers[Quantity::kTvu][i], values + sizeof(float));
    }
  }
  for (std::size_t i = 0; i < chunk.dry_rows.size() && dry_points_; ++i)
    EncodeTotals(*scanner.total, chunk, true, i, appended_to(chunk.dry_rows[i]));
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

void LasChunkWork::EncodeTotals(const TotalPlan& plan, const Chunk& chunk, bool dry, std::size_t i,
                                char* values) const {
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
    put(!plan.water.has_share() ? formats::kNoNumber : dry ? 0 : (*column)[i]);
  if (appended_.extra)
    for (const float added : {total.extra.thu, total.extra.tvu}) put(added);
  const double factor = VerticalFactor(plan.options.coverage);
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
