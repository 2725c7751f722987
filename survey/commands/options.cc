#include "survey/commands/options.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "command_line/checks.h"
#include "survey/number_text.h"

namespace albtpu::client {
namespace {

template <typename Number>
void CheckNumber(const std::string& flag, const std::string& text, std::optional<Number> value, Sign sign,
                 bool infinity_allowed) {
  const bool number =
      value.has_value() && (std::isfinite(*value) || (infinity_allowed && std::isinf(*value) && *value > 0));
  const std::string remedy =
      absl::StrCat("give ", sign == Sign::kNotNegative ? "a number of at least 0" : "a finite number",
                   infinity_allowed ? ", or inf" : "");
  if (!number)
    throw CLI::ValidationError(flag, absl::StrCat("'", text, "' is not a finite number; ", remedy));
  if (sign == Sign::kNotNegative && *value < 0) {
    throw CLI::ValidationError(flag, absl::StrCat(text, " is negative; ", remedy));
  }
}

// Validators of CLI11 answer with what is wrong, or with an empty text.
std::string CheckHostAndPort(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  int port = 0;
  const bool number = colon != std::string::npos && colon > 0 &&
                      absl::SimpleAtoi(absl::string_view(text).substr(colon + 1), &port);
  if (number && port > 0 && port <= 65535) return "";
  return absl::StrCat("'", text, "' is not an address; give HOST:PORT, such as 127.0.0.1:50051");
}

const char* DescribeFlag(AxisId axis) {
  switch (axis) {
    case AxisId::kWindSpeed:
      return "Wind speed at 10 m above the sea [m/s]";
    case AxisId::kFetch:
      return "Fetch [m], or inf for a fully developed sea (default)";
    case AxisId::kIncidence:
      return "Angle of the beam from the vertical, in air [degree]";
    case AxisId::kAzimuth:
      return "Horizontal direction of the beam from downwind [degree] (default: the worse of along and "
             "across the wind)";
    case AxisId::kFootprint:
      return "Diameter of the beam at the mean surface, across its axis [m]";
    case AxisId::kDepth:
      return "Depth below the surface [m]";
  }
  return "";
}

const char* DescribeBeamInput(PulseInput input) {
  switch (input) {
    case PulseInput::kBeamAzimuth:
      return "Where the beam travels to [degree, true]; with --wind-from instead of --azimuth";
    case PulseInput::kWindFrom:
      return "Where the wind comes from [degree, true]; with --beam-azimuth instead of --azimuth";
    case PulseInput::kAltitude:
      return "Altitude above the water [m]; with --divergence instead of --footprint";
    case PulseInput::kDivergence:
      return "Full divergence of the beam [mrad]; with --altitude instead of --footprint";
    default:
      return "";
  }
}

void AddBeamInput(CLI::App& command, PulseInput input, FixedInputs& fixed) {
  const bool is_direction = input == PulseInput::kBeamAzimuth || input == PulseInput::kWindFrom;
  command
      .add_option_function<std::string>(
          FlagName(input),
          [input, is_direction, &fixed](const std::string& text) {
            const std::optional<float> value = ParseFloat(text);
            CheckNumber(FlagName(input), text, value, is_direction ? Sign::kAny : Sign::kNotNegative, false);
            fixed[input] = value;
          },
          DescribeBeamInput(input))
      ->type_name("NUMBER")
      ->group(input == PulseInput::kWindFrom ? group::kSea : group::kPulse);
}

// Each of them means TLS.
void AddCredentialOptions(CLI::App& command, CLI::Option* server, Credentials& credentials) {
  const auto add = [&](const char* flag, std::string& path, const char* description) {
    return command.add_option(flag, path, description)
        ->type_name("FILE")
        ->check(NotEmpty("file"))
        ->needs(server)
        ->group(group::kAccess);
  };
  add("--tls-ca", credentials.ca, "Use TLS and trust these certificate authorities (PEM)");
  CLI::Option* certificate =
      add("--tls-cert", credentials.certificate, "Use TLS and present this certificate (PEM)");
  CLI::Option* key = add("--tls-key", credentials.key, "Private key of --tls-cert (PEM)");
  certificate->needs(key);
  key->needs(certificate);
  add("--token-file", credentials.token, "Use TLS and send the token in this file with every call");
}

}  // namespace

CLI::Option* AddServerOptions(CLI::App& command, SourceOptions& options) {
  CLI::Option* server =
      command
          .add_option("--server", options.server,
                      "Ask the service at HOST:PORT, or with dns:///NAME:PORT all servers of a name in turn")
          ->type_name("HOST:PORT")
          ->check(CheckHostAndPort)
          ->group(group::kSource);
  AddCredentialOptions(command, server, options.credentials);
  return server;
}

void AddSourceOptions(CLI::App& command, SourceOptions& options) {
  CLI::Option* server = AddServerOptions(command, options);
  command.add_option("--table", options.file, "Answer from this table file, without a server")
      ->type_name("FILE.h5")
      ->check(NotEmpty("file"))
      ->excludes(server)
      ->group(group::kSource);
  command
      .add_option("--table-name", options.name,
                  "The table to use, by NAME or NAME/VERSION (default: the default table)")
      ->type_name("NAME")
      ->check(NotEmpty("table"))
      ->group(group::kSource);
}

void AddStyleOptions(CLI::App& command, AnswerStyle& style) {
  command
      .add_option_function<std::string>(
          "--coverage",
          [&style](const std::string& text) {
            style.coverage = *FindCoverage(text);
            style.coverage_given = true;
          },
          "2sigma for twice the standard deviation (default), p95 for 95 %, 1sigma for one standard "
          "deviation")
      ->type_name("2sigma|p95|1sigma")
      ->check(OneOf({"2sigma", "p95", "1sigma"}))
      ->group(group::kOutput);
  std::vector<std::string> orders;
  for (const S44Order order : kS44Orders) orders.emplace_back(Name(order));
  command
      .add_option_function<std::string>(
          "--s44-order", [&style](const std::string& text) { style.s44_order = FindS44Order(text); },
          "Compare with this order of IHO S-44: exclusive, special, 1a, 1b or 2")
      ->type_name("ORDER")
      ->check(OneOf(orders))
      ->group(group::kOutput);
  command
      .add_flag_callback(
          "--standard-errors", [&style] { style.standard_errors = true; },
          "Give the standard error of each value, too")
      ->group(group::kOutput);
}

void AddFileOptions(CLI::App& command, const std::string& extension, FileOptions& options,
                    Existing& existing) {
  command
      .add_option("files", options.files,
                  absl::StrCat("IN", extension, " OUT", extension,
                               ", or with --output-dir any number of input files and folders"))
      ->required()
      ->type_name("FILE" + extension);
  CLI::Option* output_folder =
      command
          .add_option("--output-dir", options.output_folder,
                      "Write each output into this folder, under the name of its input")
          ->type_name("DIR")
          ->group(group::kFiles);
  command
      .add_flag("--recursive", options.recursive,
                "Also take the files in subfolders; --output-dir gets the same subfolders")
      ->needs(output_folder)
      ->group(group::kFiles);
  command
      .add_flag("--resume", options.resume,
                "Keep finished outputs whose summaries state the same input, parameters and table")
      ->group(group::kFiles);
  command
      .add_flag_callback(
          "--overwrite", [&existing] { existing = Existing::kReplace; }, "Replace outputs that exist")
      ->group(group::kFiles);
}

nlohmann::ordered_json Parameters(const AnswerStyle& style) {
  nlohmann::ordered_json json;
  json["coverage"] = CoverageText(style.coverage);
  json["s44_order"] = nullptr;
  if (style.s44_order.has_value()) json["s44_order"] = std::string(Name(*style.s44_order));
  json["standard_errors"] = style.standard_errors;
  return json;
}

void AddCoordinate(CLI::App& command, AxisId axis, FixedCoordinates& fixed) {
  const Sign sign = axis == AxisId::kAzimuth ? Sign::kAny : Sign::kNotNegative;
  const bool is_of_the_sea = axis == AxisId::kWindSpeed || axis == AxisId::kFetch;
  command
      .add_option_function<std::string>(
          FlagName(axis),
          [axis, sign, &fixed](const std::string& text) {
            const std::optional<float> value = ParseFloat(text);
            CheckNumber(FlagName(axis), text, value, sign, axis == AxisId::kFetch);
            fixed[Index(axis)] = value;
          },
          DescribeFlag(axis))
      ->type_name("NUMBER")
      ->group(is_of_the_sea ? group::kSea : group::kPulse);
}

void AddWindFrom(CLI::App& command, FixedInputs& fixed) {
  AddBeamInput(command, PulseInput::kWindFrom, fixed);
}

void AddBeamInputs(CLI::App& command, FixedInputs& fixed) {
  for (const PulseInput input : kBeamInputs) AddBeamInput(command, input, fixed);
}

CLI::Option* AddNumber(CLI::App& command, const std::string& flag, Sign sign, const std::string& description,
                       std::optional<double>& value) {
  return command
      .add_option_function<std::string>(
          flag,
          [flag, sign, &value](const std::string& text) {
            const std::optional<double> parsed = ParseDouble(text);
            CheckNumber(flag, text, parsed, sign, false);
            value = parsed;
          },
          description)
      ->type_name("NUMBER");
}

}  // namespace albtpu::client
