#include "sea/sea_state.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace albtpu {
const SpectrumModel* FindSpectrumModel(std::string_view key) {
  const auto found = std::find_if(kSpectrumModels.begin(), kSpectrumModels.end(),
                                  [&](const SpectrumModel* model) { return model->key == key; });
  return found == kSpectrumModels.end() ? nullptr : *found;
}

const SpectrumModel& SpectrumModelNamed(std::string_view spectrum) {
  const auto found = std::find_if(kSpectrumModels.begin(), kSpectrumModels.end(),
                                  [&](const SpectrumModel* model) { return spectrum.starts_with(model->author); });
  return found == kSpectrumModels.end() ? kElfouhailyModel : **found;
}

std::shared_ptr<const WaveSpectrum> WindSea::MakeSpectrum() const {
  assert(model != nullptr && wind_speed_10m >= 0);
  if (wind_speed_10m == 0) return std::make_shared<CalmSpectrum>();
  return model->make(wind_speed_10m, fetch, Cosine2sSpreading(spreading));
}

std::shared_ptr<const WaveSpectrum> MakeSpectrum(const WaveState& waves) {
  return std::visit([](const auto& known) { return known.MakeSpectrum(); }, waves);
}

namespace {

constexpr double kLogWavenumberStep = 0.01;

}  // namespace

SeaState::SeaState(const SeaOptions& options)
    : options_(options),
      spectrum_(MakeSpectrum(options.waves)),
      longest_wave_(2 * std::numbers::pi / options.corrected_above),
      height_scale_squared_(options.height_scale * options.height_scale) {
  assert(options.corrected_above > 0 && options.height_scale > 0);
  rings_ = std::make_shared<const std::vector<Ring>>(Rings());
}

std::vector<SeaState::Ring> SeaState::Rings() const {
  const auto [lowest, highest] = energetic_range();
  if (lowest >= highest) return {};  // all waves are corrected for
  const int steps = static_cast<int>(std::ceil(std::log(highest / lowest) / kLogWavenumberStep));
  const double step = std::log(highest / lowest) / steps;
  std::vector<Ring> rings(steps + 1);
  std::array<double, kDirections> spreading;
  for (int i = 0; i <= steps; ++i) {
    const double k = lowest * std::exp(i * step);
    if (i == 0 || spectrum_->spreading_varies_with_wavenumber())
      for (int j = 0; j < kDirections; ++j) spreading[j] = FrozenSpreading(k, (j + 0.5) * kDirectionStep);
    const double trapezoid = i == 0 || i == steps ? 0.5 : 1.0;
    const double ring = 2 * k * S(k) * step * kDirectionStep * trapezoid;  // S/k times k dk, both half planes
    rings[i].k = k;
    for (int j = 0; j < kDirections; ++j) rings[i].power[j] = ring * spreading[j];
  }
  return rings;
}

SeaState::SeaState(double wind_speed_10m, double fetch)
    : SeaState(SeaOptions{.waves = WindSea{.wind_speed_10m = wind_speed_10m, .fetch = fetch}}) {}

double SeaState::FrozenSpreading(double k, double psi) const {
  return 0.5 * (spectrum_->Spreading(k, psi) + spectrum_->Spreading(k, psi + std::numbers::pi));
}

double SeaState::Psi(double k, double psi) const { return S(k) / k * FrozenSpreading(k, psi); }

double SeaState::DirectionalPsi(double k, double psi) const { return S(k) / k * spectrum_->Spreading(k, psi); }

WavenumberRange SeaState::energetic_range() const {
  const auto [lowest, highest] = spectrum_->energetic_range();
  return {std::max(lowest, longest_wave_), highest};
}

Eigen::Matrix2d SlopeCovariance(const SeaState& sea, const std::function<double(double k, double psi)>& weight) {
  return sea.Integral(Eigen::Matrix2d(Eigen::Matrix2d::Zero()), [&](double k, double psi) {
    const Eigen::Vector2d wave(k * std::cos(psi), k * std::sin(psi));
    return Eigen::Matrix2d(weight(k, psi) * wave * wave.transpose());
  });
}

Eigen::Matrix2d SlopeCovariance(const SeaState& sea) {
  return SlopeCovariance(sea, [](double, double) { return 1.0; });
}

double ElevationVariance(const SeaState& sea) {
  return sea.Integral(0.0, [](double, double) { return 1.0; });
}

}  // namespace albtpu
