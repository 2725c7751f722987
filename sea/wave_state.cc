#include "sea/wave_state.h"

#include <algorithm>
#include <cassert>

#include "sea/calm_spectrum.h"

namespace albtpu {

const SpectrumModel* FindSpectrumModel(std::string_view key) {
  const auto found = std::find_if(kSpectrumModels.begin(), kSpectrumModels.end(),
                                  [&](const SpectrumModel* model) { return model->key == key; });
  return found == kSpectrumModels.end() ? nullptr : *found;
}

std::shared_ptr<const WaveSpectrum> WindSea::MakeSpectrum() const {
  assert(model != nullptr && wind_speed_10m >= 0);
  if (wind_speed_10m == 0) return std::make_shared<CalmSpectrum>();
  return model->make(wind_speed_10m, fetch, Cosine2sSpreading(spreading));
}

std::shared_ptr<const WaveSpectrum> MakeSpectrum(const WaveState& waves) {
  return std::visit([](const auto& known) { return known.MakeSpectrum(); }, waves);
}

}  // namespace albtpu
