#include "sea/files/ndbc_bulk.h"

#include <algorithm>
#include <array>
#include <memory>
#include <numbers>
#include <utility>

#include "absl/strings/str_cat.h"
#include "sea/angle.h"
#include "sea/files/ndbc_spectra.h"
#include "sea/files/ndbc_table.h"
#include "sea/files/sea_csv.h"
#include "sea/files/text_lines.h"
#include "sea/spectra/equilibrium_wind.h"
#include "sea/spectra/jonswap.h"
#include "status/status_macros.h"

namespace albtpu {
namespace {

constexpr std::array<std::string_view, 16> kCompassPoints = {"N", "NNE", "NE", "ENE", "E", "ESE", "SE", "SSE",
                                                             "S", "SSW", "SW", "WSW", "W", "WNW", "NW", "NNW"};

// A column by one of its names; npos if there is none.
constexpr std::size_t kNone = static_cast<std::size_t>(-1);

std::size_t Column(const std::vector<std::string_view>& header, std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names) {
    const auto found = std::find(header.begin(), header.end(), name);
    if (found != header.end()) return static_cast<std::size_t>(found - header.begin());
  }
  return kNone;
}

struct WaveColumns {
  std::size_t height, period, direction;
};

class NdbcBulkReader {
 public:
  NdbcBulkReader(std::string_view text, double anemometer_height)
      : lines_(text), anemometer_height_(anemometer_height) {}

  absl::StatusOr<SeaSeries> Read() {
    const auto first = lines_.Next();
    if (!first) return lines_.CutError();
    ReadHeader(Words(*first));
    while (const auto line = lines_.Next()) {
      const std::vector<std::string_view> words = Words(*line);
      if (words.empty() || words.front().starts_with('#')) continue;
      RETURN_IF_ERROR(ReadRecord(words));
    }
    if (lines_.cut()) return lines_.CutError();
    if (series_.records.empty()) RETURN_IF_ERROR(TakeWinds());
    SayWhatIsAssumed();
    SortByTime(series_);
    return std::move(series_);
  }

 private:
  void ReadHeader(const std::vector<std::string_view>& header) {
    columns_ = header.size();
    date_ = NdbcDateColumns(header);
    separated_ = Column(header, {"SwH"}) != kNone;
    series_.format = separated_ ? "an NDBC summary of spectra" : "NDBC standard meteorological data";
    series_.record_length = kNdbcRecordLength;
    if (separated_) {
      waves_ = {{Column(header, {"WWH"}), Column(header, {"WWP"}), Column(header, {"WWD"})},
                {Column(header, {"SwH"}), Column(header, {"SwP"}), Column(header, {"SwD"})}};
    } else {
      waves_ = {{Column(header, {"WVHT"}), Column(header, {"DPD"}), Column(header, {"MWD"})}};
      has_waves_ = waves_.front().height != kNone;
    }
    wind_speed_ = Column(header, {"WSPD"});
    wind_direction_ = Column(header, {"WDIR", "WD"});
  }

  absl::Status ReadRecord(const std::vector<std::string_view>& words) {
    const auto time = NdbcTime(words, date_);
    if (!time) return lines_.Error("does not begin with a date and time; get another copy of the file");
    if (words.size() != columns_)
      return lines_.Error("has ", words.size(), " columns (expected ", columns_, "); get another copy of the file");
    if (series_.records.size() + winds_.size() >= kMaxSeaRecords)
      return lines_.Error("is one record too many (at most ", kMaxSeaRecords, "); split the file");
    SeaRecord record{.time = time};
    std::vector<JonswapWaves> components;
    const std::size_t before = without_period_;
    for (std::size_t i = 0; i < waves_.size(); ++i)
      if (absl::Status status = AddWaves(words, waves_[i], separated_ && i == 1, components); !status.ok())
        return status;
    RETURN_IF_ERROR(AddWind(words, record));
    if (components.empty()) {
      without_waves_ += without_period_ == before;
      with_speed_ += record.wind_speed_10m.has_value();
      const bool directed = record.wind_from.has_value() || record.wind_speed_10m == 0;
      if (record.wind_speed_10m.has_value() && directed) {
        record.waves = WindAlone();
        winds_.push_back(std::move(record));
      }
      return absl::OkStatus();
    }
    record.waves = std::make_shared<const std::vector<JonswapWaves>>(std::move(components));
    series_.records.push_back(std::move(record));
    return absl::OkStatus();
  }

  // Stations on the coast measure no waves.
  absl::Status TakeWinds() {
    if (without_period_ > 0) {
      return absl::InvalidArgumentError(absl::StrCat(
          "none of its records has a period (DPD) of at most ", kLongestPeak, " s with the height of its waves, up to ",
          highest_without_period_, " m; give a file that has periods, or --hs, --tp and --waves-from"));
    }
    is_of_winds_ = !winds_.empty();
    series_.records = std::exchange(winds_, {});
    if (is_of_winds_) {
      series_.format = "NDBC winds";
      return absl::OkStatus();
    }
    return absl::InvalidArgumentError(absl::StrCat("none of its ", without_waves_, " records has waves (",
                                                   has_waves_ ? "height or period is missing" : "no column WVHT",
                                                   ") or, in their place, a wind (",
                                                   wind_speed_ == kNone ? "no column WSPD"
                                                   : with_speed_ > 0    ? "its direction is missing"
                                                                        : "its speed is missing",
                                                   "); give the file of a buoy, or --hs, --tp and --waves-from"));
  }

  absl::Status AddWaves(const std::vector<std::string_view>& words, const WaveColumns& columns, bool swell,
                        std::vector<JonswapWaves>& components) {
    const auto height = Value(words, columns.height, 99), period = Value(words, columns.period, 99);
    const auto direction = Direction(words, columns.direction);
    for (const absl::Status& status : {height.status(), period.status(), direction.status()})
      if (!status.ok()) return status;
    if (!*height) return absl::OkStatus();
    if (!*period || **period == 0 || **period > kLongestPeak) {
      without_period_ += **height > 0;
      highest_without_period_ = std::max(highest_without_period_, **height);
      return absl::OkStatus();
    }
    if (**period < kShortestPeak)
      return lines_.Error("has a period of ", **period, " s (expected ", kShortestPeak, " to ", kLongestPeak,
                          "); get another copy of the file");
    JonswapWaves waves{.significant_wave_height = **height, .peak_period = **period};
    if (swell) {
      waves.gamma = kSwellGamma;
      waves.spread = kSwellSpread;
    }
    if (*direction) {
      waves.travels_towards = **direction + std::numbers::pi;
    } else {
      waves.spread = std::numbers::sqrt2;  // isotropic
      ++without_direction_;
    }
    components.push_back(waves);
    return absl::OkStatus();
  }

  absl::Status AddWind(const std::vector<std::string_view>& words, SeaRecord& record) {
    ASSIGN_OR_RETURN(const auto speed, Value(words, wind_speed_, 99));
    ASSIGN_OR_RETURN(record.wind_from, Direction(words, wind_direction_));
    if (speed) record.wind_speed_10m = WindSpeedAt10m(*speed, anemometer_height_);
    return absl::OkStatus();
  }

  // A number from 0; nullopt if the column is absent or its value missing, which is `missing` or more.
  absl::StatusOr<std::optional<double>> Value(const std::vector<std::string_view>& words, std::size_t column,
                                              double missing) const {
    if (column == kNone || words[column] == "MM") return std::nullopt;
    const auto value = ParseNumber(words[column]);
    if (!value || *value < 0)
      return lines_.Error(Quoted(words[column]), " is no number from 0; get another copy of the file");
    return *value >= missing ? std::nullopt : value;
  }

  // rad, from.
  absl::StatusOr<std::optional<double>> Direction(const std::vector<std::string_view>& words,
                                                  std::size_t column) const {
    if (column == kNone) return std::nullopt;
    const auto point = std::find(kCompassPoints.begin(), kCompassPoints.end(), words[column]);
    if (point != kCompassPoints.end())
      return static_cast<double>(point - kCompassPoints.begin()) * RadiansOfDegrees(22.5);
    if (words[column] == "-99" || words[column] == "-") return std::nullopt;
    const auto degrees = Value(words, column, 999);
    if (!degrees.ok() || !*degrees) return degrees;
    if (**degrees > 360) return lines_.Error(Quoted(words[column]), " is no direction; get another copy of the file");
    return RadiansOfDegrees(**degrees);
  }

  void SayWhatIsAssumed() {
    const auto say = [&](auto... parts) { series_.assumed.push_back(absl::StrCat(parts...)); };
    if (is_of_winds_) {
      say("it has no waves: the sea of each record is that of its wind, fully developed, without swell");
      say("winds are taken as measured ", anemometer_height_, " m above the water");
      if (without_waves_ > series_.records.size())
        say(without_waves_ - series_.records.size(), " records have no wind or no direction of it and are left out");
      return;
    }
    say("the waves are taken as JONSWAP's of these heights and periods: gamma 3.3 and Mitsuyasu's spreading",
        separated_ ? ", swell gamma 7 and a spread of 18 degrees" : "");
    if (!separated_) say("swell and wind waves are not separated: spectra or a .spec file are more accurate");
    if (wind_speed_ != kNone) say("winds are taken as measured ", anemometer_height_, " m above the water");
    if (without_waves_ > 0) say(without_waves_, " records have no waves and are left out");
    if (without_period_ > 0) {
      say(without_period_, " heights of waves, up to ", highest_without_period_, " m, have no period, or one above ",
          kLongestPeak, " s, and are left out");
    }
    if (without_direction_ > 0) say(without_direction_, " wave heights have no direction and are taken as isotropic");
  }

  TextLines lines_;
  double anemometer_height_;
  std::size_t columns_ = 0;
  NdbcDate date_;
  bool separated_ = false;
  std::vector<WaveColumns> waves_;
  std::size_t wind_speed_ = kNone, wind_direction_ = kNone;
  SeaSeries series_{};
  std::vector<SeaRecord> winds_;  // Of records without waves.
  bool has_waves_ = true, is_of_winds_ = false;
  std::size_t with_speed_ = 0;  // Records without waves that have a speed of the wind.
  std::size_t without_waves_ = 0, without_period_ = 0, without_direction_ = 0;
  double highest_without_period_ = 0;  // m
};

}  // namespace

bool IsNdbcBulk(std::string_view first_line) {
  const std::vector<std::string_view> words = Words(first_line);
  return NdbcDateColumns(words).count > 0 && (Column(words, {"WVHT"}) != kNone || Column(words, {"WSPD"}) != kNone);
}

absl::StatusOr<SeaSeries> ReadNdbcBulk(std::string_view text, double anemometer_height) {
  return NdbcBulkReader(text, anemometer_height).Read();
}

}  // namespace albtpu
