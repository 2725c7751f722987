#include "generator/campaign/provenance.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <memory>

#include "absl/strings/str_cat.h"
#include "generator/math/random_stream.h"
#include "generator/surface/discretization.h"
#include "sea/angle.h"
#include "sea/sea_state.h"
#include "tables/version.h"

namespace albtpu {
namespace {

constexpr std::uint32_t kCellOfPulses = 0xffffffff;        // of random numbers, used for nothing else
constexpr double kLeastAngle = 0.01, kLeastLength = 5e-3;  // degree, m
constexpr float kMinWind = 2;                              // m/s

// The coordinate at the fraction `t` of an axis, in its scale.
float AlongAxis(const Axis& axis, double t) {
  const double first = axis.nodes().front(), last = axis.nodes().back();
  const double x = axis.scale() == Scale::kLog ? first * std::pow(last / first, t) : first + t * (last - first);
  return static_cast<float>(std::clamp(x, first, last));
}

Estimate ValueOf(const BeamUncertainty& beam, Quantity quantity) {
  switch (quantity) {
    case Quantity::kRefractionAlongWind:
      return InDegrees(beam.refraction_along_wind);
    case Quantity::kRefractionCrossWind:
      return InDegrees(beam.refraction_cross_wind);
    case Quantity::kThu:
      return beam.thu[0];
    case Quantity::kTvu:
      return beam.tvu[0];
    default:
      assert(false);
      return {};
  }
}

}  // namespace

Pulse CheckedPulse(const Campaign& campaign, std::size_t index) {
  std::array<double, kAxisCount + 2> normals;  // rounded up to a multiple of four
  NormalStream(campaign.seed, kCellOfPulses, static_cast<std::uint32_t>(index)).Fill(normals);
  const auto coordinate = [&](AxisId axis) {
    const double uniform = 0.5 * std::erfc(-normals[Index(axis)] / std::sqrt(2.0));  // the normal distribution function
    return AlongAxis(campaign.axes[Index(axis)], uniform);
  };
  return {.wind_speed = coordinate(AxisId::kWindSpeed),
          .fetch = coordinate(AxisId::kFetch),
          .incidence = coordinate(AxisId::kIncidence),
          .azimuth = coordinate(AxisId::kAzimuth),
          .footprint = coordinate(AxisId::kFootprint),
          .depth = coordinate(AxisId::kDepth)};
}

std::vector<Estimate> ComputeDirectly(const Campaign& campaign, const Pulse& pulse) {
  SeaCase sea_case = SeaCaseOf(campaign, 0);  // for what all sea cases have in common
  sea_case.sea = SeaOf(campaign, pulse.wind_speed, pulse.fetch);
  sea_case.depths = {pulse.depth};
  const BeamOptions beam{.incidence = RadiansOfDegrees(pulse.incidence),
                         .azimuth = RadiansOfDegrees(*pulse.azimuth),
                         .footprint = pulse.footprint,
                         .profile = campaign.profile,
                         .source_height = campaign.source_height};
  // The outermost beams of a sea case determine grid, patch and rays, and the widest one the reach. They are the same
  // here as at the nodes.
  for (BeamOptions& node : sea_case.beams) node.footprint = pulse.footprint;
  sea_case.discretization = ChooseDiscretization(SeaState(sea_case.sea), sea_case.beams);
  sea_case.beams = {beam, WidestBeam(sea_case.beams)};
  const SeaCaseResult result = Simulate(sea_case, campaign.effort, campaign.seed, kCellOfTables);
  std::vector<Estimate> estimates;
  for (const Quantity quantity : kChecked) estimates.push_back(ValueOf(result.beams[0], quantity));
  return estimates;
}

InterpolationError CompareWithTable(const Campaign& campaign, const UncertaintyTable& table,
                                    const std::vector<std::vector<Estimate>>& direct, std::size_t checked) {
  const Quantity quantity = kChecked[checked];
  const double least = Describe(quantity).over_last_axis ? kLeastLength : kLeastAngle;
  InterpolationError summary;
  std::vector<double> errors;  // relative magnitudes
  for (std::size_t i = 0; i < direct.size(); ++i) {
    const Estimate& expected = direct[i][checked];
    const Pulse pulse = CheckedPulse(campaign, i);
    if (expected.value < least || pulse.wind_speed < kMinWind) continue;
    const PulseUncertainty interpolated = Interpolate(table, pulse);
    assert(interpolated.outcome == Outcome::kInterpolated);
    errors.push_back(std::abs(interpolated[quantity] / expected.value - 1));
    summary.rms += errors.back() * errors.back();
    summary.noise += std::pow(expected.standard_error / expected.value, 2);
  }
  if (errors.empty()) return summary;
  const double count = static_cast<double>(errors.size());
  std::sort(errors.begin(), errors.end());
  summary.pulses = static_cast<int>(errors.size());
  summary.rms = std::sqrt(summary.rms / count);
  summary.noise = std::sqrt(summary.noise / count);
  summary.percentile_99 = errors[static_cast<std::size_t>(std::ceil(0.99 * count)) - 1];
  summary.greatest = errors.back();
  return summary;
}

namespace {

// The minimum and the maximum of a number over the sea cases. Seas without waves count only if there are no others.
template <typename Number>
std::vector<double> Range(const std::vector<SeaCaseResult>& results, Number SeaCaseResult::*member) {
  const auto drawn =
      std::find_if(results.begin(), results.end(), [](const SeaCaseResult& result) { return result.realizations > 0; });
  const SeaCaseResult& first = drawn != results.end() ? *drawn : results.front();
  std::vector<double> range = {static_cast<double>(first.*member), static_cast<double>(first.*member)};
  for (const SeaCaseResult& result : results) {
    if (result.realizations == 0) continue;
    range[0] = std::min(range[0], static_cast<double>(result.*member));
    range[1] = std::max(range[1], static_cast<double>(result.*member));
  }
  return range;
}

// The name of a spectrum, with the waves that are left out.
std::string NameOf(const WaveSpectrum& spectrum, double corrected_above) {
  std::string name = spectrum.name();
  if (std::isfinite(corrected_above)) {
    absl::StrAppend(&name, "; waves longer than ", corrected_above,
                    " m left out, as corrected for by the local slope of the surface");
  }
  return name;
}

}  // namespace

Provenance CommonProvenance(const Campaign& campaign) {
  return {.id = campaign.id,
          .version = campaign.version,
          .title = campaign.title,
          .campaign = campaign.text,
          .attributes = {{"program_version", std::string(Version())},
                         {"commit", std::string(Commit())},
                         {"instruction_set", InstructionSet()},
                         {"date_created", DateCreated()},
                         {"seed", static_cast<std::int64_t>(campaign.seed)},
                         {"refractive_index", campaign.refractive_index}}};
}

Provenance MakeProvenance(const Campaign& campaign, const std::vector<SeaCaseResult>& results) {
  const SeaCase strongest_wind = SeaCaseOf(campaign, SeaCaseCount(campaign) - 1);
  const std::shared_ptr<const WaveSpectrum> spectrum = MakeSpectrum(strongest_wind.sea.waves);
  Provenance provenance = CommonProvenance(campaign);
  provenance.attributes.insert({
      {"source", "Monte Carlo ray tracing through a random sea surface, albtpu-generate"},
      {"references", "Birkebak et al. (2018), doi:10.3390/rs10030453; " + spectrum->reference()},
      {"component", "sea surface only: no water column, air side, platform or system"},
      {"beam_profile", std::string(Name(campaign.profile))},
      {"spectrum", NameOf(*spectrum, campaign.corrected_above)},
      {"spectrum_departures", spectrum->departures()},
      {"discretization",
       "Short waves by FFT on a periodic grid, longer ones as plane waves; "
       "waves shorter than the grid by the mean of refraction over their slopes. "
       "Ranges are the least and the greatest over winds, fetches and footprints."},
      // A point source is always traced plainly.
      {"estimator",
       std::string(Name(std::isinf(campaign.source_height) ? campaign.effort.estimator : Estimator::kPlain))},
      {"rounding",
       absl::StrCat("Values to a power of two, the largest not above a quarter of their standard error, and to ",
                    kValueBits, " significant bits if that is coarser; standard errors to ", kStandardErrorBits,
                    " significant bits")},
      {"node_values", campaign.balanced_nodes
                          ? "less a twelfth of their second difference along each axis but depth, ends aside, "
                            "which nearly halves the error of interpolation in the root mean square"
                          : "as computed at the nodes"},
      {"realizations", Range(results, &SeaCaseResult::realizations)},
      // "Encounters" are sea cases: attributes keep the names of format 1.
      {"encounters_above_relative_error",
       std::int64_t{std::count_if(results.begin(), results.end(),
                                  [](const SeaCaseResult& result) { return !result.converged; })}},
      {"rays", Range(results, &SeaCaseResult::rays)},
      {"domain", Range(results, &SeaCaseResult::patch_length)},
      {"spacing", Range(results, &SeaCaseResult::spacing)},
      {"footprint_slope_variance_fraction", Range(results, &SeaCaseResult::footprint_slope_fraction)},
      {"resolved_slope_variance_fraction", Range(results, &SeaCaseResult::resolved_slope_fraction)},
  });
  return provenance;
}

void DescribeInterpolationErrors(const std::vector<InterpolationError>& errors, Provenance& provenance) {
  provenance.attributes["interpolation_error"] =
      "Of the interpolated table, relative to direct computation at pulses drawn evenly over the axes, "
      "by the random numbers of the nodes, where 2 sigma is at least 0.01 degrees or 5 mm and the wind at "
      "least 2 m/s: "
      "root mean square, 99th percentile, greatest, rms standard error of the direct values, "
      "number of pulses";
  for (std::size_t q = 0; q < errors.size(); ++q) {
    const InterpolationError& error = errors[q];
    provenance.attributes["interpolation_error_" + std::string(Describe(kChecked[q]).name)] = std::vector<double>{
        error.rms, error.percentile_99, error.greatest, error.noise, static_cast<double>(error.pulses)};
  }
}

std::string DateCreated() {
  std::time_t time = std::time(nullptr);
  if (const char* epoch = std::getenv("SOURCE_DATE_EPOCH"); epoch != nullptr)
    std::from_chars(epoch, epoch + std::strlen(epoch), time);
  std::tm utc{};
  gmtime_r(&time, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

}  // namespace albtpu
