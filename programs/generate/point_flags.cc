#include "programs/generate/point_flags.h"

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "programs/command_line/checks.h"
#include "programs/command_line/help.h"
#include "programs/generate/flags.h"
#include "sea/spectra/spectral_tail.h"
#include "sea/wave_state.h"

namespace albtpu::programs {
namespace {

CLI::Validator Fetch() {
  return CLI::Validator(
      [](std::string& text) -> std::string {
        double x = 0;
        if (CLI::detail::lexical_cast(text, x) && x > 0) return {};
        return "'" + text + "' is not a fetch; give metres above 0, or inf for a fully developed sea";
      },
      "", "fetch");
}

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
  const auto number = [&](const char* flag, std::optional<double> SeaOfFile::*field, const char* meaning,
                          double least, double most) {
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
         "Where the wind comes from, of the compass [degree] (default: the file's, or along the short waves)",
         -360, 360);
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
          ->check(Fetch());
  const std::vector<std::string> spectra(kSpectrumKeys.begin(), kSpectrumKeys.end());
  std::string described;  // "apel (default) or elfouhaily"
  for (const std::string& key : spectra) {
    described += (described.empty() ? "" : " or ") + key + (key == options.spectrum ? " (default)" : "");
  }
  CLI::Option* spectrum =
      point.add_option("--spectrum", options.spectrum, "Spectrum of the waves: " + described)
          ->check(OneOf(spectra));
  point
      .add_option("--corrected-above", options.corrected_above,
                  "Leave out waves longer than this [m]: the local slope corrects for them")
      ->check(NumberIn(0.1, 1e6));
  point.add_option("--incidence", options.incidence, "Angle of the beam from the vertical, in air [degree]")
      ->required()
      ->check(NumberIn(0, 60));
  CLI::Option* azimuth =
      point
          .add_option("--azimuth", options.azimuth,
                      "Horizontal direction of the beam from downwind [degree] (default: the worst of some)")
          ->check(NumberIn(-1e6, 1e6));
  point
      .add_option("--footprint", options.footprint,
                  "Diameter of the beam at the mean surface, across its axis [m]")
      ->required()
      ->check(NumberIn(0, 1000, true));
  point.add_option("--depth", options.depth, "Depths below the surface, separated by commas [m]")
      ->type_name("M,M")
      ->required()
      ->delimiter(',')
      ->check(NumberIn(0, 1e4));
  point.add_option("--profile", options.profile, "Irradiance across the beam: uniform (default) or gaussian")
      ->check(OneOf({"uniform", "gaussian"}));
  point
      .add_option("--refractive-index", options.refractive_index,
                  "Refractive index of the water (default: 1.33)")
      ->check(NumberIn(1.01, 2));
  point
      .add_option("--relative-error", options.relative_error,
                  "Relative standard error of refraction, THU and TVU to reach (default: 0.01)")
      ->check(NumberIn(1e-4, 0.5));
  point
      .add_option("--estimator", options.estimator,
                  "control_variate (default), or plain for ray tracing alone")
      ->check(OneOf({"control_variate", "plain"}));
  point.add_option("--seed", options.seed, "Seed of the random numbers, a whole number (default: 1)")
      ->check(Seed());
  point.add_flag("--json", options.json, "Print one JSON object");
  AddThreads(point, threads);
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
  Group(point, "The sea of a file",
        {"--sea", "--sea-time", "--sea-depth", "--wind-from", "--tail", "--tail-from"});
  Group(point, "The pulse",
        {"--incidence", "--azimuth", "--beam-azimuth", "--footprint", "--depth", "--profile"});
  Group(point, kWork, {"--relative-error", "--estimator", "--seed", "--threads"});
  Group(point, "Output", {"--json"});
  EndHelp(
      point, "", "--wind-speed 7 --incidence 12 --footprint 0.6 --depth 1,5,10,20",
      "--sea 41010.data_spec --sea-time 2020-06-08T03:50Z --incidence 12 --beam-azimuth 140 --footprint 0.6 "
      "--depth 10 --json");
}

}  // namespace albtpu::programs
