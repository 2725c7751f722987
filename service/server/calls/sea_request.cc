#include "service/server/calls/sea_request.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "sea/files/sea_csv.h"
#include "service/server/calls/water_request.h"
#include "service/server/ground/errors.h"
#include "service/server/ground/limits.h"
#include "status/status_macros.h"

namespace albtpu::server {
namespace {

// The range of a number on the wire. sea.proto states the same ranges.
struct Range {
  double lowest, highest;
  std::string_view unit;
};
constexpr Range kHeight = {0, 100, " m"};
constexpr Range kPeriod = {kShortestPeak, kLongestPeak, " s"};
constexpr Range kGamma = {1, 100, ""};
constexpr Range kDirection = {-4 * std::numbers::pi, 4 * std::numbers::pi, " rad"};
constexpr Range kSpread = {0, std::numbers::sqrt2, " rad"};
constexpr Range kFrequency = {kLowestFrequency, kHighestFrequency, " Hz"};
constexpr Range kWavenumber = {kLowestWavenumber, kHighestWavenumber, " rad/m"};
constexpr Range kDensity = {0, kMaxDensity, ""};
constexpr Range kRecordLength = {1, 1e9, " s"};
constexpr Range kWindSpeed = {0, kStrongestWind, " m/s"};
constexpr Range kDepth = {0.1, kDeepestWater, " m"};

using Numbers = google::protobuf::RepeatedField<double>;

class SeaReader {
 public:
  absl::StatusOr<KnownSea> Read(const v1::SeaState& state) {
    KnownSea sea;
    sea.wind_speed_10m = Optional(state.has_wind_speed(), "wind_speed", state.wind_speed(), kWindSpeed);
    sea.wind_from = Optional(state.has_wind_from(), "wind_from", state.wind_from(), kDirection);
    sea.water_depth = Optional(state.has_water_depth(), "water_depth", state.water_depth(), kDepth);
    sea.tail_from = Optional(state.has_tail_from(), "tail_from", state.tail_from(), kFrequency);
    sea.tail = Tail(state.tail_rule());
    switch (state.waves_case()) {
      case v1::SeaState::kComponents:
        sea.waves = Components(state.components());
        break;
      case v1::SeaState::kFrequencySpectrum:
        sea.waves = Bins(state.frequency_spectrum());
        if (state.frequency_spectrum().has_record_length())
          sea.record_length =
              Checked("frequency_spectrum.record_length", state.frequency_spectrum().record_length(), kRecordLength);
        break;
      case v1::SeaState::kWavenumberSpectrum:
        sea.waves = Whole(state.wavenumber_spectrum());
        break;
      case v1::SeaState::WAVES_NOT_SET:
        break;
    }
    if (const absl::Status status = violations_.ToStatus(); !status.ok()) return status;
    return sea;
  }

 private:
  // The same number, noted if it is wrong.
  double Checked(std::string_view path, double number, const Range& range) {
    if (!(number >= range.lowest && number <= range.highest)) {
      Add(path, absl::StrCat(std::string(path), " is ", number, std::string(range.unit), " (expected ", range.lowest,
                             " to ", range.highest, "); correct it"));
    }
    return number;
  }

  std::optional<double> Optional(bool given, std::string_view path, double number, const Range& range) {
    if (!given) return std::nullopt;
    return Checked(path, number, range);
  }

  TailRule Tail(v1::TailRule rule) {
    switch (rule) {
      case v1::TAIL_RULE_UNSPECIFIED:
      case v1::TAIL_RULE_RELAX:
        return TailRule::kRelax;
      case v1::TAIL_RULE_WIND:
        return TailRule::kWind;
      case v1::TAIL_RULE_LEVEL:
        return TailRule::kLevel;
      case v1::TAIL_RULE_NONE:
        return TailRule::kNone;
      default:
        Add("tail_rule", absl::StrCat("tail_rule is ", static_cast<int>(rule),
                                      " (expected a value of TailRule); correct it, or leave it out"));
        return TailRule::kRelax;
    }
  }

  WaveComponents Components(const v1::WaveComponents& message) {
    const std::string path = "components.components";
    std::vector<JonswapWaves> waves;
    if (!CheckCount(path, static_cast<std::size_t>(message.components_size()), 1, kMaxSeaComponents)) return nullptr;
    for (const v1::WaveComponent& each : message.components()) {
      const std::string at = absl::StrCat(path, "[", waves.size(), "].");
      JonswapWaves& wave = waves.emplace_back();
      wave.significant_wave_height = Checked(at + "significant_wave_height", each.significant_wave_height(), kHeight);
      wave.peak_period = Checked(at + "peak_period", each.peak_period(), kPeriod);
      if (each.has_gamma()) wave.gamma = Checked(at + "gamma", each.gamma(), kGamma);
      wave.travels_towards = Checked(at + "travels_towards", each.travels_towards(), kDirection);
      wave.spread = Optional(each.has_spread(), at + "spread", each.spread(), kSpread);
    }
    return std::make_shared<const std::vector<JonswapWaves>>(std::move(waves));
  }

  BinnedWaves Bins(const v1::FrequencySpectrum& message) {
    const std::string path = "frequency_spectrum.";
    const Numbers& frequencies = message.frequencies();
    const auto trusted =
        Optional(message.has_trusted_up_to(), path + "trusted_up_to", message.trusted_up_to(), kFrequency);
    const std::size_t harmonics =
        CheckSpectrum(path, "frequencies", frequencies, kFrequency, message.densities(), message.cosines(),
                      message.sines(), [&](int i) { return message.densities(i); });
    if (failed_) return nullptr;
    const int count = frequencies.size();
    std::vector<DirectionalEnergy> bins;
    for (int i = 0; i < count; ++i) {
      DirectionalEnergy& bin = bins.emplace_back();
      bin.energy = message.densities(i);
      for (std::size_t n = 0; n < harmonics; ++n) {
        bin.cosine[n] = message.cosines(static_cast<int>(n) * count + i);
        bin.sine[n] = message.sines(static_cast<int>(n) * count + i);
      }
    }
    return std::make_shared<const BinnedSpectrum>(
        std::make_shared<const std::vector<double>>(frequencies.begin(), frequencies.end()), bins, harmonics,
        trusted.value_or(frequencies[count - 1]));
  }

  WholeSea Whole(const v1::WavenumberSpectrum& message) {
    const std::string path = "wavenumber_spectrum.";
    const std::size_t harmonics =
        CheckSpectrum(path, "wavenumbers", message.wavenumbers(), kWavenumber, message.densities(), message.cosines(),
                      message.sines(), [](int) { return 1.0; });
    if (harmonics == 0 && !failed_)
      Add(path + "cosines", path + "cosines are missing (expected at least harmonic 2); send zeros for none");
    if (failed_) return nullptr;
    HarmonicSpectrum sea;
    sea.k.assign(message.wavenumbers().begin(), message.wavenumbers().end());
    sea.s.assign(message.densities().begin(), message.densities().end());
    const auto harmonic = [&](const Numbers& numbers, std::size_t n) {
      const auto begin = numbers.begin() + static_cast<std::ptrdiff_t>(n * sea.size());
      return std::vector<double>(begin, begin + static_cast<std::ptrdiff_t>(sea.size()));
    };
    for (std::size_t n = 0; n < harmonics; ++n) {
      sea.a.push_back(harmonic(message.cosines(), n));
      sea.b.push_back(harmonic(message.sines(), n));
    }
    return std::make_shared<const HarmonicSpectrum>(std::move(sea));
  }

  // Checks the lists of a spectrum; `longest(i)` is the maximum length of a harmonic at i. Returns the number of
  // harmonics.
  template <typename Longest>
  std::size_t CheckSpectrum(const std::string& path, const std::string& axis_name, const Numbers& axis,
                            const Range& axis_range, const Numbers& densities, const Numbers& cosines,
                            const Numbers& sines, Longest longest) {
    const auto count = static_cast<std::size_t>(axis.size());
    if (!CheckCount(path + axis_name, count, 2, kMaxSeaSamples)) return 0;
    CheckEach(path + axis_name, axis, axis_range);
    CheckIncrease(path + axis_name, axis, axis_range);
    if (CheckCount(path + "densities", static_cast<std::size_t>(densities.size()), count, count))
      CheckEach(path + "densities", densities, kDensity);
    const auto values = static_cast<std::size_t>(cosines.size());
    if (values % count != 0 || values / count > kSeaHarmonics) {
      Add(path + "cosines", absl::StrCat(path, "cosines has ", values, " numbers (expected ", count,
                                         " for each of up to ", kSeaHarmonics, " harmonics); correct it"));
    }
    CheckCount(path + "sines", static_cast<std::size_t>(sines.size()), values, values);
    if (failed_) return 0;
    for (int i = 0; i < cosines.size(); ++i) {
      const int sample = i % axis.size();
      if (std::hypot(cosines[i], sines[i]) <= longest(sample) * (1 + kHarmonicRounding)) continue;
      const std::string at = absl::StrCat(path, "cosines[", i, "]");
      Add(at, absl::StrCat(at, " and its sine are ", cosines[i], ", ", sines[i], " (expected a length up to ",
                           longest(sample), "); correct them"));
      break;
    }
    return values / count;
  }

  bool CheckCount(const std::string& path, std::size_t count, std::size_t least, std::size_t most) {
    if (count >= least && count <= most) return true;
    Add(path, absl::StrCat(path, " has ", count, count == 1 ? " entry" : " entries", " (expected ", least,
                           least == most ? "" : absl::StrCat(" to ", most), "); correct it"));
    return false;
  }

  void CheckEach(const std::string& path, const Numbers& numbers, const Range& range) {
    for (int i = 0; i < numbers.size(); ++i) {
      if (numbers[i] >= range.lowest && numbers[i] <= range.highest) continue;
      Checked(absl::StrCat(path, "[", i, "]"), numbers[i], range);
      return;
    }
  }

  void CheckIncrease(const std::string& path, const Numbers& numbers, const Range& range) {
    for (int i = 1; i < numbers.size(); ++i) {
      if (!(numbers[i] <= numbers[i - 1])) continue;
      const std::string at = absl::StrCat(path, "[", i, "]");
      Add(at, absl::StrCat(at, " is ", numbers[i], std::string(range.unit), " (expected more than ", numbers[i - 1],
                           ", the one before); sort them"));
      return;
    }
  }

  void Add(std::string_view path, std::string_view description) {
    failed_ = true;
    if (++count_ <= kMaxSeaViolations) violations_.Add(path, description);
  }

  FieldViolations violations_;
  std::size_t count_ = 0;
  bool failed_ = false;
};

}  // namespace

absl::StatusOr<KnownSea> ReadSea(const v1::SeaState& state) { return SeaReader().Read(state); }

Sha256Digest KeyOf(const v1::SeaState& state, double index) {
  v1::SeaState known = state;
  known.DiscardUnknownFields();
  Sha256 sha;
  sha.Update(absl::StrCat(absl::Hex(std::bit_cast<std::uint64_t>(index)), " sea ", known.SerializeAsString()));
  return sha.Finish();
}

namespace {

// A table and its file: the digest of the contents leaves out version and attributes, which are in answers or count in
// them.
std::string Identify(const std::string& digest, const FileIdentity& identity) {
  return absl::StrCat(digest, " ", absl::StrJoin(identity, " "));
}

Sha256Digest KeyOf(const TableCatalog::Entry& table, double index) {
  Sha256 sha;
  sha.Update(absl::StrCat(absl::Hex(std::bit_cast<std::uint64_t>(index)), " table ", table.name, " ",
                          Identify(table.table.digest(), table.identity)));
  return sha.Finish();
}

}  // namespace

absl::StatusOr<double> ReadIndex(bool given, double index, std::string_view path) {
  if (!given) return kSeaWaterIndex;
  if (index >= 1 && index <= 2) return index;
  return FieldViolation(path, absl::StrCat(std::string(path), " is ", index, " (expected 1 to 2); correct it"));
}

absl::StatusOr<const ServedTable*> AnswerSources::Find(std::string_view table, double index) {
  ASSIGN_OR_RETURN(const TableCatalog::Entry* const entry, catalog_.Find(table));
  if (entry->refractive_index == index) return entry;
  if (made_.table != nullptr) return made_.table.get();
  const Sha256Digest key = KeyOf(*entry, index);
  made_.table = seas_.Find(key);
  if (made_.table != nullptr) return made_.table.get();
  wanted_ = WantedTable{key, entry->shared_from_this(), index};
  return absl::UnavailableError("the table is not scaled yet");
}

absl::StatusOr<const ServedTable*> AnswerSources::Find(const v1::SeaState& sea, double index) {
  if (made_.table != nullptr) return made_.table.get();
  const Sha256Digest key = KeyOf(sea, index);
  made_.table = seas_.Find(key);
  if (made_.table != nullptr) return made_.table.get();
  absl::StatusOr<KnownSea> known = ReadSea(sea);
  if (!known.ok()) return Within("sea", known.status());
  wanted_ = WantedTable{key, *std::move(known), index};
  return absl::UnavailableError("the sea is not compiled yet");
}

absl::StatusOr<const ServedWater*> AnswerSources::Find(const v1::WaterState& water, const KnownWater& known) {
  if (made_.water != nullptr) return made_.water.get();
  const std::shared_ptr<const TableCatalog::Water>& table = catalog_.water();
  const Sha256Digest key =
      KeyOf(water, table == nullptr ? "" : Identify(table->table.table().digest(), table->identity));
  made_.water = waters_->Find(key);
  if (made_.water != nullptr) return made_.water.get();
  if (known.bias.has_value() && table == nullptr) {
    return absl::FailedPreconditionError(
        "this server computes no water (it has no table of the water column); give the water's columns in aircraft, or "
        "start the server with --water-table");
  }
  wanted_ = WantedWater{key, known, table};
  return absl::UnavailableError("the water is not compiled yet");
}

}  // namespace albtpu::server
