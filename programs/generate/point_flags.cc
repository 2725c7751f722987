#include "programs/generate/point_flags.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "generator/campaign/campaign_keys.h"
#include "programs/command_line/command_line.h"
#include "sea/sea_state.h"
#include "sea/spectra/spectral_tail.h"
#include "tables/water/water_schema.h"

namespace albtpu::programs {
CLI::Validator NumberIn(double least, double most) {
  const std::string remedy =
      "give a number from " + CLI::detail::to_string(least) + " to " + CLI::detail::to_string(most);
  return CLI::Validator(
      [=](std::string& text) -> std::string {
        double x = 0;
        const bool number = CLI::detail::lexical_cast(text, x);
        if (number && std::isfinite(x) && x >= least && x <= most) return {};
        return "'" + text + "' is not a finite number in the range; " + remedy;
      },
      "", "number");
}

CLI::Validator Seed() {
  return CLI::Validator(
      [](std::string& text) -> std::string {
        std::int64_t seed = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
        if (error == std::errc() && end == text.data() + text.size() && seed >= 0) return {};
        return "'" + text + "' is not a seed; give a whole number from 0 to 9223372036854775807";
      },
      "", "seed");
}

void AddThreads(CLI::App& command, int& threads) {
  command.add_option("--threads", threads, "Number of threads (default: all cores)")
      ->type_name("N")
      ->check(WholeIn(1, 4096));
}

namespace {

// The echo of clear water is known in closed form only where the field of view takes in the whole footprint.
constexpr double kMinFootprints = 2.5;

// Lengths of the pulse in water over twice the depth. An echo is kept in steps of a thirtieth of the pulse, from two
// depths above the bottom to five below it.
constexpr double kShortestPulse = 5e-4, kLongestPulse = 1.5;

// Metres above 0, or inf, which means `infinite`.
CLI::Validator Length(const std::string& what, const std::string& infinite) {
  return CLI::Validator(
      [=](std::string& text) -> std::string {
        double x = 0;
        if (CLI::detail::lexical_cast(text, x) && x > 0) return {};
        return "'" + text + "' is not a " + what + "; give metres above 0, or inf for " + infinite;
      },
      "", what);
}

// The incidence of the beam.
void AddIncidence(CLI::App& point, double& incidence) {
  point.add_option("--incidence", incidence, "Angle of the beam from the vertical, in air [degree]")
      ->required()
      ->check(NumberIn(0, 60));
}

// How the simulation is run, and its numbers printed.
void AddRun(CLI::App& point, std::uint64_t& seed, bool& json, int& threads) {
  point.add_option("--seed", seed, "Seed of the random numbers, a whole number (default: 1)")->check(Seed());
  point.add_flag("--json", json, "Print one JSON object");
  AddThreads(point, threads);
}

}  // namespace

void AddWaterPoint(CLI::App& point, WaterPointOptions& options, int& threads) {
  CLI::Option* const absorption = point.add_option("--absorption", options.absorption, "Absorption of the water [1/m]")
                                      ->check(NumberIn(0.001, 100));
  CLI::Option* const scattering =
      point.add_option("--scattering", options.scattering, "Scattering of the water [1/m]")->check(NumberIn(1e-6, 100));
  CLI::Option* const kd =
      point
          .add_option("--kd", options.kd,
                      "In their place: diffuse attenuation of light from straight above, sqrt(a^2 + 6 B a b) of "
                      "absorption a, scattering b and backscatter fraction B [1/m]")
          ->check(NumberIn(0.001, 100));
  CLI::Option* const omega0 =
      point.add_option("--omega0", options.omega0, "Single-scattering albedo, with --kd")->check(NumberIn(1e-4, 0.99));
  point
      .add_option("--backscatter-fraction", options.backscatter_fraction,
                  absl::StrCat("Share of scattered light that turns back (default: ", kMeanBackscatterFraction, ")"))
      ->check(NumberIn(0.001, 0.1));
  point.add_option("--depth", options.depth, "Depth of the bottom below the surface [m]")
      ->required()
      ->check(NumberIn(0.01, 1000));
  AddIncidence(point, options.incidence);
  point
      .add_option("--field-of-view", options.field_of_view,
                  "Diameter of the disc on the surface that the receiver sees, across the beam [m], or inf")
      ->required()
      ->check(Length("field of view", "all of the surface"));
  point.add_option("--pulse-length", options.pulse_length, "Width of the Gaussian pulse at half its maximum [ns]")
      ->required()
      ->check(NumberIn(0.05, 100));
  point
      .add_option("--footprint", options.footprint,
                  "1/e^2 diameter of the Gaussian beam at the mean surface, across its axis [m]")
      ->required()
      ->check(NumberIn(0, 1000));
  point
      .add_option("--refractive-index", options.refractive_index, "Index of the phase, which refracts (default: 1.342)")
      ->check(NumberIn(1.01, 2));
  point.add_option("--group-index", options.group_index, "Index of the group, which delays (default: 1.3643)")
      ->check(NumberIn(1.01, 2));
  point.add_option("--photons", options.photons, "Photons of the simulation (default: 1600000)")
      ->check(NumberIn(8000, 1e8));
  AddRun(point, options.seed, options.json, threads);
  point.callback([&options, absorption, scattering, kd, omega0] {
    const bool direct = *absorption && *scattering && !*kd && !*omega0;
    if (!direct && (!*kd || !*omega0 || *absorption || *scattering))
      throw CLI::ValidationError("--absorption",
                                 "the water needs two numbers; give --absorption and --scattering, or --kd and "
                                 "--omega0");
    if (!direct) {
      const double ratio = options.omega0 / (1 - options.omega0);
      options.scattering = options.kd / OpticalDepthPerScattering(ratio, options.backscatter_fraction);
      options.absorption = options.scattering / ratio;
    }
    if (options.field_of_view < kMinFootprints * options.footprint)
      throw CLI::ValidationError("--field-of-view",
                                 absl::StrCat("cuts the footprint of ", options.footprint, " m; give at least ",
                                              kMinFootprints * options.footprint, " m, 2.5 footprints"));
    const double unit = 2 * options.group_index * options.depth / kLightSpeed;  // ns: down and up.
    if (options.pulse_length < kShortestPulse * unit || options.pulse_length > kLongestPulse * unit)
      throw CLI::ValidationError("--pulse-length", absl::StrCat(options.pulse_length, " ns has no echo to read at ",
                                                                options.depth, " m; give ", kShortestPulse * unit,
                                                                " to ", kLongestPulse * unit, " ns, or another depth"));
  });
  Group(point, "The water",
        {"--absorption", "--scattering", "--kd", "--omega0", "--backscatter-fraction", "--depth", "--refractive-index",
         "--group-index"});
  Group(point, "The system", {"--incidence", "--field-of-view", "--pulse-length", "--footprint"});
  Group(point, kWork, {"--photons", "--seed", "--threads"});
  Group(point, "Output", {"--json"});
  EndHelp(point, "",
          "--absorption 0.108 --scattering 0.28 --depth 7 --incidence 15 --field-of-view 5 --pulse-length 2.2 "
          "--footprint 0.6",
          "--absorption 0.07 --scattering 0.2 --depth 10 --incidence 20 --field-of-view inf --pulse-length 5 "
          "--footprint 2 --json");
}

namespace {

// The sea of a file, and its options. Returns the option that names the file.
CLI::Option* AddSea(CLI::App& point, PointOptions& options) {
  const auto sea_of_file = [&options]() -> SeaOfFile& {
    if (!options.sea) options.sea.emplace();
    return *options.sea;
  };
  CLI::Option* sea = point
                         .add_option_function<std::string>(
                             "--sea", [sea_of_file](const std::string& file) { sea_of_file().file = file; },
                             "Spectra or heights of the waves: NDBC, WAVEWATCH III, SWAN or CSV")
                         ->type_name("FILE")
                         ->check(NotEmpty("file"));
  point
      .add_option_function<std::string>(
          "--sea-time", [sea_of_file](const std::string& time) { sea_of_file().time = time; },
          "A time of the file, UTC, such as 2020-06-08T03:50Z (default: the only one)")
      ->type_name("TIME")
      ->needs(sea);
  const auto number = [&](const char* flag, std::optional<double> SeaOfFile::*field, const char* meaning, double least,
                          double most) {
    point
        .add_option_function<double>(
            flag, [sea_of_file, field](double value) { sea_of_file().*field = value; }, meaning)
        ->type_name("NUMBER")
        ->check(NumberIn(least, most))
        ->needs(sea);
  };
  number("--sea-depth", &SeaOfFile::water_depth,
         "Depth of the water that the waves travel in [m] (default: the file's, or deep)", 0.1, 20000);
  number("--wind-from", &SeaOfFile::wind_from,
         "Where the wind comes from, of the compass [degree] (default: the file's, or along the short waves)", -360,
         360);
  point
      .add_option_function<std::string>(
          "--tail", [sea_of_file](const std::string& name) { sea_of_file().tail = *FindTailRule(name); },
          "Waves shorter than the file resolves: the wind's, from the level of the resolved ones by relax "
          "(default), wind or level; or none")
      ->type_name("relax|wind|level|none")
      ->check(OneOf({"relax", "wind", "level", "none"}))
      ->needs(sea);
  number("--tail-from", &SeaOfFile::tail_from,
         "Where the tail begins [Hz] (default: up to where the waves can be trusted)", 0.05, 10);
  return sea;
}

}  // namespace

void AddPoint(CLI::App& point, PointOptions& options, int& threads) {
  CLI::Option* wind_speed =
      point.add_option("--wind-speed", options.wind_speed, "Wind speed at 10 m above the sea [m/s]")
          ->check(NumberIn(0, 50));
  CLI::Option* fetch =
      point.add_option("--fetch", options.fetch, "Fetch [m], or inf for a fully developed sea (default)")
          ->check(Length("fetch", "a fully developed sea"));
  const std::vector<std::string> spectra(kSpectrumKeys.begin(), kSpectrumKeys.end());
  std::string described;  // "apel (default) or elfouhaily"
  for (const std::string& key : spectra)
    described += (described.empty() ? "" : " or ") + key + (key == options.spectrum ? " (default)" : "");
  CLI::Option* spectrum =
      point.add_option("--spectrum", options.spectrum, "Spectrum of the waves: " + described)->check(OneOf(spectra));
  point
      .add_option("--corrected-above", options.corrected_above,
                  "Leave out waves longer than this [m]: the local slope corrects for them")
      ->check(NumberIn(0.1, 1e6));
  AddIncidence(point, options.incidence);
  CLI::Option* azimuth =
      point
          .add_option("--azimuth", options.azimuth,
                      "Horizontal direction of the beam from downwind [degree] (default: the worst of some)")
          ->check(NumberIn(-1e6, 1e6));
  point.add_option("--footprint", options.footprint, "Diameter of the beam at the mean surface, across its axis [m]")
      ->required()
      ->check(NumberIn(campaign_keys::kMinFootprint, 1000));
  AddList(point, "--depth", options.depth, "Depths below the surface, separated by commas [m]", NumberIn(0, 1e4))
      ->type_name("M,M")
      ->required();
  point.add_option("--profile", options.profile, "Irradiance across the beam: uniform (default) or gaussian")
      ->check(OneOf({"uniform", "gaussian"}));
  point.add_option("--refractive-index", options.refractive_index, "Refractive index of the water (default: 1.33)")
      ->check(NumberIn(1.01, 2));
  point
      .add_option("--relative-error", options.relative_error,
                  "Relative standard error of refraction, THU and TVU to reach (default: 0.01)")
      ->check(NumberIn(1e-4, 0.5));
  point.add_option("--estimator", options.estimator, "control_variate (default), or plain for ray tracing alone")
      ->check(OneOf({"control_variate", "plain"}));
  AddRun(point, options.seed, options.json, threads);
  CLI::Option* sea = AddSea(point, options);
  for (CLI::Option* of_wind_sea : {fetch, spectrum}) of_wind_sea->excludes(sea);
  point
      .add_option("--beam-azimuth", options.beam_azimuth,
                  "Where the light travels to, of the compass [degree]; with --sea")
      ->check(NumberIn(-1e6, 1e6))
      ->excludes(azimuth)
      ->needs(sea);
  point.callback([&options, wind_speed, sea] {
    if (sea->empty() && wind_speed->empty()) throw CLI::RequiredError("--wind-speed or --sea");
    if (options.sea && !wind_speed->empty()) options.sea->wind_speed = options.wind_speed;
  });
  Group(point, "The sea of a wind",
        {"--wind-speed", "--fetch", "--spectrum", "--corrected-above", "--refractive-index"});
  Group(point, "The sea of a file", {"--sea", "--sea-time", "--sea-depth", "--wind-from", "--tail", "--tail-from"});
  Group(point, "The pulse", {"--incidence", "--azimuth", "--beam-azimuth", "--footprint", "--depth", "--profile"});
  Group(point, kWork, {"--relative-error", "--estimator", "--seed", "--threads"});
  Group(point, "Output", {"--json"});
  EndHelp(point, "", "--wind-speed 7 --incidence 12 --footprint 0.6 --depth 1,5,10,20",
          "--sea 41010.data_spec --sea-time 2020-06-08T03:50Z --incidence 12 --beam-azimuth 140 --footprint 0.6 "
          "--depth 10 --json");
}

}  // namespace albtpu::programs
