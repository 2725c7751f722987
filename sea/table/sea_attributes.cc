#include "sea/table/sea_attributes.h"

#include <cmath>

#include "absl/strings/str_join.h"
#include "sea/angle.h"
#include "sea/response/closed_form.h"
#include "sea/spectra/spectrum_moments.h"

namespace albtpu {
namespace {

// The variance of the slope under the beam of ShareMeasured(), whatever its direction.
double SlopeVariance(HarmonicSpectrum spectrum) {
  const BeamOptions beam{.footprint = 0.6};
  for (std::size_t i = 0; i < spectrum.size(); ++i) spectrum.s[i] *= FootprintPower(beam, spectrum.k[i], 0);
  return MeanSquareSlope(spectrum);
}

std::string_view WindSource(const SeaAssumptions& assumed) {
  if (assumed.wind_unknown) return "unknown";
  return assumed.wind_speed_from_waves ? "waves" : "told";
}

}  // namespace

double ShareMeasured(const DescribedSea& sea) {
  const double all = SlopeVariance(sea.spectrum);
  return all > 0 ? SlopeVariance(sea.resolved) / all : 0;
}

std::vector<std::string> Sentences(const SeaAssumptions& assumed) {
  std::vector<std::string> sentences;
  const auto add_if = [&](bool is_assumed, const char* sentence) {
    if (is_assumed) sentences.emplace_back(sentence);
  };
  add_if(assumed.wind_speed_from_waves, "the wind speed is derived from the shortest measured waves");
  add_if(assumed.wind_unknown, "the wind is not known and cannot be derived from the waves: it is taken as calm");
  add_if(assumed.wind_direction_from_waves, "the wind blows along the shortest measured waves");
  add_if(assumed.wind_direction_unknown,
         "the wind's direction is not known and the shortest waves have none: its waves are taken as isotropic");
  add_if(assumed.axes_from_north, "the harmonics count from north, because no direction of the wind is given");
  add_if(assumed.tail_from_of_waves, "the tail begins where the waves are trusted up to");
  add_if(assumed.level_held,
         "at the cut-off the waves are more than twice the wind's or less than half: the "
         "level of the tail is held at that");
  add_if(assumed.wind_sea_missing,
         "such waves, as of swell alone, leave out what this wind raises below the cut-off: give its waves, too");
  add_if(assumed.level_unknown, "there is no energy at the cut-off: the tail is the wind's");
  return sentences;
}

std::map<std::string, AttributeValue> AttributesOf(const DescribedSea& sea, std::optional<TailRule> tail) {
  std::map<std::string, AttributeValue> attributes;
  const auto add = [&](std::string_view name, AttributeValue value) { attributes.emplace(name, std::move(value)); };
  add(sea_attribute::kXAzimuth, DegreesOfRadians(sea.x_azimuth));
  add(sea_attribute::kSignificantWaveHeight, SignificantWaveHeight(sea.spectrum));
  add(sea_attribute::kWindSpeed, sea.wind_speed_10m);
  add(sea_attribute::kWindSource, std::string(WindSource(sea.assumed)));
  if (std::isfinite(sea.water_depth)) add(sea_attribute::kWaterDepth, sea.water_depth);
  if (tail.has_value()) add(sea_attribute::kTail, std::string(Name(*tail)));
  if (sea.tail_from > 0) add(sea_attribute::kTailFrom, sea.tail_from);
  add(sea_attribute::kShareMeasured, ShareMeasured(sea));
  const std::vector<std::string> sentences = Sentences(sea.assumed);
  if (!sentences.empty()) add(sea_attribute::kAssumptions, absl::StrJoin(sentences, "\n"));
  return attributes;
}

}  // namespace albtpu
