#include "programs/query/options.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "formats/text/text.h"
#include "programs/command_line/command_line.h"

namespace albtpu::programs {
namespace {

template <typename Number>
void CheckNumber(const std::string& flag, const std::string& text, std::optional<Number> value, Sign sign) {
  const std::string remedy = absl::StrCat("give a ", sign == Sign::kAny           ? "finite number"
                                                     : sign == Sign::kNotNegative ? "number of at least 0"
                                                                                  : "number above 0");
  if (!value.has_value() || !std::isfinite(*value))
    throw CLI::ValidationError(flag, absl::StrCat("'", text, "' is not a finite number; ", remedy));
  if (sign != Sign::kAny && *value < 0) throw CLI::ValidationError(flag, absl::StrCat(text, " is negative; ", remedy));
  if (sign == Sign::kPositive && *value == 0) throw CLI::ValidationError(flag, absl::StrCat(text, " is 0; ", remedy));
}

// Validators of CLI11 answer with what is wrong, or with an empty text.
std::string CheckHostAndPort(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  int port = 0;
  const bool number =
      colon != std::string::npos && colon > 0 && absl::SimpleAtoi(absl::string_view(text).substr(colon + 1), &port);
  if (number && port > 0 && port <= 65535) return "";
  return absl::StrCat("'", text, "' is not an address; give HOST:PORT, such as 127.0.0.1:50051");
}

// By PulseInput; those of the sea have keys.
constexpr const char* kInputHelp[annotate::kPulseInputCount] = {
    "",
    "",
    "Angle of the beam from the vertical, in air [degree]",
    ("Horizontal direction of the beam from downwind [degree] (default: the worse of along and across the "
     "wind)"),
    "Diameter of the beam at the mean surface, across its axis [m]",
    "Depth below the surface [m]",
    "Where the beam travels to [degree, true]; with --wind-from instead of --azimuth",
    "",
    "Altitude above the water [m]; with --divergence instead of --footprint",
    "Full divergence of the beam [mrad]; with --altitude instead of --footprint"};

// A text that is not empty: the name of a `what`.
CLI::Option* AddName(CLI::App& command, const char* flag, std::string& name, const char* type, const char* what,
                     const char* heading, const char* description) {
  return command.add_option(flag, name, description)->type_name(type)->check(NotEmpty(what))->group(heading);
}

// Each of them means TLS.
void AddCredentialOptions(CLI::App& command, CLI::Option* server, client::Credentials& credentials) {
  const auto add = [&](const char* flag, std::string& path, const char* description) {
    return AddName(command, flag, path, "FILE", "file", group::kAccess, description)->needs(server);
  };
  add("--tls-ca", credentials.ca, "Use TLS and trust these certificate authorities (PEM)");
  CLI::Option* certificate = add("--tls-cert", credentials.certificate, "Use TLS and present this certificate (PEM)");
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
  AddName(command, "--table", options.file, "FILE.h5", "file", group::kSource,
          "Answer from this table file, without a server")
      ->excludes(server);
  AddName(command, "--table-name", options.name, "NAME", "table", group::kSource,
          "The table to use, by NAME or NAME/VERSION (default: the default table)");
}

void AddFileOptions(CLI::App& command, const std::string& extension, annotate::FileOptions& options,
                    Existing& existing) {
  command
      .add_option("files", options.files,
                  absl::StrCat("IN", extension, " OUT", extension,
                               ", or with --output-dir any number of input files and folders"))
      ->required()
      ->type_name("FILE" + extension);
  CLI::Option* output_folder = command
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
      .add_flag("--json", options.json,
                "Print the summary of each output, one JSON object a line, as it is in the file beside it")
      ->group(group::kFiles);
  command
      .add_flag_callback(
          "--overwrite", [&existing] { existing = Existing::kReplace; }, "Replace outputs that exist")
      ->group(group::kFiles);
}

nlohmann::ordered_json Parameters(const annotate::AnswerStyle& style) {
  nlohmann::ordered_json json;
  json["coverage"] = annotate::CoverageText(style.coverage);
  json["s44_order"] = nullptr;
  if (style.s44_order.has_value()) json["s44_order"] = std::string(Name(*style.s44_order));
  json["standard_errors"] = style.standard_errors;
  return json;
}

void AddInput(CLI::App& command, annotate::PulseInput input, annotate::FixedInputs& fixed) {
  const bool is_direction = input == annotate::PulseInput::kBeamAzimuth || input == annotate::PulseInput::kAzimuth;
  const Sign sign = is_direction                               ? Sign::kAny
                    : input == annotate::PulseInput::kAltitude ? Sign::kPositive
                                                               : Sign::kNotNegative;
  command
      .add_option_function<std::string>(
          annotate::FlagName(input),
          [input, sign, &fixed](const std::string& text) {
            const std::optional<float> value = formats::ParseFloat(text);
            CheckNumber(annotate::FlagName(input), text, value, sign);
            fixed[input] = value;
          },
          kInputHelp[Index(input)])
      ->type_name("NUMBER")
      ->group(group::kPulse);
}

void AddInputs(CLI::App& command, annotate::FixedInputs& fixed) {
  for (std::size_t i = 0; i < annotate::kPulseInputCount; ++i)
    if (const auto input = static_cast<annotate::PulseInput>(i); !annotate::IsOfSea(input))
      AddInput(command, input, fixed);
}

void AddTriple(CLI::App& command, const std::string& flag, const std::string& type, const std::string& description,
               std::optional<std::array<double, 3>>& value) {
  command
      .add_option_function<std::string>(
          flag,
          [flag, type, &value](const std::string& text) {
            const std::vector<std::string> parts = absl::StrSplit(text, ',');
            std::array<double, 3> numbers = {};
            bool good = parts.size() == numbers.size();
            for (std::size_t i = 0; good && i < numbers.size(); ++i) {
              const std::optional<double> number = formats::ParseDouble(parts[i]);
              good = number.has_value() && std::isfinite(*number);
              numbers[i] = number.value_or(0);
            }
            if (!good) throw CLI::ValidationError(flag, absl::StrCat("is '", text, "'; give three numbers: ", type));
            value = numbers;
          },
          description)
      ->type_name(type)
      ->group(group::kTotal);
}

CLI::Option* AddNumber(CLI::App& command, const std::string& flag, Sign sign, const std::string& description,
                       std::optional<double>& value) {
  return command
      .add_option_function<std::string>(
          flag,
          [flag, sign, &value](const std::string& text) {
            const std::optional<double> parsed = formats::ParseDouble(text);
            CheckNumber(flag, text, parsed, sign);
            value = parsed;
          },
          description)
      ->type_name("NUMBER");
}

}  // namespace albtpu::programs
