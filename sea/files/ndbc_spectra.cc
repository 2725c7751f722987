#include "sea/files/ndbc_spectra.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "absl/strings/str_cat.h"
#include "sea/angle.h"
#include "sea/files/ndbc_table.h"
#include "status/status_macros.h"

namespace albtpu {
namespace {

using RowsByTime = std::map<double, const NdbcRow*>;

RowsByTime ByTime(const std::optional<NdbcTable>& table) {
  RowsByTime rows;
  if (table)
    for (const NdbcRow& row : table->rows) rows.emplace(row.time, &row);
  return rows;
}

absl::StatusOr<std::optional<NdbcTable>> ReadCompanion(const std::optional<std::string_view>& text,
                                                       NdbcQuantity quantity, bool real_time, const std::string& name) {
  if (!text) return std::nullopt;
  absl::StatusOr<NdbcTable> table = ReadNdbcTable(*text, quantity);
  if (!table.ok())
    return absl::Status(table.status().code(), absl::StrCat("beside it, ", name, ": ", table.status().message()));
  if (table->real_time != real_time)
    return absl::InvalidArgumentError(absl::StrCat("beside it, ", name, ": is ",
                                                   real_time ? "of the history" : "in real time",
                                                   " (unlike the file of energy); give files of one kind"));
  return std::optional(*std::move(table));
}

// The directions of records.
class Directions {
 public:
  Directions(const std::optional<NdbcTable>& spread, const std::optional<NdbcTable>& direction)
      : spreads_(ByTime(spread)), directions_(ByTime(direction)) {}

  // The rows for the time of `energy`; null without one, or with other frequencies.
  std::pair<const NdbcRow*, const NdbcRow*> At(const NdbcRow& energy) const {
    return {Find(spreads_, energy), Find(directions_, energy)};
  }

 private:
  static const NdbcRow* Find(const RowsByTime& rows, const NdbcRow& energy) {
    const auto found = rows.find(energy.time);
    if (found == rows.end() || *found->second->frequencies != *energy.frequencies) return nullptr;
    return found->second;
  }

  RowsByTime spreads_, directions_;
};

DirectionalEnergy Bin(double energy, const std::pair<const NdbcRow*, const NdbcRow*>& at, std::size_t i) {
  const auto& [spread, direction] = at;
  if (spread == nullptr || direction == nullptr || std::isnan(spread->values[i]) || std::isnan(direction->values[i]))
    return {.energy = energy};
  return SymmetricEnergy(energy, {spread->values[i]}, RadiansOfDegrees(direction->values[i]));
}

// The waves of a row; null with fewer than two bins. Rows without gaps share their frequencies.
BinnedWaves WavesOf(const NdbcRow& row, const std::pair<const NdbcRow*, const NdbcRow*>& directions) {
  std::vector<double> centres;
  std::vector<DirectionalEnergy> bins;
  for (std::size_t i = 0; i < row.values.size(); ++i) {
    if (std::isnan(row.values[i])) continue;
    centres.push_back((*row.frequencies)[i]);
    bins.push_back(Bin(row.values[i], directions, i));
  }
  if (centres.size() < 2) return nullptr;
  auto shared = centres.size() == row.frequencies->size()
                    ? row.frequencies
                    : std::make_shared<const std::vector<double>>(std::move(centres));
  const double trusted = std::min(kNdbcTrustedUpTo, shared->back());
  return std::make_shared<BinnedSpectrum>(std::move(shared), bins, 1, trusted);
}

}  // namespace

absl::StatusOr<SeaSeries> ReadNdbcSpectra(const NdbcTexts& texts) {
  ASSIGN_OR_RETURN(const NdbcTable energy, ReadNdbcTable(texts.energy, NdbcQuantity::kEnergy));
  ASSIGN_OR_RETURN(const auto spread,
                   ReadCompanion(texts.spread, NdbcQuantity::kSpread, energy.real_time, texts.spread_name));
  ASSIGN_OR_RETURN(const auto direction,
                   ReadCompanion(texts.direction, NdbcQuantity::kDirection, energy.real_time, texts.direction_name));

  SeaSeries series{.format = energy.real_time ? "NDBC spectra in real time" : "NDBC spectra of the history"};
  series.record_length = kNdbcRecordLength;
  const Directions directions(spread, direction);
  std::size_t empty = 0;
  for (const NdbcRow& row : energy.rows) {
    BinnedWaves waves = WavesOf(row, directions.At(row));
    if (!waves) {
      ++empty;
      continue;
    }
    series.records.push_back({.time = row.time, .waves = std::move(waves)});
  }
  if (series.records.empty()) return absl::InvalidArgumentError("none of its records has energy; give another file");
  if (empty > 0) series.assumed.push_back(absl::StrCat(empty, " records have no energy and are left out"));
  NoteIsotropic(series, "r2 or alpha2");
  series.assumed.push_back(absl::StrCat("waves are taken from the buoy up to ", kNdbcTrustedUpTo, " Hz"));
  SortByTime(series);
  return series;
}

}  // namespace albtpu
