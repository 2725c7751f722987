#include "budget/water/water_optics.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "tables/water/water_schema.h"

namespace albtpu {
namespace {

constexpr double kSunCosine = 0.85;
constexpr double kSecchiProduct = 0.94, kOldSecchiProduct = 1.7;  // Kd Z; the old one by Poole and Atkins (1929)
constexpr double kSystemFactor = 1.05;                            // of the decay of a lidar's echoes, over Kd
constexpr double kDefaultOmega0 = 0.8, kDefaultOmega0Sigma = 0.1;
constexpr double kMinFraction = 0.01, kMaxFraction = 0.03;

// Standard deviations of ln Kd where none is given. A tenth is what instruments agree within; 0.26 is what ocean colour
// reaches in coastal water; Secchi depths add 0.3 to it; a Jerlov type stands for half the step to its neighbours.
constexpr double kMeasured = 0.1, kOceanColour = 0.26, kSecchi = 0.4, kJerlov = 0.25, kSystem = 0.175;

// 1/m, of kJerlovTypes.
constexpr std::array<double, 10> kJerlovKd = {0.0486, 0.0533, 0.0590, 0.0796, 0.1171,
                                              0.1272, 0.1972, 0.3072, 0.4816, 0.7380};
constexpr std::size_t kOceanicTypes = 5;

constexpr double kPureKd532 = 0.0536, kSlopeOf490 = 0.681, kPureKd490 = 0.0224;
double Kd532Of490(double kd) { return kPureKd532 + kSlopeOf490 * (kd - kPureKd490); }

struct Attenuation {
  double kd, factor, log_sigma;  // K = kd * factor
};

Attenuation OfKd(double kd, KdKind kind) {
  switch (kind) {
    case KdKind::kSatellite490:
      return {Kd532Of490(kd), kSunCosine, kOceanColour};
    case KdKind::kDiffuse532:
      return {kd, kSunCosine, kMeasured};
    case KdKind::kSystem:
      return {kd, 1 / kSystemFactor, std::hypot(kMeasured, kSystem)};
    case KdKind::kSecchi:
      return {kd, kSunCosine, kSecchi};
    case KdKind::kJerlov:
      return {kd, kSunCosine, kJerlov};
  }
  return {kd, 1, kMeasured};
}

absl::Status Invalid(const std::string& message) { return absl::InvalidArgumentError(message); }

absl::Status CheckWays(const OpticsInput& given) {
  const bool direct = given.absorption.has_value() || given.scattering.has_value();
  const int ways = given.kd.has_value() + given.secchi.has_value() + given.jerlov.has_value() + direct;
  if (ways != 1) {
    return Invalid(absl::StrCat(
        ways == 0 ? "nothing says how clear the water is" : "the clarity of the water is given in several ways",
        "; give one of kd with kd_kind, secchi, jerlov, or absorption with scattering"));
  }
  if (given.kd.has_value() != given.kd_kind.has_value())
    return Invalid("kd and kd_kind go together (an attenuation of 490 nm is not one of 532 nm); give both");
  if (given.absorption.has_value() != given.scattering.has_value())
    return Invalid("absorption and scattering go together; give both");
  if (direct && given.omega0.has_value())
    return Invalid("omega0 contradicts absorption and scattering, which give it; leave it out");
  return absl::OkStatus();
}

Attenuation AttenuationOf(const OpticsInput& given) {
  if (given.kd.has_value()) return OfKd(*given.kd, *given.kd_kind);
  if (given.secchi.has_value()) {
    const double clearest = kSecchiProduct / *given.secchi;
    return {std::max(clearest, Kd532Of490(clearest)), kSunCosine, kSecchi};
  }
  if (given.jerlov.has_value()) {
    const auto type = static_cast<std::size_t>(std::find(kJerlovTypes.begin(), kJerlovTypes.end(), *given.jerlov) -
                                               kJerlovTypes.begin());
    return {kJerlovKd[type], type < kOceanicTypes ? 1 : kSunCosine, kJerlov};
  }
  const double a = *given.absorption, b = *given.scattering;
  const double fraction = given.backscatter_fraction.value_or(kMeanBackscatterFraction);
  return {std::sqrt(a * a + 6 * fraction * a * b), 1, kMeasured};
}

}  // namespace

double WaterOptics::MaxRatio(double attenuation, double backscatter_fraction) {
  const double relative = attenuation / kPureWaterAbsorption;
  return std::max(0.0, (relative * relative - 1) / (6 * backscatter_fraction));
}

double WaterOptics::median_fraction() const { return std::sqrt(least_fraction * most_fraction); }

bool WaterOptics::limited_by_pure_water() const {
  constexpr double kRounding = 1e-9;
  return MaxRatio(attenuation, median_fraction()) < scattering_over_absorption * (1 - kRounding);
}

double WaterOptics::typical_albedo() const {
  const double ratio = std::min(scattering_over_absorption, MaxRatio(attenuation, median_fraction()));
  return ratio / (1 + ratio);
}

OpticsText TextOf(const OpticsInput& given) {
  const std::string of_sun =
      absl::StrCat("K = ", kSunCosine, " Kd, the mean cosine of the sun's light in water (Gordon 1989)");
  if (given.secchi.has_value()) {
    return {"the Secchi depth", absl::StrCat("Secchi depth Z = ", *given.secchi, " m"),
            absl::StrFormat("Kd = %g / Z (Lee et al. 2015; %g / Z by Poole and Atkins 1929 would be %.1f times as "
                            "much), not less than 532 nm has where 490 nm has this; %s",
                            kSecchiProduct, kOldSecchiProduct, kOldSecchiProduct / kSecchiProduct, of_sun)};
  }
  if (given.jerlov.has_value()) {
    const std::string type = absl::StrCat("Jerlov type ", std::string(*given.jerlov));
    return {type, type,
            absl::StrCat("Kd of the type at 532 nm (Jerlov 1976, Table XXVII); K = Kd of oceanic types, ", kSunCosine,
                         " Kd of coastal ones (Gordon 1989)")};
  }
  if (!given.kd.has_value()) {
    return {"absorption and scattering",
            absl::StrCat("absorption a = ", *given.absorption, " 1/m, scattering b = ", *given.scattering, " 1/m"),
            "K = sqrt(a^2 + 6 B a b), B the backscatter fraction"};
  }
  const std::string kind(kKdKindNames[static_cast<std::size_t>(*given.kd_kind)]);
  OpticsText text = {absl::StrCat("kd of kind ", kind), absl::StrCat("Kd = ", *given.kd, " 1/m of kind ", kind),
                     of_sun};
  if (given.kd_kind == KdKind::kSatellite490) {
    text.formula = absl::StrCat("Kd(532) = ", kPureKd532, " + ", kSlopeOf490, " (Kd - ", kPureKd490,
                                ") (Austin and Petzold 1986); ", of_sun);
  } else if (given.kd_kind == KdKind::kSystem) {
    text.formula =
        absl::StrCat("K = Kd / ", kSystemFactor, ": the lidar's echoes decay 0.88 to 1.25 times as fast as Kd says");
  }
  return text;
}

absl::StatusOr<WaterOptics> OpticsOf(const OpticsInput& given) {
  if (absl::Status status = CheckWays(given); !status.ok()) return status;
  const Attenuation attenuation = AttenuationOf(given);
  WaterOptics optics;
  optics.attenuation = attenuation.kd * attenuation.factor;
  const double given_or_derived = given.kd.value_or(attenuation.kd);
  const double slope = given.kd_kind == KdKind::kSatellite490 ? kSlopeOf490 : 1;
  optics.attenuation_log_sigma =
      given.kd_sigma.has_value() ? slope * *given.kd_sigma / attenuation.kd : attenuation.log_sigma;
  optics.least_fraction = given.backscatter_fraction.value_or(kMinFraction);
  optics.most_fraction = given.backscatter_fraction.value_or(kMaxFraction);
  const bool direct = given.absorption.has_value();
  if (direct ? *given.absorption < kPureWaterAbsorption : !(optics.attenuation > kPureWaterAbsorption)) {
    const double least = direct ? kPureWaterAbsorption : given_or_derived * kPureWaterAbsorption / optics.attenuation;
    return Invalid(absl::StrCat("the water is clearer than pure water, which absorbs ", kPureWaterAbsorption,
                                " 1/m at 532 nm; an attenuation or absorption of its kind is above ", least, " 1/m"));
  }
  const double greatest = WaterOptics::MaxRatio(optics.attenuation, optics.median_fraction());
  const double omega0 = given.omega0.value_or(kDefaultOmega0);
  const double ratio = direct ? *given.scattering / *given.absorption : omega0 / (1 - omega0);
  if (!direct && ratio > greatest && given.omega0.has_value()) {
    return Invalid(absl::StrCat("omega0 = ", omega0, " leaves an attenuation of ", optics.attenuation,
                                " 1/m less absorption than pure water has; give at most ", greatest / (1 + greatest)));
  }
  const double albedo = ratio / (1 + ratio);
  optics.scattering_over_absorption = ratio;
  if (!direct && !given.omega0.has_value()) {
    optics.min_ratio = kMinAlbedo / (1 - kMinAlbedo);
    optics.max_ratio = kMaxAlbedo / (1 - kMaxAlbedo);
  }
  const double sigma = given.omega0_sigma.value_or(direct ? 0 : kDefaultOmega0Sigma);
  // d ln(w / (1 - w)) = dw / (w (1 - w)); measured coefficients are as good as an attenuation.
  optics.ratio_log_sigma = direct ? std::hypot(kMeasured, kMeasured) : sigma / (albedo * (1 - albedo));
  return optics;
}

}  // namespace albtpu
