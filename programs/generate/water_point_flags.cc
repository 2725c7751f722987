#include "programs/generate/water_point_flags.h"

#include <CLI/CLI.hpp>
#include <string>

#include "absl/strings/str_cat.h"
#include "programs/command_line/help.h"
#include "programs/generate/flags.h"
#include "tables/water/water_schema.h"

namespace albtpu::programs {
namespace {

// The echo of clear water is known in closed form only where the field of view takes in the whole footprint.
constexpr double kMinFootprints = 2.5;

// Lengths of the pulse in water over twice the depth. An echo is kept in steps of a thirtieth of the pulse, from two
// depths above the bottom to five below it.
constexpr double kShortestPulse = 5e-4, kLongestPulse = 1.5;

CLI::Validator FieldOfView() {
  return CLI::Validator(
      [](std::string& text) -> std::string {
        double x = 0;
        if (CLI::detail::lexical_cast(text, x) && x > 0) return {};
        return "'" + text + "' is not a field of view; give metres above 0, or inf for all of the surface";
      },
      "", "field of view");
}

}  // namespace

void AddWaterPoint(CLI::App& point, WaterPointOptions& options, int& threads) {
  CLI::Option* const absorption =
      point.add_option("--absorption", options.absorption, "Absorption of the water [1/m]")
          ->check(NumberIn(0.001, 100));
  CLI::Option* const scattering =
      point.add_option("--scattering", options.scattering, "Scattering of the water [1/m]")
          ->check(NumberIn(1e-6, 100));
  CLI::Option* const kd =
      point
          .add_option(
              "--kd", options.kd,
              "In their place: diffuse attenuation of light from straight above, sqrt(a^2 + 6 B a b) of "
              "absorption a, scattering b and backscatter fraction B [1/m]")
          ->check(NumberIn(0.001, 100));
  CLI::Option* const omega0 =
      point.add_option("--omega0", options.omega0, "Single-scattering albedo, with --kd")
          ->check(NumberIn(1e-4, 0.99));
  point
      .add_option("--backscatter-fraction", options.backscatter_fraction,
                  "Share of scattered light that turns back (default: 0.0183)")
      ->check(NumberIn(0.001, 0.1));
  point.add_option("--depth", options.depth, "Depth of the bottom below the surface [m]")
      ->required()
      ->check(NumberIn(0.01, 1000));
  point.add_option("--incidence", options.incidence, "Angle of the beam from the vertical, in air [degree]")
      ->required()
      ->check(NumberIn(0, 60));
  point
      .add_option("--field-of-view", options.field_of_view,
                  "Diameter of the disc on the surface that the receiver sees, across the beam [m], or inf")
      ->required()
      ->check(FieldOfView());
  point
      .add_option("--pulse-length", options.pulse_length,
                  "Width of the Gaussian pulse at half its maximum [ns]")
      ->required()
      ->check(NumberIn(0.05, 100));
  point
      .add_option("--footprint", options.footprint,
                  "1/e^2 diameter of the Gaussian beam at the mean surface, across its axis [m]")
      ->required()
      ->check(NumberIn(0, 1000));
  point
      .add_option("--refractive-index", options.refractive_index,
                  "Index of the phase, which refracts (default: 1.342)")
      ->check(NumberIn(1.01, 2));
  point
      .add_option("--group-index", options.group_index, "Index of the group, which delays (default: 1.3643)")
      ->check(NumberIn(1.01, 2));
  point.add_option("--photons", options.photons, "Photons of the simulation (default: 1600000)")
      ->check(NumberIn(8000, 1e8));
  point.add_option("--seed", options.seed, "Seed of the random numbers, a whole number (default: 1)")
      ->check(Seed());
  point.add_flag("--json", options.json, "Print one JSON object");
  AddThreads(point, threads);
  point.callback([&options, absorption, scattering, kd, omega0] {
    const bool direct = *absorption && *scattering && !*kd && !*omega0;
    if (!direct && (!*kd || !*omega0 || *absorption || *scattering)) {
      throw CLI::ValidationError(
          "--absorption",
          "the water needs two numbers; give --absorption and --scattering, or --kd and "
          "--omega0");
    }
    if (!direct) {
      const double ratio = options.omega0 / (1 - options.omega0);
      options.scattering = options.kd / OpticalDepthPerScattering(ratio, options.backscatter_fraction);
      options.absorption = options.scattering / ratio;
    }
    if (options.field_of_view < kMinFootprints * options.footprint) {
      throw CLI::ValidationError(
          "--field-of-view", absl::StrCat("cuts the footprint of ", options.footprint, " m; give at least ",
                                          kMinFootprints * options.footprint, " m, 2.5 footprints"));
    }
    const double unit = 2 * options.group_index * options.depth / kLightSpeed;  // ns: down and up.
    if (options.pulse_length < kShortestPulse * unit || options.pulse_length > kLongestPulse * unit) {
      throw CLI::ValidationError(
          "--pulse-length",
          absl::StrCat(options.pulse_length, " ns has no echo to read at ", options.depth, " m; give ",
                       kShortestPulse * unit, " to ", kLongestPulse * unit, " ns, or another depth"));
    }
  });
  Group(point, "The water",
        {"--absorption", "--scattering", "--kd", "--omega0", "--backscatter-fraction", "--depth",
         "--refractive-index", "--group-index"});
  Group(point, "The system", {"--incidence", "--field-of-view", "--pulse-length", "--footprint"});
  Group(point, kWork, {"--photons", "--seed", "--threads"});
  Group(point, "Output", {"--json"});
  EndHelp(
      point, "",
      "--absorption 0.108 --scattering 0.28 --depth 7 --incidence 15 --field-of-view 5 --pulse-length 2.2 "
      "--footprint 0.6",
      "--absorption 0.07 --scattering 0.2 --depth 10 --incidence 20 --field-of-view inf --pulse-length 5 "
      "--footprint 2 --json");
}

}  // namespace albtpu::programs
