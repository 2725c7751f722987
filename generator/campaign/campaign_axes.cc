#include "generator/campaign/campaign_axes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "generator/campaign/campaign_keys.h"
#include "sea/angle.h"
#include "sea/files/sea_file.h"
#include "sea/sampled_spectrum.h"
#include "sea/sea_time.h"
#include "sea/spectra/elfouhaily_spectrum.h"
#include "sea/table/sea_attributes.h"
#include "tables/digest.h"
#include "tables/water/water_schema.h"

namespace albtpu {
namespace {

absl::Status Problem(const SeaOfFile& given, std::string_view what) {
  return absl::InvalidArgumentError(absl::StrCat(given.file.string(), ": ", std::string(what)));
}

// The state of the file at the given time, or its only one.
absl::StatusOr<const SeaRecord*> FindRecord(const SeaOfFile& given, const SeaSeries& series) {
  if (series.points.size() > 1)
    return Problem(given, absl::StrCat("has ", series.points.size(), " places; give a file of one of them"));
  const std::vector<SeaRecord>& records = series.records;
  if (!given.time) {
    if (records.size() == 1) return &records.front();
    return Problem(given, absl::StrCat("has ", records.size(), " states of the sea; choose one by its time, such as ",
                                       records.front().time ? SeaTimeText(*records.front().time) : "its first"));
  }
  const std::optional<double> time = ParseSeaTime(*given.time);
  if (!time) {
    return absl::InvalidArgumentError(
        absl::StrCat("'", *given.time, "' is not a time of a sea; give UTC, such as 2020-06-08T03:50Z"));
  }
  const SeaRecord* nearest = nullptr;
  for (const SeaRecord& record : records) {
    if (!record.time) continue;
    if (nearest == nullptr || std::abs(*record.time - *time) < std::abs(*nearest->time - *time)) nearest = &record;
  }
  if (nearest == nullptr) return Problem(given, "does not say when its sea was; leave out the time");
  if (*nearest->time != *time) {
    return Problem(
        given, absl::StrCat("has no sea at ", *given.time, "; the nearest is that of ", SeaTimeText(*nearest->time)));
  }
  return nearest;
}

SeaDescription DescriptionOf(const SeaOfFile& given) {
  SeaDescription description;
  description.wind_speed_10m = given.wind_speed;
  if (given.wind_from) description.wind_from = RadiansOfDegrees(*given.wind_from);
  description.water_depth = given.water_depth;
  description.tail = given.tail;
  description.tail_from = given.tail_from;
  return description;
}

std::string DigestOf(const HarmonicSpectrum& spectrum) {
  Sha256 sha;
  const auto add = [&](const std::vector<double>& values) {
    sha.Update({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double)});
  };
  add(spectrum.k);
  add(spectrum.s);
  for (const std::vector<double>& harmonic : spectrum.a) add(harmonic);
  for (const std::vector<double>& harmonic : spectrum.b) add(harmonic);
  return Hex(sha.Finish());
}

}  // namespace

absl::StatusOr<TracedSea> ReadTracedSea(const SeaOfFile& given) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(given.file, error))
    return absl::NotFoundError(absl::StrCat(given.file.string(), ": no such file of a sea"));
  const absl::StatusOr<SeaSeries> series = ReadSeaFile(given.file);
  if (!series.ok()) return Problem(given, std::string(series.status().message()));
  const absl::StatusOr<const SeaRecord*> record = FindRecord(given, *series);
  if (!record.ok()) return record.status();

  TracedSea sea;
  sea.described = Describe(**record, DescriptionOf(given));
  const bool has_tail = given.tail != TailRule::kNone && sea.described.wind_speed_10m > 0 &&
                        !std::holds_alternative<WholeSea>((*record)->waves);
  sea.attributes = AttributesOf(sea.described, has_tail ? std::optional(given.tail) : std::nullopt);
  sea.attributes["sea_file"] = given.file.filename().string();
  if ((*record)->time) sea.attributes["sea_time"] = SeaTimeText(*(*record)->time);

  std::vector<std::string> departures = Sentences(sea.described.assumed);
  departures.insert(departures.end(), series->assumed.begin(), series->assumed.end());
  const ElfouhailySpectrum any_wind(10, std::numeric_limits<double>::infinity());
  sea.waves.spectrum = std::make_shared<SampledSpectrum>(
      sea.described.spectrum,
      SpectrumText{absl::StrCat("that of ", series->format,
                                has_tail ? ", with the short waves of Elfouhaily et al. (1997)" : ""),
                   has_tail ? any_wind.reference() : "none but the file of the sea",
                   departures.empty() ? "none known" : absl::StrJoin(departures, " ")});
  sea.digest = DigestOf(sea.described.spectrum);
  return sea;
}

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Nodes are kept in single precision, as in tables: 0.1 in the file becomes the float nearest to it.
std::vector<double> InSinglePrecision(std::vector<double> nodes) {
  for (double& node : nodes) node = static_cast<float>(node);
  return nodes;
}

// The smallest float at or above `x`.
double FloatNotBelow(double x) {
  const float nearest = static_cast<float>(x);
  return nearest >= x ? nearest : std::nextafter(nearest, std::numeric_limits<float>::infinity());
}

// `inf` as the last fetch becomes the shortest fetch at which the sea of the strongest wind is fully developed: there
// the seas of all winds are, and beyond it nothing changes.
absl::Status ResolveFetch(const SpectrumModel& model, std::vector<double>& fetch,
                          const std::vector<double>& wind_speed) {
  if (fetch.empty() || fetch.back() != kInfinity) {
    return absl::InvalidArgumentError(
        "the last node of 'axes.fetch' must be inf, the fully developed sea: beyond it nothing changes");
  }
  const double strongest = *std::max_element(wind_speed.begin(), wind_speed.end());
  // A calm is the same at any fetch.
  const double developed = strongest > 0 ? FloatNotBelow(model.fully_developed_fetch(strongest)) : 1;
  fetch.back() = developed;
  if (fetch.size() > 1 && !(fetch[fetch.size() - 2] < developed)) {
    return absl::InvalidArgumentError(absl::StrCat("node ", fetch.size() - 2, " of 'axes.fetch', ",
                                                   fetch[fetch.size() - 2],
                                                   " m, is beyond full development of the strongest wind (", developed,
                                                   " m): leave it out, the last node is that sea"));
  }
  return absl::OkStatus();
}

// In the order of AxisId.
constexpr std::array<CampaignKey, kAxisCount> kAxisKeys = {campaign_keys::kWindSpeed, campaign_keys::kFetch,
                                                           campaign_keys::kIncidence, campaign_keys::kAzimuth,
                                                           campaign_keys::kFootprint, campaign_keys::kDepth};

// Whether a sea from a file replaces the axis.
bool IsOfWindSea(AxisId axis) { return axis == AxisId::kWindSpeed || axis == AxisId::kFetch; }

// In the order of WaterAxis.
constexpr std::array kWaterAxisKeys = {campaign_keys::kBackscatterFraction, campaign_keys::kScatteringOverAbsorption,
                                       campaign_keys::kIncidenceOnWater,    campaign_keys::kOpticalDepth,
                                       campaign_keys::kFieldOfView,         campaign_keys::kPulseLength};
static_assert(kWaterAxisKeys.size() == kAxisCount);

absl::StatusOr<UncertaintyTable::Axes> AxesOfKind(const TableSchema& kind, const Nodes& nodes) {
  std::vector<Axis> axes;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    absl::StatusOr<Axis> axis = Axis::Create(kind.axes[i], nodes[i]);
    if (!axis.ok()) return axis.status();
    axes.push_back(*std::move(axis));
  }
  return UncertaintyTable::Axes{axes[0], axes[1], axes[2], axes[3], axes[4], axes[5]};
}

}  // namespace

Nodes ReadNodesOfSea(CampaignFile& file, bool has_sea_file) {
  Nodes nodes;
  for (const AxisId axis : kAxes) {
    const CampaignKey& key = kAxisKeys[Index(axis)];
    if (!has_sea_file || !IsOfWindSea(axis))
      nodes[Index(axis)] = InSinglePrecision(ReadNodes(file, key));
    else if (file[key.table].Has(key.name))
      file[key.table].Fail(key.name, "has no place beside 'sea.file', which is one sea; leave it out");
  }
  return nodes;
}

Nodes ReadNodesOfWater(CampaignFile& file) {
  Nodes nodes;
  for (std::size_t axis = 0; axis < kAxisCount; ++axis)
    nodes[axis] = InSinglePrecision(ReadNodes(file, kWaterAxisKeys[axis]));
  return nodes;
}

absl::StatusOr<UncertaintyTable::Axes> MakeAxes(const SpectrumModel& model, Nodes nodes) {
  for (const AxisId axis : kAxes) {
    const std::string problem = NodesProblem(kAxisKeys[Index(axis)], nodes[Index(axis)]);
    if (!problem.empty()) return absl::InvalidArgumentError(problem);
  }
  const absl::Status fetch = ResolveFetch(model, nodes[Index(AxisId::kFetch)], nodes[Index(AxisId::kWindSpeed)]);
  if (!fetch.ok()) return fetch;

  return AxesOfKind(kSeaSurface, nodes);
}

absl::StatusOr<UncertaintyTable::Axes> MakeAxes(const TracedSea& sea, Nodes nodes) {
  for (const AxisId axis : kAxes) {
    if (IsOfWindSea(axis) || axis == AxisId::kAzimuth) continue;
    const std::string problem = NodesProblem(kAxisKeys[Index(axis)], nodes[Index(axis)]);
    if (!problem.empty()) return absl::InvalidArgumentError(problem);
  }
  const std::vector<double>& azimuth = nodes[Index(AxisId::kAzimuth)];
  if (azimuth.size() < 2 || azimuth.front() != 0 || azimuth.back() != 180) {
    return absl::InvalidArgumentError(
        "'axes.azimuth' of the sea of a file must begin at 0 and end at 180 (a sea looks alike after half a "
        "turn, "
        "and need not in a mirror); add the missing nodes");
  }
  nodes[Index(AxisId::kWindSpeed)] = InSinglePrecision({sea.described.wind_speed_10m});
  nodes[Index(AxisId::kFetch)] = {1};
  return AxesOfKind(kOneSea, nodes);
}

absl::StatusOr<UncertaintyTable::Axes> MakeWaterAxes(const Nodes& nodes) {
  for (std::size_t axis = 0; axis < kAxisCount; ++axis) {
    const std::string problem = NodesProblem(kWaterAxisKeys[axis], nodes[axis]);
    if (!problem.empty()) return absl::InvalidArgumentError(problem);
  }
  return AxesOfKind(kWaterColumn, nodes);
}

}  // namespace albtpu
