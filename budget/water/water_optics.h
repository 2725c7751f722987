// The optical properties of a water, and what follows from them for the light of a lidar.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "absl/status/statusor.h"

namespace albtpu {

// What a diffuse attenuation coefficient describes.
enum class KdKind {
  kSatellite490,  // of the sun's light at 490 nm, from ocean colour
  kDiffuse532,    // of the sun's light at 532 nm
  kSystem,        // the decay of the lidar's own echoes
  kSecchi,        // of the sun's light at 532 nm, derived from a Secchi depth
  kJerlov         // of the sun's light at 532 nm, derived from a Jerlov type
};
inline constexpr std::array<std::string_view, 5> kKdKindNames = {"satellite490", "diffuse532", "system", "secchi",
                                                                 "jerlov"};

// Jerlov's types, oceanic and coastal.
inline constexpr std::array<std::string_view, 10> kJerlovTypes = {"I",  "IA", "IB", "II", "III",
                                                                  "1C", "3C", "5C", "7C", "9C"};

// The given properties: exactly one of `kd` with its kind, `secchi`, `jerlov`, or `absorption` with `scattering`.
struct OpticsInput {
  std::optional<double> kd = {};  // 1/m
  std::optional<KdKind> kd_kind = {};
  std::optional<double> secchi = {};                       // m
  std::optional<std::string_view> jerlov = {};             // one of kJerlovTypes
  std::optional<double> absorption = {}, scattering = {};  // 1/m at 532 nm
  std::optional<double> kd_sigma = {};                     // 1/m, 1 sigma, of Kd, given or derived; absent: by its kind
  std::optional<double> omega0 = {};                       // single-scattering albedo
  std::optional<double> omega0_sigma = {};                 // 1 sigma
  std::optional<double> backscatter_fraction = {};         // absent: 0.01 to 0.03
};

// The range of natural single-scattering albedos, assumed where none is given.
inline constexpr double kMinAlbedo = 0.5, kMaxAlbedo = 0.95;

// What is known of K = sqrt(a^2 + 6 B a b), of b / a and of the backscatter fraction B. The first two have log-normal
// distributions, which of b / a is a logit-normal one of the albedo; B has a log-uniform one. All independent.
struct WaterOptics {
  double attenuation = 0, attenuation_log_sigma = 0;  // 1/m: median of K
  double scattering_over_absorption = 0, ratio_log_sigma = 0;
  double min_ratio = 0, max_ratio = 1e9;  // b / a: the range of draws
  double least_fraction = 0, most_fraction = 0;

  // The largest b / a at an attenuation: no water absorbs less than pure water.
  static double MaxRatio(double attenuation, double backscatter_fraction);

  double median_fraction() const;
  // Whether the water is so clear that the median of b / a would leave it less absorption than pure water has. Then
  // most draws are limited by that, each at its own attenuation.
  bool limited_by_pure_water() const;
  // The single-scattering albedo at the medians, within that limit.
  double typical_albedo() const;
};

// Absorption of pure water at 532 nm, 1/m: Pope and Fry (1997), doi:10.1364/AO.36.008710.
inline constexpr double kPureWaterAbsorption = 0.045;

// InvalidArgument with what would be right: none or several of the ways to give the optics, `kd` without its kind, only
// one of absorption and scattering, and water clearer than pure water.
//
// K is the Kd of sunlight times mu, the mean cosine of its angle in the water: Gordon (1989),
// doi:10.4319/lo.1989.34.8.1389. We take mu as 0.85, of a sun 45 degrees above the horizon, and 1 of Jerlov's oceanic
// types. From 490 to 532 nm: Austin and Petzold (1986), doi:10.1117/12.7973845. Secchi depth Z: Kd = 0.94 / Z in the
// clearest part of the spectrum, Lee et al. (2015), doi:10.1016/j.rse.2015.08.002, and not less than 532 nm has where
// 490 nm has this. Jerlov (1976), Table XXVII, linear between 525 and 550 nm. The echoes of a lidar decay 0.88 to 1.25
// times as fast as Kd says, depending on its field of view: it is divided by 1.05, and 0.175 added to the spread.
//
//     OpticsOf({.kd = 0.12, .kd_kind = KdKind::kDiffuse532})->attenuation  // 0.102
absl::StatusOr<WaterOptics> OpticsOf(const OpticsInput& given);

// The same for people, of what OpticsOf() takes. `way` names what was given, `entered` has its number, and `formula` is
// how K follows from it, with the source.
struct OpticsText {
  std::string way;      // "the Secchi depth"
  std::string entered;  // "Secchi depth Z = 5 m"
  std::string formula;  // "Kd = 0.94 / Z (Lee et al. 2015; ..."
};
OpticsText TextOf(const OpticsInput& given);

}  // namespace albtpu
