// What is known of the optics of a water, and what follows for the light of a lidar in it.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "absl/status/statusor.h"

namespace albtpu {

// What a diffuse attenuation coefficient is one of.
enum class KdKind {
  kSatellite490,  // of the sun's light at 490 nm, from ocean colour
  kDiffuse532,    // of the sun's light at 532 nm
  kSystem,        // the decay of the lidar's own echoes
  kSecchi,        // of the sun's light at 532 nm, derived from a Secchi depth
  kJerlov         // of the sun's light at 532 nm, derived from a Jerlov type
};
inline constexpr std::array<std::string_view, 5> kKdKindNames = {"satellite490", "diffuse532", "system",
                                                                 "secchi", "jerlov"};

// Jerlov's types, oceanic and coastal.
inline constexpr std::array<std::string_view, 10> kJerlovTypes = {"I",  "IA", "IB", "II", "III",
                                                                  "1C", "3C", "5C", "7C", "9C"};

// What is told: exactly one of `kd` with its kind, `secchi`, `jerlov`, or `absorption` with `scattering`.
struct ToldOptics {
  std::optional<double> kd = {};  // 1/m
  std::optional<KdKind> kd_kind = {};
  std::optional<double> secchi = {};                       // m
  std::optional<std::string_view> jerlov = {};             // one of kJerlovTypes
  std::optional<double> absorption = {}, scattering = {};  // 1/m at 532 nm
  std::optional<double> kd_sigma = {};      // 1/m, 1 sigma, of what is told or derived; absent: by its kind
  std::optional<double> omega0 = {};        // single-scattering albedo
  std::optional<double> omega0_sigma = {};  // 1 sigma
  std::optional<double> backscatter_fraction = {};  // absent: 0.01 to 0.03
};

// Albedos of natural water: an albedo that is not told is one of these.
inline constexpr double kLeastAlbedo = 0.5, kGreatestAlbedo = 0.95;

// What is known of K = sqrt(a^2 + 6 B a b), of b / a and of the backscatter fraction B. The first two have log-normal
// distributions, which of b / a is a logit-normal one of the albedo; B has a log-uniform one. All independent.
struct WaterOptics {
  double attenuation = 0, attenuation_log_sigma = 0;  // 1/m: median of K
  double scattering_over_absorption = 0, ratio_log_sigma = 0;
  double least_ratio = 0, most_ratio = 1e9;  // b / a: what lies outside is not drawn
  double least_fraction = 0, most_fraction = 0;

  // No water absorbs less than pure water: the greatest b / a that an attenuation leaves.
  static double GreatestRatio(double attenuation, double backscatter_fraction);
};

// Absorption of pure water at 532 nm, 1/m: Pope and Fry (1997), doi:10.1364/AO.36.008710.
inline constexpr double kPureWaterAbsorption = 0.045;

// InvalidArgument with what would be right: none or several of the ways to tell the optics, `kd` without its kind, half
// of absorption and scattering, and water clearer than pure water.
//
// K is the Kd of sunlight times mu, the mean cosine of its angle in the water: Gordon (1989),
// doi:10.4319/lo.1989.34.8.1389. We take mu as 0.85, of a sun 45 degrees above the horizon, and 1 of Jerlov's oceanic
// types. From 490 to 532 nm: Austin and Petzold (1986), doi:10.1117/12.7973845. Secchi depth Z: Kd = 0.94 / Z in the
// clearest part of the spectrum, Lee et al. (2015), doi:10.1016/j.rse.2015.08.002, and not less than 532 nm has where
// 490 nm has this. Jerlov (1976), Table XXVII, linear between 525 and 550 nm. The echoes of a lidar decay 0.88 to 1.25
// times as fast as Kd says, depending on its field of view: it is divided by 1.05, and 0.175 added to the spread.
//
//     OpticsOf({.kd = 0.12, .kd_kind = KdKind::kDiffuse532})->attenuation  // 0.102
absl::StatusOr<WaterOptics> OpticsOf(const ToldOptics& told);

}  // namespace albtpu
