// A description of the waves, and the spectrum that follows from it.
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <string_view>
#include <variant>

#include "sea/spectra/apel_spectrum.h"
#include "sea/spectra/elfouhaily_spectrum.h"
#include "sea/spectra/wave_spectrum.h"
#include "sea/spectra/wind_sea.h"

namespace albtpu {

// Every spectrum model of the wind sea. A model is added by its own file in sea/spectra and an entry here.
inline constexpr std::array kSpectrumModels = {&kApelModel, &kElfouhailyModel};

// The keys of these models, in campaign files and on the command line.
inline constexpr std::array kSpectrumKeys = [] {
  std::array<std::string_view, kSpectrumModels.size()> keys;
  for (std::size_t i = 0; i < keys.size(); ++i) keys[i] = kSpectrumModels[i]->key;
  return keys;
}();

// The listed model with this key; null if there is none.
const SpectrumModel* FindSpectrumModel(std::string_view key);

// The waves that one steady wind raises over one fetch. A wind of 0 raises none.
struct WindSea {
  double wind_speed_10m = 0;                               // m/s, from 0
  double fetch = std::numeric_limits<double>::infinity();  // m, above 0; infinity means fully developed
  const SpectrumModel* model = &kApelModel;                // not null; it need not be a listed one
  double spreading = 2;  // s of the cosine-2S spreading; ignored by models that have their own

  std::shared_ptr<const WaveSpectrum> MakeSpectrum() const;
};

// Waves of which the spectrum itself is known: measured, computed by a model or described (sampled_spectrum.h). Then x
// and y are the axes of its own frame.
struct KnownWaves {
  std::shared_ptr<const WaveSpectrum> spectrum;  // not null

  std::shared_ptr<const WaveSpectrum> MakeSpectrum() const { return spectrum; }
};

// Another kind of description is another alternative with a MakeSpectrum().
using WaveState = std::variant<WindSea, KnownWaves>;

std::shared_ptr<const WaveSpectrum> MakeSpectrum(const WaveState& waves);

}  // namespace albtpu
