#include "annotate/seas/sea_facts.h"

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "formats/text/text.h"
#include "sea/angle.h"
#include "sea/response/closed_form.h"
#include "sea/response/sea_response.h"
#include "sea/sea_time.h"
#include "sea/spectra/spectrum_moments.h"
#include "sea/table/sea_attributes.h"

namespace albtpu::annotate {
namespace {

using nlohmann::ordered_json;

constexpr double kReferenceFootprint = 0.6;  // m

bool IsComplete(const SeaRecord& record) { return std::holds_alternative<WholeSea>(record.waves); }

bool IsOfWindAlone(const SeaRecord& record) { return std::holds_alternative<WindAlone>(record.waves); }

double PeakOfBins(const BinnedSpectrum& bins) {
  std::size_t peak = 0;
  for (std::size_t i = 1; i < bins.size(); ++i)
    if (bins.bin(i).energy > bins.bin(peak).energy) peak = i;
  return bins.bin(peak).energy > 0 ? 1 / bins.centre(peak) : 0;
}

// The period of the waves with the highest peak.
double PeakOfComponents(const std::vector<JonswapWaves>& waves, double depth) {
  const JonswapSpectrum spectrum(waves, depth);
  double period = 0, highest = 0;
  for (const JonswapWaves& each : waves) {
    const double energy = spectrum(1 / each.peak_period).energy;
    if (energy <= highest) continue;
    highest = energy;
    period = each.peak_period;
  }
  return period;
}

// The wavenumber at which E(f) = S(k) dk/df has its maximum.
double PeakOfSpectrum(const HarmonicSpectrum& spectrum, double depth) {
  double period = 0, highest = 0;
  for (std::size_t i = 0; i < spectrum.size(); ++i) {
    if (!(spectrum.s[i] > 0)) continue;
    const double energy = spectrum.s[i] / FrequencySlope(spectrum.k[i], depth);
    if (energy <= highest) continue;
    highest = energy;
    period = 1 / FrequencyOfWavenumber(spectrum.k[i], depth);
  }
  return period;
}

double PeakPeriod(const SeaRecord& record, const DescribedSea& sea) {
  const double depth = sea.water_depth;
  if (IsOfWindAlone(record)) return PeakOfSpectrum(sea.spectrum, depth);
  if (const auto* bins = std::get_if<BinnedWaves>(&record.waves)) return PeakOfBins(**bins);
  if (const auto* waves = std::get_if<WaveComponents>(&record.waves)) return PeakOfComponents(**waves, depth);
  return PeakOfSpectrum(*std::get<WholeSea>(record.waves), depth);
}

// Of the elevation variance, by the second harmonic.
double Axis(const DescribedSea& sea) {
  HarmonicSpectrum cosine = sea.resolved, sine = sea.resolved;
  for (std::size_t i = 0; i < sea.resolved.size(); ++i) {
    cosine.s[i] *= sea.resolved.a[0][i];
    sine.s[i] *= sea.resolved.b[0][i];
  }
  const double psi = std::atan2(ElevationVariance(sine), ElevationVariance(cosine)) / 2;
  const double axis = std::fmod(DegreesOfRadians(sea.x_azimuth - psi), 180);
  return axis < 0 ? axis + 180 : axis;
}

double FootprintWeight(double k) { return FootprintPower({.footprint = kReferenceFootprint}, k, 0); }

// The axis x, 2 sigma.
double RefractionAlong(const HarmonicSpectrum& spectrum, double index, const std::vector<FootprintKernel>& footprint) {
  const SeaResponse response(spectrum, index);
  return DegreesOfRadians(response.AlongDirection(0, 0, footprint)[0].refraction_along_wind());
}

SeaDescription DescriptionAt(const SeaTimeline& seas, std::size_t record) {
  return DescriptionOf(seas.record(record), seas.settings().description());
}

std::string WindText(const SeaFacts& facts) {
  std::string text = absl::StrFormat("wind %.3g m/s (%s)", facts.sea.wind_speed_10m,
                                     facts.wind_speed_of == "user"    ? "given"
                                     : facts.wind_speed_of == "file"  ? "of the file"
                                     : facts.wind_speed_of == "waves" ? "derived from the waves"
                                                                      : "not known: taken as calm");
  if (facts.wind_direction_of == "none") return text;
  if (facts.wind_direction_of == "unknown") return text + ", direction not known";
  const double from = std::fmod(DegreesOfRadians(facts.sea.x_azimuth) + 180, 360);
  return absl::StrFormat("%s from %.0f degrees%s", text, from,
                         facts.wind_direction_of == "waves" ? " (along the waves)" : "");
}

}  // namespace

SeaFacts FactsOf(const SeaTimeline& seas, std::size_t record) {
  const SeaRecord& state = seas.record(record);
  const config::SeaSettings& settings = seas.settings();
  SeaFacts facts;
  facts.time = state.time;
  facts.sea = Describe(state, settings.description());
  const auto* components = std::get_if<WaveComponents>(&state.waves);
  facts.significant_wave_height = components != nullptr
                                      ? JonswapSpectrum(**components, facts.sea.water_depth).significant_wave_height()
                                  : IsOfWindAlone(state) ? SignificantWaveHeight(facts.sea.spectrum)
                                                         : state.significant_wave_height();
  facts.peak_period = PeakPeriod(state, facts.sea);
  facts.axis = Axis(facts.sea);
  facts.wind_speed_of = settings.wind_speed.has_value()           ? "user"
                        : state.wind_speed_10m.has_value()        ? "file"
                        : facts.sea.assumed.wind_speed_from_waves ? "waves"
                                                                  : "unknown";
  facts.wind_direction_of = !(facts.sea.wind_speed_10m > 0)               ? "none"
                            : settings.wind_from.has_value()              ? "user"
                            : state.wind_from.has_value()                 ? "file"
                            : facts.sea.assumed.wind_direction_from_waves ? "waves"
                                                                          : "unknown";
  const bool joined = !IsComplete(state) && !IsOfWindAlone(state) && facts.sea.wind_speed_10m > 0;
  facts.tail = joined ? settings.tail.value_or("relax") : "none";
  facts.share_measured = ShareMeasured(facts.sea);
  if (!IsComplete(state))
    facts.error = ErrorOfSea(DescriptionAt(seas, record), seas.series().record_length, FootprintWeight);
  return facts;
}

ordered_json Json(const SeaFacts& facts) {
  ordered_json json;
  json["time"] = facts.time.has_value() ? ordered_json(SeaTimeText(*facts.time)) : ordered_json();
  json["hs"] = facts.significant_wave_height;
  json["tp"] = facts.peak_period > 0 ? ordered_json(facts.peak_period) : ordered_json();
  json["axis"] = facts.axis;
  json["wind_speed"] = facts.sea.wind_speed_10m;
  json["wind_speed_of"] = facts.wind_speed_of;
  json["x_azimuth"] = DegreesOfRadians(facts.sea.x_azimuth);
  json["wind_direction_of"] = facts.wind_direction_of;
  const bool deep = std::isinf(facts.sea.water_depth);
  json["water_depth"] = deep ? ordered_json() : ordered_json(facts.sea.water_depth);
  json["tail"] = facts.tail;
  json["tail_from"] = facts.sea.tail_from > 0 ? ordered_json(facts.sea.tail_from) : ordered_json();
  json["share_measured"] = facts.share_measured;
  json["relative_standard_error"] = nullptr;  // Of 2 sigma: half of that of the slope variance.
  if (facts.error.has_value()) {
    json["relative_standard_error"] = {
        {"sampling", facts.error->sampling / 2}, {"tail", facts.error->tail / 2}, {"total", facts.error->total / 2}};
  }
  json["assumed"] = Sentences(facts.sea.assumed);
  return json;
}

std::string Text(const SeaFacts& facts) {
  std::string text = facts.time.has_value() ? SeaTimeText(*facts.time) + ": " : "";
  absl::StrAppendFormat(&text, "Hs %.2f m", facts.significant_wave_height);
  if (facts.peak_period > 0) absl::StrAppendFormat(&text, ", Tp %.1f s", facts.peak_period);
  absl::StrAppend(&text, ", ", WindText(facts));
  if (facts.tail != "none") {
    absl::StrAppendFormat(&text, ", tail %s from %.3g Hz, %s of the slope variance at 0.6 m not of the tail",
                          facts.tail, facts.sea.tail_from, formats::PercentText(facts.share_measured));
  }
  if (facts.error.has_value() && facts.error->total > 0)
    absl::StrAppend(&text, ", own standard error ", formats::PercentText(facts.error->total / 2));
  return text;
}

SlopeSurvey::SlopeSurvey(double index) : index_(index) {
  for (const double diameter : kDiameters) footprints_.emplace_back(BeamProfile::kUniform, diameter);
  one_footprint_.emplace_back(BeamProfile::kUniform, kReferenceFootprint);
}

SlopeFacts SlopeSurvey::operator()(const SeaTimeline& seas, std::size_t record) const {
  const DescribedSea sea = Describe(seas.record(record), seas.settings().description());
  SlopeFacts facts;
  facts.mean_square_slope = MeanSquareSlope(sea.spectrum);
  facts.below_11 = MeanSquareSlopeBelow(sea.spectrum, 11);
  facts.below_20 = MeanSquareSlopeBelow(sea.spectrum, 20);
  const SeaResponse response(sea.spectrum, index_);
  const std::vector<BeamResponse> beams = response.AlongDirection(0, 0, footprints_);
  for (std::size_t i = 0; i < beams.size(); ++i) {
    HarmonicSpectrum under = sea.spectrum;
    const BeamOptions beam{.footprint = kDiameters[i]};
    for (std::size_t j = 0; j < under.size(); ++j) under.s[j] *= FootprintPower(beam, under.k[j], 0);
    facts.footprints.push_back({kDiameters[i], MeanSquareSlope(under),
                                DegreesOfRadians(beams[i].refraction_along_wind()),
                                DegreesOfRadians(beams[i].refraction_cross_wind())});
  }
  if (IsComplete(seas.record(record)) || IsOfWindAlone(seas.record(record)) || !(sea.wind_speed_10m > 0)) return facts;
  config::SeaSettings settings = seas.settings();
  for (const std::string_view rule : config::kTailRules) {
    settings.tail = rule;
    facts.by_tail_rule.push_back(
        RefractionAlong(Describe(seas.record(record), settings.description()).spectrum, index_, one_footprint_));
  }
  return facts;
}

ordered_json Json(const SlopeFacts& facts) {
  ordered_json json;
  json["mean_square_slope"] = facts.mean_square_slope;
  json["mean_square_slope_below_11"] = facts.below_11;
  json["mean_square_slope_below_20"] = facts.below_20;
  json["footprints"] = ordered_json::array();
  for (const SlopeFacts::Footprint& footprint : facts.footprints) {
    json["footprints"].push_back({{"footprint", footprint.diameter},
                                  {"slope_variance", footprint.slope_variance},
                                  {"refraction_along", footprint.refraction_along},
                                  {"refraction_cross", footprint.refraction_cross}});
  }
  json["refraction_along_by_tail"] = nullptr;
  for (std::size_t i = 0; i < facts.by_tail_rule.size(); ++i)
    json["refraction_along_by_tail"][std::string(config::kTailRules[i])] = facts.by_tail_rule[i];
  return json;
}

ordered_json SeasHeadJson(const SeaTimeline& seas) {
  ordered_json json;
  const std::optional<std::string>& file = seas.settings().file;
  json["file"] = file.has_value() ? ordered_json(std::filesystem::path(*file).filename().string()) : ordered_json();
  json["format"] = file.has_value() ? ordered_json(seas.series().format) : ordered_json();
  json["place"] = seas.place().empty() ? ordered_json() : ordered_json(seas.place());
  json["by_time"] = seas.by_time();
  json["assumed"] = seas.series().assumed;
  return json;
}

ordered_json SeasJson(const SeaTimeline& seas, std::size_t first, std::size_t last) {
  ordered_json json = SeasHeadJson(seas);
  json["records"] = last - first + 1;
  json["first"] = Json(FactsOf(seas, first));
  json["last"] = Json(FactsOf(seas, last));
  return json;
}

std::vector<std::string> SeasNotes(const SeaTimeline& seas, std::size_t first, std::size_t last) {
  std::string where = "sea";
  if (seas.settings().file.has_value())
    absl::StrAppend(&where, " by ", std::filesystem::path(*seas.settings().file).filename().string());
  if (!seas.place().empty()) absl::StrAppend(&where, " at ", seas.place());
  const SeaFacts facts = FactsOf(seas, first);
  std::vector<std::string> notes = {absl::StrCat(where, ", ", Text(facts))};
  if (last != first)
    notes.push_back(
        absl::StrCat("  interpolated in time, over ", last - first + 1, " records, to ", Text(FactsOf(seas, last))));
  std::vector<std::string> assumed = Sentences(facts.sea.assumed);
  assumed.insert(assumed.end(), seas.series().assumed.begin(), seas.series().assumed.end());
  if (!assumed.empty()) notes.push_back(absl::StrCat("  assumed: ", absl::StrJoin(assumed, "; ")));
  return notes;
}

}  // namespace albtpu::annotate
